#include "recognition/bed_choice.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "recognition/bed_verification.hpp"
#include "recognition/cab_profile.hpp"

namespace berm::app {
namespace {

constexpr double kCabShortest = 0.8, kCabLongest = 3.2;  // m beyond a bed's end
constexpr double kMuchBetter = 1.1;
constexpr double kMovesGain = 1.6;      // of evidence, by moves of walls: hardly more; 1.25 lost two trucks in 300
constexpr double kCameBack = 0.1;       // m, of the middle and the length together

// Whether both say that something stands at the same place: more than half of the shorter one's length.
bool same_place(const BedPose& a, const BedPose& b) {
  if (std::abs(std::remainder(a.yaw - b.yaw, std::numbers::pi)) > 0.1) return false;
  const Eigen::Vector2d u(std::cos(a.yaw), std::sin(a.yaw)), between = b.middle.head<2>() - a.middle.head<2>();
  const double along = std::abs(u.dot(between)), across = std::abs(u.x() * between.y() - u.y() * between.x());
  return across < 0.3 && 0.5 * (a.length + b.length) - along > 0.5 * std::min(a.length, b.length);
}

double with_own_cab(const BedInterpretation& i) { return with_cab(i.evidence.score, i.cab_seen); }

// Evidence from which something that is none, and of which the bed is a part, is taken instead of it. Where that is longer than every truck's bed, or the bed was cut from it, the bed needs a cab that its own
// sides do not explain: it may be a part of a container's walls.
double worth_of_whole(const VerifiedBed& bed, const VerifiedBed& whole, double longest) {
  return bed.of_refused || whole.fit.pose.length > longest ? with_cab(bed.interpretation.evidence.score, bed.interpretation.cab) : kMuchBetter * with_own_cab(bed.interpretation);
}

}  // namespace

bool is_bed_with_cab(const BedPose& longer, const BedInterpretation& i) {
  if (i.cab < kCabOwn) return false;
  const BedPose& p = i.pose;
  const Eigen::Vector2d u(std::cos(p.yaw), std::sin(p.yaw));
  const double middle = i.cab_end * u.dot(longer.middle.head<2>() - p.middle.head<2>()), further = middle + 0.5 * longer.length - 0.5 * p.length;
  return further > kCabShortest && further < kCabLongest;
}

double decides(const VerifiedBed& v) {
  const BedEvidence& e = v.interpretation.evidence;
  return std::max(v.agreed, e.score) - e.end_face + closed_by(e.end_face, v.interpretation.cab_to_front);
}

const VerifiedBed& choose(const std::vector<VerifiedBed>& all, const TruckRangeSet& ranges) {
  const double longest = ranges.hull(&TruckRanges::inside_length)[1] + ranges.slack;
  const auto less = [](const VerifiedBed& a, const VerifiedBed& b) {
    if (a.refusal.empty() != b.refusal.empty()) return b.refusal.empty();
    if (!a.refusal.empty()) return a.interpretation.evidence.score < b.interpretation.evidence.score;
    return decides(a) < decides(b);
  };
  const VerifiedBed* best = &*std::max_element(all.begin(), all.end(), less);
  if (!best->refusal.empty()) return *best;
  const VerifiedBed* whole = best;
  for (const VerifiedBed& v : all)
    if (!v.refusal.empty() && v.interpretation.evidence.score > (whole == best ? worth_of_whole(*best, v, longest) : kMuchBetter * with_own_cab(whole->interpretation)) &&
        same_place(v.interpretation.pose, best->interpretation.pose) && !is_bed_with_cab(v.interpretation.pose, best->interpretation))
      whole = &v;
  return *whole;
}

bool may_be_chosen(const BedInterpretation& i, const std::vector<VerifiedBed>& all) {
  return std::none_of(all.begin(), all.end(), [&](const VerifiedBed& v) {
    return v.refusal.empty() && kMovesGain * i.whole() < v.interpretation.whole() &&
           kMovesGain * i.evidence.score < kMuchBetter * with_own_cab(v.interpretation);
  });
}

bool comes_back(const BedPose& to, const BedPose& from) { return (to.middle - from.middle).norm() + std::abs(to.length - from.length) < kCameBack; }

}  // namespace berm::app
