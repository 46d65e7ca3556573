#include "recognition/bed_verification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "recognition/bed_class.hpp"
#include "recognition/bed_ground.hpp"

namespace berm::app {
namespace {

constexpr double kScoreLeast = 80.0, kScoreFromBehind = 60.0;  // evidence of a bed; of one seen from behind its open rear, which shows one wall less
constexpr int kInnerBehindHeap = 11, kInnerWithCab = 90, kInnerFromBehind = 40;  // returns on inner faces where a cab is seen: at least; to do without outer ones; with little evidence
constexpr int kOuterLeast = 12, kInnerLeast = 17;  // returns on outer faces of its walls, on inner faces of its far ones (of 781 found beds: 19 at least)
constexpr double kCabSeen = 100.0;     // evidence of a cab that leaves little doubt
constexpr double kCabLikely = 28.0;     // evidence of a cab; two drawn pits and a container had 43 to 134, and only the ground told them
constexpr double kScoreOfCab = 110.0;   // evidence of the bed before such a cab
constexpr double kCabAsideShare = 0.62; // of a cab's evidence with returns in the planes of the bed's sides halved; of a container's walls 0.5
constexpr double kCabFaint = 2.0;      // evidence of anything at all where the cab would stand
constexpr double kCabLeast = -12.0;   // evidence of its cab
constexpr int kInnerBeforeCab = 50, kInnerAlone = 150;  // returns on inner faces of a bed that shows no outer one, with its cab and without
constexpr double kLengthUnsure = 0.5;  // m, standard deviation
constexpr double kLidShare = 0.83;  // of the returns over an opening; of look-alikes with a lid 0.87 at least
constexpr double kThroughFew = 8.0, kThroughShare = 0.04;  // rays through walls; of those on faces and tops: of look-alikes that nothing else refuses first 1.4 times as many at least
constexpr int kBeyondMost = 12;

// Whether a cab is seen that is no wall that goes on: most of its returns lie beside the planes of the bed's sides.
bool has_own_cab(const BedInterpretation& i) { return i.cab >= kCabLikely && i.cab >= kCabAsideShare * i.cab_seen; }

}  // namespace

std::string refusal(const FanSweep& sweep, const BedInterpretation& i, FittedBed& fit, const TruckRangeSet& ranges, bool of_refused) {
  const BedEvidence& e = i.evidence;
  const BedPose& p = fit.pose;
  // From behind an open rear the walls show their inner faces alone, and often hide the cab; from anywhere else a bed shows an outer one, unless something
  // stands before it: then a cab must be seen well.
  const double along = p.rotation().col(0).dot(sweep.heads[sweep.heads.size() / 2] - p.middle);
  const bool from_behind = p.open_end != 0 && p.open_end * along > 0.5 * p.length;
  const double score_least = from_behind && e.inner_face >= kInnerFromBehind && i.cab_seen >= kCabFaint ? kScoreFromBehind : kScoreLeast;
  if (e.score < score_least) return fmt::format("what is most like a bed is too little like one: its evidence weighs {:.0f} of the {:.0f} needed", e.score, score_least);
  if (i.cab_seen < kCabLeast) return fmt::format("rays pass where its cab would stand, at either end: evidence of {:.0f}", i.cab_seen);
  if (!fit.converged) return "the fit of the bed did not converge";
  const int over_opening = e.level_inside + e.below_inside + e.above_inside;
  if (e.level_inside > kLidShare * over_opening && over_opening >= 30)
    return fmt::format("it is closed on top: {} of {} returns over its opening lie in the plane of the walls' tops", e.level_inside, over_opening);
  if (i.cab_seen < kCabFaint) {
    find_covariance(fit, ranges.bed_sizes());
    const double unsure = std::sqrt(fit.covariance(6, 6));
    if (unsure > kLengthUnsure) return fmt::format("it has no cab, and its length is known to {:.2f} m only: an end of it is not seen", unsure);
  }
  const TruckRangeSet classes = some_classes_of(fit, ranges);
  if (classes.classes.empty())
    return fmt::format("its opening of {:.2f} by {:.2f} m with walls {:.2f} m thick is outside every class of trucks", p.length, p.width, p.thickness);
  const bool own_cab = e.score >= kScoreOfCab && has_own_cab(i), inner_alone = from_behind || i.cab_seen >= kCabSeen || (own_cab && e.inner_face >= kInnerWithCab);
  if (e.outer_face < kOuterLeast && (!inner_alone || e.inner_face < (i.cab_seen < kCabFaint ? kInnerAlone : kInnerBeforeCab)))
    return fmt::format("the bed has {} returns on outer faces of its walls, and needs {}", e.outer_face, kOuterLeast);
  // A closed box, a lorry's board or a trench box matches as well from outside: the far walls' inside tells a bed.
  const int inner_least = own_cab ? kInnerBehindHeap : kInnerLeast;
  if (e.inner_face < inner_least) return fmt::format("the bed has {} returns on inner faces of its far walls, and needs {}", e.inner_face, inner_least);
  const int explained = e.outer_face + e.inner_face + e.wall_top;
  if (e.through > kThroughFew + kThroughShare * explained) return fmt::format("{} rays pass through its walls, {} agree with them", e.through, explained);
  const int beyond = sides_beyond(sweep, p, i.cab_end);
  if (beyond > kBeyondMost) return fmt::format("{} returns lie where its sides would go on beyond its ends", beyond);
  const std::vector<double> beside = depths_beside(sweep, p);
  if (standing_on(beside, classes).classes.empty()) {
    const SizeRange over_ground = classes.hull(&TruckRanges::top_over_ground);
    return fmt::format("{:.1f} % of the returns beside it lie {:.2f} to {:.2f} m below the walls' tops, where the ground would be", 100 * share_of_ground(beside, over_ground), over_ground[0],
                       over_ground[1]);
  }
  if (lies_in_level_ground(sweep, p, i.cab_end)) return "the ground beyond it lies level with its walls' tops: a pit";
  if (i.cab_seen < kCabSeen && !(own_cab && i.cab >= kCabOwn)) {
    // Without a cab, what goes on beyond the lengths of trucks' beds is a container.
    const double further = longer_length(sweep, p, ranges, i.cab_seen);
    if (further > 0.0) return fmt::format("it goes on for {:.2f} m, longer than every class of trucks", further);
  }
  // Of many places one agrees by chance with something.
  if (of_refused && i.cab_seen < kCabLikely) return "with another end it is like a bed, but has no cab";
  return {};
}

}  // namespace berm::app
