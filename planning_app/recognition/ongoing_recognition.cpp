#include "recognition/ongoing_recognition.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {
namespace {

constexpr double kWall = 1.0;        // m: a region that may be a bed's wall
constexpr double kAskEvery = 0.07;   // rad, where nothing else gives reason to ask: 4 degrees
constexpr std::size_t kFansBetween = 2;  // asks: two scanlines take longer than nearly every ask
constexpr double kEndsSeen = 0.05;   // m, standard deviation of a bed's length of which both ends are seen
constexpr double kEndsPassed = 0.1;  // the same where the scanner has passed both: without a tailgate they lie between two scanlines
constexpr double kCabKnown = 10.0;   // evidence of a cab that tells which end is the front
constexpr double kCabLength = 2.3;   // m before the front end
constexpr double kSameCorners = 0.03, kSameCab = 0.05, kSameCabLeast = 2.0;  // m; of a cab's evidence, and at least so much of it
// rad that the scanner turns while answers stay the same: a degree, and three.
constexpr double kAgreedFor = 0.017, kSettledFor = 0.052;

bool same(const RecognisedTruck& a, const RecognisedTruck& b) {
  for (std::size_t i = 0; i < a.corners.size(); ++i)
    if ((a.corners[i] - b.corners[i]).norm() > kSameCorners) return false;
  return std::abs(a.cab - b.cab) <= std::max(kSameCabLeast, kSameCab * b.cab);
}

}  // namespace

bool OngoingRecognition::take(std::span<const ScanPoint> scanline) {
  const std::size_t before = sweep_.fans();
  sweep_.take(scanline);
  if (sweep_.fans() == before) return false;
  const bool found = answer_ && answer_->found, passes = found && passed(*answer_, 0.0);
  const bool passes_now = passes && !was_passed_;
  was_passed_ = passes;
  if (passes_now || sweep_.turn() - asked_turn_ >= kAskEvery) return true;
  const bool ends_known = found && std::sqrt(answer_->pose_covariance(6, 6)) < kEndsPassed;
  return sweep_.fans() - asked_ >= kFansBetween && (ends_known || sweep_.wall_pauses(kWall));
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
  was_passed_ = truck.found && passed(truck, 0.0);
  if (!truck.found || !settled_.found || !same(truck, settled_)) {
    settled_ = truck;
    settled_turn_ = asked_turn_;
  }
  stands_ = truck.found && hardly_changes(truck);
  return truck;
}

bool OngoingRecognition::hardly_changes(const RecognisedTruck& truck) const {
  const double same_for = asked_turn_ - settled_turn_, length_deviation = std::sqrt(truck.pose_covariance(6, 6));
  const bool cab_passed = passed(truck, kCabLength);
  if (cab_passed && same_for >= kSettledFor) return true;  // an end that was not seen will not be
  if (truck.cab < kCabKnown && !cab_passed) return false;
  return (was_passed_ && length_deviation < kEndsPassed && same_for >= kAgreedFor) || (length_deviation < kEndsSeen && same_for >= kSettledFor);
}

}  // namespace berm::app
