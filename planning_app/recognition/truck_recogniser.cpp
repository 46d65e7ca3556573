#include "recognition/truck_recogniser.hpp"

#include <time.h>

#include <algorithm>
#include <cmath>

#include "recognition/bed_choice.hpp"
#include "recognition/bed_class.hpp"
#include "recognition/bed_ground.hpp"
#include "recognition/bed_height.hpp"
#include "recognition/bed_other_ends.hpp"
#include "recognition/bed_refinement.hpp"
#include "recognition/bed_verification.hpp"

namespace berm::app {
namespace {

constexpr int kLastRounds = 4;           // of the last fit
constexpr double kPolishStep = 0.06;     // m
constexpr int kPolishHalvings = 3, kPolishRounds = 3;
constexpr std::size_t kPolishStride = 2;  // of rays, while walls are moved
constexpr double kBelowTops = 2.5;        // m, of rays that may tell the floor
constexpr double kPeakOfFound = 0.88, kPeakOfRefused = 0.7;  // of the evidence of a bed that was found, or refused, for one with another end to be looked at
constexpr double kEndsNearly = 0.85;   // of the evidence of what would be chosen, to be polished beside it
constexpr int kEndRounds = 3;           // of looking for other ends of what would be chosen
constexpr double kEndsWorth = 40.0, kEndsOfRefused = 80.0;  // evidence of a bed, to be looked at so; of one that was refused
constexpr double kPlanesWorth = 60.0;    // evidence of a bed, to look for the canopy that tells its front
constexpr int kPasses = 2;              // where all that a pass found was refused, one looks at the rest
constexpr double kPi = 3.14159265358979323846;

void turn_round(BedPose& pose) {
  pose.yaw = std::remainder(pose.yaw + kPi, 2 * kPi);
  pose.pitch = -pose.pitch;
  pose.roll = -pose.roll;
  pose.open_end = -pose.open_end;
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

// A sweep with what is level in it.
struct Seen {
  const FanSweep& sweep;
  LevelRegionsOfBeds level;
};

// The tree's last levels where they may decide something of the bed, and what must be true of all that is matched.
void judge(Seen& seen, VerifiedBed& v, const TruckRangeSet& ranges) {
  v.interpretation.pose = v.fit.pose;
  const bool either_front = v.fit.pose.open_end == 0 && v.interpretation.evidence.score >= kPlanesWorth;
  v.planes = either_front ? match_level_planes(v.fit.pose, seen.level.about(v.fit.pose.middle), ranges) : LevelPlanes{};
  weigh_whole(seen.sweep, v.interpretation, true, v.planes.canopy ? v.planes.canopy->end : 0);
  v.refusal = refusal(seen.sweep, v.interpretation, v.fit, ranges, v.of_refused);
}

VerifiedBed verify(Seen& seen, BedInterpretation interpretation, const TruckRangeSet& ranges, bool of_refused = false) {
  VerifiedBed v;
  v.of_refused = of_refused;
  v.interpretation = std::move(interpretation);
  v.fit = fit_pose(v.interpretation.pose, v.interpretation.rays, PackedRays(v.interpretation.rays), kLastRounds, ranges.bed_sizes());
  judge(seen, v, ranges);
  return v;
}

void polish(Seen& seen, VerifiedBed& v, const TruckRangeSet& ranges) {
  auto [fit, agreed] = polished(v.fit, v.interpretation.rays, ranges.bed_sizes());
  v.fit = std::move(fit);
  v.agreed = agreed;
  v.polished = true;
  judge(seen, v, ranges);
}

// Polishes what would be chosen, until that is a bed that is polished; where none is a bed, all, for a hollow may be why.
void polish_chosen(Seen& seen, std::vector<VerifiedBed>& all, const TruckRangeSet& ranges) {
  const auto less = [](const VerifiedBed& a, const VerifiedBed& b) {
    if (a.polished != b.polished) return a.polished;
    return a.interpretation.whole() < b.interpretation.whole();
  };
  while (true) {
    const VerifiedBed& chosen = choose(all, ranges);
    if (chosen.polished && chosen.refusal.empty()) return;
    VerifiedBed& next = chosen.polished ? *std::max_element(all.begin(), all.end(), less) : all[static_cast<std::size_t>(&chosen - all.data())];
    if (next.polished) return;
    polish(seen, next, ranges);
  }
}

// Where what would be chosen may have an end elsewhere, the bed with that end as well, until what would be chosen was looked at so.
void move_ends_of_chosen(Seen& seen, std::vector<VerifiedBed>& all, const TruckRangeSet& ranges) {
  SizeRange lengths = ranges.hull(&TruckRanges::inside_length);
  lengths[0] -= ranges.slack, lengths[1] += ranges.slack;
  for (int round = 0; round < kEndRounds; ++round) {
    VerifiedBed& chosen = all[static_cast<std::size_t>(&choose(all, ranges) - all.data())];
    if (chosen.ends_moved || chosen.interpretation.evidence.score < (chosen.refusal.empty() ? kEndsWorth : kEndsOfRefused)) return;
    chosen.ends_moved = true;
    const bool refused = !chosen.refusal.empty();
    const BedPose from = chosen.fit.pose;
    std::vector<BedPose> others = other_ends(seen.sweep, chosen.fit.pose, lengths, refused ? kPeakOfRefused : kPeakOfFound);
    std::erase_if(others, [&](const BedPose& p) { return is_bed_with_cab(p, chosen.interpretation); });
    for (const BedPose& p : others) {
      BedInterpretation i;
      i.pose = p;
      i.rays = rays_near(seen.sweep, p);
      VerifiedBed v = verify(seen, std::move(i), ranges, refused);
      v.ends_moved = true;
      if (comes_back(v.fit.pose, from)) continue;
      if (decides(v) > kEndsNearly * decides(choose(all, ranges))) polish(seen, v, ranges);
      all.push_back(std::move(v));
    }
    polish_chosen(seen, all, ranges);
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
  Seen seen{sweep, LevelRegionsOfBeds(sweep)};
  std::vector<VerifiedBed> verified;
  std::vector<BedPose> refused;
  for (int pass = 0; pass < kPasses; ++pass) {
    std::vector<BedInterpretation> interpretations = interpret(sweep, rough, ranges, refused);
    if (interpretations.empty()) break;
    const std::size_t before = verified.size();
    for (BedInterpretation& i : interpretations) {
      if (!may_be_chosen(i, verified)) continue;
      move_walls(sweep, i, ranges);
      refused.push_back(i.pose);
      if (std::any_of(verified.begin() + static_cast<std::ptrdiff_t>(before), verified.end(), [&](const VerifiedBed& v) { return same_and_better(v.interpretation, i); })) continue;
      verified.push_back(verify(seen, std::move(i), ranges));
      refused.push_back(verified.back().fit.pose);
    }
    polish_chosen(seen, verified, ranges);
    move_ends_of_chosen(seen, verified, ranges);
    if (choose(verified, ranges).refusal.empty()) break;
  }
  out.reason = "no upright wall can be one of a bed";
  if (verified.empty()) return out;
  const VerifiedBed& chosen = choose(verified, ranges);
  const BedInterpretation& best = chosen.interpretation;
  FittedBed fit = chosen.fit;
  if (chosen.refusal.empty()) {  // with every ray
    FittedBed last = fit_bed(fit.pose, rays_near(whole, fit.pose), kPolishRounds, ranges.bed_sizes(), BedSolver::ceres);
    if (last.converged && !classes_of(last, ranges).classes.empty()) fit = std::move(last);
    else find_covariance(fit, ranges.bed_sizes());
  }
  out.evidence = best.evidence;
  out.cab = best.cab_seen;
  out.pose = fit.pose;
  const std::vector<double> beside = depths_beside(sweep, fit.pose);
  out.planes = match_level_planes(fit.pose, seen.level.about(fit.pose.middle), ranges, ground_below(beside));
  out.reason = chosen.refusal;
  if (!out.reason.empty()) return out;

  const TruckRangeSet of_sizes = classes_of(fit, ranges), on_ground = standing_on(beside, of_sizes);
  const TruckRangeSet& classes = on_ground.classes.empty() ? of_sizes : on_ground;
  const BedHeight height = bed_height(fit, rays_near(whole, fit.pose, kBelowTops), classes, out.planes.floor ? out.planes.floor->flatness : 0.0);
  out.reason = refusal_of_height(height, classes);
  if (!out.reason.empty()) return out;

  out.truck_class = class_told(fit, height, classes, out.planes.canopy.has_value()).name;
  if (best.cab_end < 0) {
    turn_round(fit.pose);
    const Eigen::Matrix<double, 8, 1> sign{1, 1, 1, 1, -1, -1, 1, 1};
    fit.covariance = sign.asDiagonal() * fit.covariance * sign.asDiagonal();
  }
  out.found = true;
  out.pose = fit.pose;
  out.corners = opening_corners(fit.pose);
  out.yaw = fit.pose.yaw;
  out.length = fit.pose.length;
  out.width = fit.pose.width;
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
