#include "recognition/truck_recogniser.hpp"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>

#include "recognition/bed_ground.hpp"
#include "recognition/bed_height.hpp"
#include "recognition/bed_other_ends.hpp"
#include "recognition/bed_refinement.hpp"
#include "recognition/cab_profile.hpp"

namespace berm::app {
namespace {

constexpr double kScoreLeast = 80.0, kScoreFromBehind = 60.0;  // evidence of a bed; of one seen from behind its open rear, which shows one wall less
constexpr int kInnerBehindHeap = 11, kInnerWithCab = 90, kInnerFromBehind = 40;  // returns on inner faces where a cab is seen: at least; to do without outer ones; with little evidence
constexpr int kOuterLeast = 12, kInnerLeast = 17;  // returns on outer faces of its walls, on inner faces of its far ones (of 781 found beds: 19 at least)
constexpr double kCabSeen = 100.0;     // evidence of a cab that leaves little doubt
constexpr double kCabOwn = 40.0;       // evidence of a cab that the bed's sides, were they longer, would not explain
constexpr double kCabLikely = 28.0;     // evidence of a cab: a pit, a container show 21 at most that is not of their sides
constexpr double kScoreOfCab = 110.0;   // evidence of the bed before such a cab
constexpr double kCabAsideShare = 0.62; // of a cab's evidence with returns in the planes of the bed's sides halved; of a container's walls 0.5
constexpr double kCabShortest = 0.8, kCabLongest = 3.2;  // m beyond a bed's end
constexpr double kCabFaint = 2.0;      // evidence of anything at all where the cab would stand
constexpr double kCabLeast = -12.0;   // evidence of its cab
constexpr int kInnerBeforeCab = 50, kInnerAlone = 150;  // returns on inner faces of a bed that shows no outer one, with its cab and without
constexpr int kLastRounds = 4;           // of the last fit
constexpr double kPolishStep = 0.06;     // m
constexpr int kPolishHalvings = 3, kPolishRounds = 3;
constexpr std::size_t kPolishStride = 2;  // of rays, while walls are moved
constexpr double kBelowTops = 2.5;        // m, of rays that may tell the floor
constexpr double kLengthUnsure = 0.5;  // m, standard deviation
constexpr double kLengthOpen = 0.12;   // m, of a length outside a class, at most: look-alikes are 0.3 m outside and more
constexpr double kMuchBetter = 1.1;
constexpr double kMovesGain = 1.6;      // of evidence, by moves of walls: hardly more; 1.25 lost two trucks in 300
constexpr double kLidShare = 0.83;  // of the returns over an opening; of look-alikes with a lid 0.87 at least
constexpr double kThroughFew = 8.0, kThroughShare = 0.04;  // rays through walls; of those on faces and tops: of look-alikes that nothing else refuses first 1.4 times as many at least
constexpr int kBeyondMost = 12;
constexpr double kEndsNearly = 0.85;   // of the evidence of what would be chosen, to be polished beside it
constexpr int kEndRounds = 3;           // of looking for other ends of what would be chosen
constexpr double kEndsWorth = 40.0;     // evidence of a bed, to be looked at so
constexpr int kPasses = 2;              // where all that a pass found was refused, one looks at the rest
constexpr double kPi = 3.14159265358979323846;

void turn_round(BedPose& pose) {
  pose.yaw = std::remainder(pose.yaw + kPi, 2 * kPi);
  pose.pitch = -pose.pitch;
  pose.roll = -pose.roll;
  pose.open_end = -pose.open_end;
}

// The class that takes in its sizes, or would with a length that its deviation leaves open; nullptr when none does.
const TruckRanges* class_of(FittedBed& fit, const TruckRangeSet& ranges) {
  const BedPose& p = fit.pose;
  const TruckRanges* found = ranges.find(p.length, p.width, p.open_end != 0);
  if (found != nullptr || !fit.converged) return found;
  find_covariance(fit, ranges.bed_sizes());
  const double open = std::min(kLengthOpen, 2 * std::sqrt(fit.covariance(6, 6)));
  for (const double by : {open, -open})
    if (found == nullptr) found = ranges.find(p.length + by, p.width, p.open_end != 0);
  return found;
}

// Whether a cab is seen that is no wall that goes on: most of its returns lie beside the planes of the bed's sides.
bool has_own_cab(const BedInterpretation& i) { return i.cab >= kCabLikely && i.cab >= kCabAsideShare * i.cab_seen; }

// Why the bed is none; empty when it is one.
std::string refusal(const FanSweep& sweep, const BedInterpretation& i, FittedBed& fit, const TruckRangeSet& ranges) {
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
  if (class_of(fit, ranges) == nullptr)
    return fmt::format("its opening of {:.2f} by {:.2f} m is outside every class of trucks", p.length, p.width);
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
  const SizeRange over_ground = ranges.hull(&TruckRanges::top_over_ground);
  const double ground = share_of_ground(sweep, p, over_ground);
  if (ground < kGroundLeast && !own_cab)
    return fmt::format("{:.1f} % of the returns beside it lie {:.2f} to {:.2f} m below the walls' tops, where the ground would be", 100 * ground, over_ground[0], over_ground[1]);
  if (!own_cab && lies_in_level_ground(sweep, p, i.cab_end)) return "the ground beyond it lies level with its walls' tops: a pit";
  if (i.cab_seen < kCabSeen && !(own_cab && i.cab >= kCabOwn)) {
    // Without a cab, what goes on beyond the lengths of trucks' beds is a container.
    const double further = longer_length(sweep, p, ranges, i.cab_seen);
    if (further > 0.0) return fmt::format("it goes on for {:.2f} m, longer than every class of trucks", further);
  }
  return {};
}

struct Polished {
  FittedBed fit;
  double agreed = 0.0;  // evidence of the bed as its walls were moved, before they were fitted
};

// The fit, or another that begins where moves of its walls agree better with the rays, for a fit may have ended in a hollow: the better of both.
Polished polished(const FittedBed& first, const std::vector<Ray>& rays, const BedSizes& sizes) {
  const BedPose moved = refined(first.pose, PackedRays(every(rays, kPolishStride)), sizes.width, kPolishStep, kPolishHalvings);
  const PackedRays packed(rays);
  const FittedBed second = fit_pose(moved, rays, packed, kPolishRounds, sizes);
  const bool better = second.converged && (!first.converged || score_of(second.pose, packed) > score_of(first.pose, packed));
  return {better ? second : first, score_of(moved, packed)};
}

struct Verified {
  BedInterpretation interpretation;
  FittedBed fit;
  std::string refusal;  // empty: it is a bed
  bool polished = false;
  double agreed = 0.0;      // evidence of the bed as its walls were moved when it was polished: a fit may lose some of it
  bool ends_moved = false;  // its ends were looked for elsewhere
  bool of_refused = false;  // one end of it was, and what had another there was refused
};

void judge(const FanSweep& sweep, Verified& v, const TruckRangeSet& ranges) {
  v.interpretation.pose = v.fit.pose;
  weigh_whole(sweep, v.interpretation);
  v.refusal = refusal(sweep, v.interpretation, v.fit, ranges);
  // Of many places one agrees by chance with something.
  if (v.of_refused && v.refusal.empty() && v.interpretation.cab_seen < kCabLikely) v.refusal = "with another end it is like a bed, but has no cab";
}

Verified verify(const FanSweep& sweep, BedInterpretation interpretation, const TruckRangeSet& ranges) {
  Verified v;
  v.interpretation = std::move(interpretation);
  v.fit = fit_pose(v.interpretation.pose, v.interpretation.rays, PackedRays(v.interpretation.rays), kLastRounds, ranges.bed_sizes());
  judge(sweep, v, ranges);
  return v;
}

void polish(const FanSweep& sweep, Verified& v, const TruckRangeSet& ranges) {
  auto [fit, agreed] = polished(v.fit, v.interpretation.rays, ranges.bed_sizes());
  v.fit = std::move(fit);
  v.agreed = agreed;
  v.polished = true;
  judge(sweep, v, ranges);
}

// Whether both say that something stands at the same place: more than half of the shorter one's length.
bool same_place(const BedPose& a, const BedPose& b) {
  if (std::abs(std::remainder(a.yaw - b.yaw, kPi)) > 0.1) return false;
  const Eigen::Vector2d u(std::cos(a.yaw), std::sin(a.yaw)), between = b.middle.head<2>() - a.middle.head<2>();
  const double along = std::abs(u.dot(between)), across = std::abs(u.x() * between.y() - u.y() * between.x());
  return across < 0.3 && 0.5 * (a.length + b.length) - along > 0.5 * std::min(a.length, b.length);
}

// Whether it goes on beyond the bed's cab end for as long as a cab, where there is evidence of one that the bed's own sides do not explain: bed and cab taken for one.
bool is_bed_with_cab(const BedPose& longer, const BedInterpretation& i) {
  if (i.cab < kCabOwn) return false;
  const BedPose& p = i.pose;
  const Eigen::Vector2d u(std::cos(p.yaw), std::sin(p.yaw));
  const double middle = i.cab_end * u.dot(longer.middle.head<2>() - p.middle.head<2>()), further = middle + 0.5 * longer.length - 0.5 * p.length;
  return further > kCabShortest && further < kCabLongest;
}

double with_own_cab(const BedInterpretation& i) { return with_cab(i.evidence.score, i.cab_seen); }

// Evidence from which something that is none, and of which the bed is a part, is taken instead of it. Where that is longer than every truck's bed, or the bed was cut from it, the bed needs a cab that its own
// sides do not explain: it may be a part of a container's walls.
double worth_of_whole(const Verified& bed, const Verified& whole, double longest) {
  return bed.of_refused || whole.fit.pose.length > longest ? with_cab(bed.interpretation.evidence.score, bed.interpretation.cab) : kMuchBetter * with_own_cab(bed.interpretation);
}

// What decides between beds: evidence that moves of its walls came to counts, for a fit may lose a part of it. What closes the bed, an end's outer face and the cab, counts for no more than there
// being one: from before a truck its cab's front has as many returns as all of the bed, and agrees with it as the bed's front wall.
double decides(const Verified& v) {
  const BedEvidence& e = v.interpretation.evidence;
  return std::max(v.agreed, e.score) - e.end_face + std::min(e.end_face + v.interpretation.cab_to_front, kCabEnough);
}

// The bed with the most evidence; with none, of those refused the one most like a bed, whatever stands beyond its ends. A bed that is only a part of something that agrees with the rays
// much better than bed and cab do, and is none, is none either: a container. A bed and its cab taken for one long bed are no better than both.
const Verified& choose(const std::vector<Verified>& all, const TruckRangeSet& ranges) {
  const double longest = ranges.hull(&TruckRanges::inside_length)[1] + ranges.slack;
  const auto less = [](const Verified& a, const Verified& b) {
    if (a.refusal.empty() != b.refusal.empty()) return b.refusal.empty();
    if (!a.refusal.empty()) return a.interpretation.evidence.score < b.interpretation.evidence.score;
    return decides(a) < decides(b);
  };
  const Verified* best = &*std::max_element(all.begin(), all.end(), less);
  if (!best->refusal.empty()) return *best;
  const Verified* whole = best;
  for (const Verified& v : all)
    if (!v.refusal.empty() && v.interpretation.evidence.score > (whole == best ? worth_of_whole(*best, v, longest) : kMuchBetter * with_own_cab(whole->interpretation)) &&
        same_place(v.interpretation.pose, best->interpretation.pose) && !is_bed_with_cab(v.interpretation.pose, best->interpretation))
      whole = &v;
  return *whole;
}

// Polishes what would be chosen, until that is a bed that is polished; where none is a bed, all, for a hollow may be why.
void polish_chosen(const FanSweep& sweep, std::vector<Verified>& all, const TruckRangeSet& ranges) {
  const auto less = [](const Verified& a, const Verified& b) {
    if (a.polished != b.polished) return a.polished;
    return a.interpretation.whole() < b.interpretation.whole();
  };
  while (true) {
    const Verified& chosen = choose(all, ranges);
    if (chosen.polished && chosen.refusal.empty()) return;
    Verified& next = chosen.polished ? *std::max_element(all.begin(), all.end(), less) : all[static_cast<std::size_t>(&chosen - all.data())];
    if (next.polished) return;
    polish(sweep, next, ranges);
  }
}

// What its walls' moves can add to an interpretation does not make it better than a bed that was found, nor something of which that is but a part.
bool may_be_chosen(const BedInterpretation& i, const std::vector<Verified>& all) {
  return std::none_of(all.begin(), all.end(), [&](const Verified& v) {
    return v.refusal.empty() && kMovesGain * i.whole() < v.interpretation.whole() &&
           kMovesGain * i.evidence.score < kMuchBetter * with_own_cab(v.interpretation);
  });
}

// Where what would be chosen may have an end elsewhere, the bed with that end as well, until what would be chosen was looked at so.
void move_ends_of_chosen(const FanSweep& sweep, std::vector<Verified>& all, const TruckRangeSet& ranges) {
  SizeRange lengths = ranges.hull(&TruckRanges::inside_length);
  lengths[0] -= ranges.slack, lengths[1] += ranges.slack;
  for (int round = 0; round < kEndRounds; ++round) {
    Verified& chosen = all[static_cast<std::size_t>(&choose(all, ranges) - all.data())];
    if (chosen.ends_moved || chosen.interpretation.evidence.score < kEndsWorth) return;
    chosen.ends_moved = true;
    const bool refused = !chosen.refusal.empty();
    std::vector<BedPose> others = other_ends(sweep, chosen.fit.pose, lengths);
    std::erase_if(others, [&](const BedPose& p) { return is_bed_with_cab(p, chosen.interpretation); });
    for (const BedPose& p : others) {
      BedInterpretation i;
      i.pose = p;
      i.rays = rays_near(sweep, p);
      Verified v = verify(sweep, std::move(i), ranges);
      v.ends_moved = true, v.of_refused = refused;
      if (decides(v) > kEndsNearly * decides(choose(all, ranges))) polish(sweep, v, ranges);
      else if (refused) judge(sweep, v, ranges);
      all.push_back(std::move(v));
    }
    polish_chosen(sweep, all, ranges);
  }
}

bool same_and_better(const BedInterpretation& than, const BedInterpretation& i) { return alike(than.pose, i.pose) && than.whole() >= i.whole(); }

// Of CPU, so that a busy machine measures the same.
double thread_milliseconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

RecognisedTruck recognise(ArrivingSweep& scanlines, const TruckRangeSet& ranges) {
  RecognisedTruck out;
  const auto [reason, whole, sweep, regions] = scanlines.view();
  out.reason = reason;
  if (!out.reason.empty()) return out;
  out.reason = "the sweep shows no upright wall";
  if (regions.empty()) return out;
  const std::vector<BedEnds> rough = rough_beds(sweep, regions, ranges);
  std::vector<Verified> verified;
  std::vector<BedPose> refused;
  for (int pass = 0; pass < kPasses; ++pass) {
    std::vector<BedInterpretation> interpretations = interpret(sweep, rough, ranges, refused);
    if (interpretations.empty()) break;
    const std::size_t before = verified.size();
    for (BedInterpretation& i : interpretations) {
      if (!may_be_chosen(i, verified)) continue;
      move_walls(sweep, i, ranges);
      refused.push_back(i.pose);
      if (std::any_of(verified.begin() + static_cast<std::ptrdiff_t>(before), verified.end(), [&](const Verified& v) { return same_and_better(v.interpretation, i); })) continue;
      verified.push_back(verify(sweep, std::move(i), ranges));
      refused.push_back(verified.back().fit.pose);
    }
    polish_chosen(sweep, verified, ranges);
    move_ends_of_chosen(sweep, verified, ranges);
    if (choose(verified, ranges).refusal.empty()) break;
  }
  out.reason = "no upright wall can be one of a bed";
  if (verified.empty()) return out;
  const Verified& chosen = choose(verified, ranges);
  const BedInterpretation& best = chosen.interpretation;
  FittedBed fit = chosen.fit;
  if (chosen.refusal.empty()) {  // with every ray
    const FittedBed last = fit_bed(fit.pose, rays_near(whole, fit.pose), kPolishRounds, ranges.bed_sizes(), BedSolver::ceres);
    if (FittedBed l = last; last.converged && class_of(l, ranges) != nullptr) fit = last;
    else find_covariance(fit, ranges.bed_sizes());
  }
  out.evidence = best.evidence;
  out.cab = best.cab_seen;
  out.pose = fit.pose;
  out.reason = chosen.refusal;
  if (!out.reason.empty()) return out;

  if (best.cab_end < 0) {
    turn_round(fit.pose);
    const Eigen::Matrix<double, 8, 1> sign{1, 1, 1, 1, -1, -1, 1, 1};
    fit.covariance = sign.asDiagonal() * fit.covariance * sign.asDiagonal();
  }
  out.found = true;
  out.pose = fit.pose;
  out.truck_class = class_of(fit, ranges)->name;
  out.corners = opening_corners(fit.pose);
  out.yaw = fit.pose.yaw;
  out.length = fit.pose.length;
  out.width = fit.pose.width;
  const BedHeight height = bed_height(fit, rays_near(whole, fit.pose, kBelowTops), ranges);
  out.height = height.height;
  out.height_deviation = height.deviation;
  out.open_rear = fit.pose.open_end != 0;
  out.pose_covariance = fit.covariance;
  out.covariance = corner_covariance(fit);
  return out;
}

}  // namespace

RecognisedTruck recognise_truck(ArrivingSweep& scanlines, const TruckRangeSet& ranges) {
  const double begin = thread_milliseconds();
  RecognisedTruck out = recognise(scanlines, ranges);
  out.milliseconds = thread_milliseconds() - begin;
  return out;
}

RecognisedTruck recognise_truck(std::span<const ScanPoint> points, const std::array<double, 3>& viewpoint, const TruckRangeSet& ranges) {
  const double begin = thread_milliseconds();
  ArrivingSweep scanlines(viewpoint);
  visit_scanlines(points, [&](std::span<const ScanPoint> scanline) { scanlines.take(scanline); });
  RecognisedTruck out = recognise(scanlines, ranges);
  out.milliseconds = thread_milliseconds() - begin;
  return out;
}

}  // namespace berm::app
