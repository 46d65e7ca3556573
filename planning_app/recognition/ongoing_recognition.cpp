#include "recognition/ongoing_recognition.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {
namespace {

constexpr double kWall = 1.0;        // m: a region that may be a bed's wall
constexpr double kAskEvery = 0.07;   // rad, where nothing else gives reason to ask: 4 degrees
constexpr double kEndsSeen = 0.05;   // m, standard deviation of a bed's length of which both ends are seen
constexpr double kEndsPassed = 0.2;  // the same where the scanner has passed both: without a tailgate they lie between two scanlines
constexpr double kCabKnown = 10.0;   // evidence of a cab that tells which end is the front
constexpr double kCabPassed = 5.0;   // the same where its place was passed, so that it cannot grow by more of it
constexpr double kCabLength = 1.8;   // m before the front end
constexpr double kSure = 110.0;      // evidence of a bed; of two building pits, which the whole sweep refuses, it was 96 and 108 while they were taken for beds
constexpr double kSameCorners = 0.03, kSameCab = 0.05, kSameCabLeast = 2.0;  // m; of a cab's evidence, and at least so much of it
// rad that the scanner turns while answers stay the same: a degree, and three.
constexpr double kAgreedFor = 0.017, kSettledFor = 0.052;

bool same(const RecognisedTruck& a, const RecognisedTruck& b) {
  for (std::size_t i = 0; i < a.corners.size(); ++i)
    if ((a.corners[i] - b.corners[i]).norm() > kSameCorners) return false;
  return std::abs(a.cab - b.cab) <= std::max(kSameCabLeast, kSameCab * b.cab);
}

double length_deviation(const RecognisedTruck& truck) { return std::sqrt(truck.pose_covariance(6, 6)); }

}  // namespace

bool OngoingRecognition::take(std::span<const ScanPoint> scanline, double turned) {
  const std::size_t before = sweep_.fans();
  sweep_.take(scanline, turned);
  if (sweep_.fans() == before) return false;
  if (sweep_.turn() - asked_turn_ >= kAskEvery || sweep_.wall_pauses(kWall)) return true;
  return answer_ && answer_->found && length_deviation(*answer_) < kEndsPassed;
}

bool OngoingRecognition::passed(const RecognisedTruck& truck, double before_front) const {
  const Eigen::Vector2d u(std::cos(truck.pose.yaw), std::sin(truck.pose.yaw)), v(-u.y(), u.x());
  const double half_width = truck.pose.face(1, 1, true);
  for (const double along : {-truck.pose.face(0, -1, true), truck.pose.face(0, 1, true) + before_front})
    for (const double across : {-half_width, half_width})
      if (!sweep_.passed(truck.pose.middle.head<2>() + along * u + across * v)) return false;
  return true;
}

const RecognisedTruck& OngoingRecognition::ask() {
  if (answer_ && asked_ == sweep_.fans()) return *answer_;
  answer_ = recognise_truck(sweep_, ranges_);
  asked_ = sweep_.fans();
  asked_turn_ = sweep_.turn();
  const RecognisedTruck& truck = *answer_;
  if (!truck.found || !settled_.found || !same(truck, settled_)) {
    settled_ = truck;
    settled_turn_ = asked_turn_;
  }
  stands_ = truck.found && hardly_changes(truck);
  return truck;
}

bool OngoingRecognition::hardly_changes(const RecognisedTruck& truck) const {
  if (truck.evidence.score < kSure) return false;
  const double same_for = asked_turn_ - settled_turn_, deviation = length_deviation(truck);
  const bool cab_passed = passed(truck, kCabLength);
  if (same_for >= kSettledFor && cab_passed) return true;  // an end that was not seen will not be
  if (truck.cab < (cab_passed ? kCabPassed : kCabKnown)) return false;
  return (same_for >= kSettledFor && deviation < kEndsSeen) || (same_for >= kAgreedFor && deviation < kEndsPassed && passed(truck, 0.0));
}

}  // namespace berm::app
