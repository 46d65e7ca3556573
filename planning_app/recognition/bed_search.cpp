#include "recognition/bed_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "recognition/bed_ends.hpp"
#include "recognition/bed_fit.hpp"
#include "recognition/bed_ground.hpp"
#include "recognition/bed_refinement.hpp"
#include "recognition/cab_profile.hpp"
#include "recognition/region_strips.hpp"

namespace berm::app {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kRegionsMost = 14;
constexpr std::size_t kCoarseRays = 900, kCoarseStride = 2;                            // that first decide between interpretations
constexpr std::size_t kEndsOfStrip = 4, kOfRegion = 5, kBehindCab = 2, kOfPairs = 8, kFitted = 24, kFittedEnds = 16;  // most candidates
constexpr double kRoughWorth = 0.2, kFittedWorth = 0.4;  // of the best one's evidence, to be fitted
constexpr double kHopeful = 10.0;  // evidence of a bed, from which a fit, or moving its walls, may come to that of one that is accepted
constexpr double kLengthSlack = 0.25;                                   // m, of what is fitted later
constexpr double kRefineStep = 0.06;                                     // m
constexpr int kLiftHalvings = 2, kRefineHalvings = 3;
constexpr std::size_t kLiftRays = 300;                                  // by which a rough bed is lifted
constexpr std::size_t kEndsRays = 1500, kLongerRays = 1200;             // by which the ends of a fitted bed, and something longer, are looked for
constexpr std::size_t kRefineStride = 2;                                // of rays, while walls are moved
// What is only to be compared is fitted in few rounds to every second of its rays: what is chosen is fitted to all of them later.
constexpr int kFitRounds = 3;
constexpr std::size_t kFitStride = 2;
constexpr double kHeightUnsure = 0.15;                                  // m, before a fit
constexpr std::size_t kGroundStride = 8;                                // of returns
constexpr double kBeyondFrom = 0.25, kBeyondTo = 1.2, kBeyondGate = 0.07, kBeyondBelow = 0.05;  // m: beyond an end; of a return from a side
constexpr double kLongest = 2.5;                                        // m, by which something longer is looked for
constexpr double kLongerBy = 1.04;                                      // its evidence, to be taken for it

double whole(const BedEnds& e) { return with_cab(e.bed, e.cab); }
double whole(const BedInterpretation& i) { return i.whole(); }

// The best that are not alike, the best first, and of those what is worth this share of the first at least; none like one that was refused.
template <typename Candidate>
std::vector<Candidate> distinct(std::vector<Candidate> all, std::size_t most, double worth = 0.0, const std::vector<BedPose>& refused = {}) {
  std::erase_if(all, [&](const Candidate& c) {
    return std::any_of(refused.begin(), refused.end(), [&](const BedPose& r) { return alike(c.pose, r); });
  });
  std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return whole(a) > whole(b); });
  std::vector<Candidate> out;
  for (Candidate& c : all) {
    if (out.size() >= most || (!out.empty() && whole(c) < worth * whole(out.front()))) break;
    if (std::none_of(out.begin(), out.end(), [&](const Candidate& o) { return alike(c.pose, o.pose); })) out.push_back(std::move(c));
  }
  return out;
}

double bed(const BedEnds& e) { return e.bed; }
double bed(const BedInterpretation& i) { return i.evidence.score; }

// Leaves those that may still become a bed; where none may, the one that is most like one, so that something can be said of it.
template <typename Candidate>
void leave_hopeful(std::vector<Candidate>& all) {
  const auto hopeless = [](const Candidate& c) { return bed(c) < kHopeful; };
  if (all.size() < 2) return;
  if (!std::all_of(all.begin(), all.end(), hopeless)) {
    std::erase_if(all, hopeless);
    return;
  }
  std::iter_swap(all.begin(), std::max_element(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return bed(a) < bed(b); }));
  all.erase(all.begin() + 1, all.end());
}

BedStrip strip_of(const BedPose& p) { return {p.middle, p.yaw, p.pitch, p.roll, p.width, p.thickness, 0.0}; }

// Beds of which the region may be a face.
std::vector<BedEnds> interpret_region(const FanSweep& sweep, const UprightRegion& region, const TruckRangeSet& ranges, const SizeRange& lengths) {
  const Vector2d middle = 0.5 * (region.first + region.last);
  const SomeRays some = about(sweep, around_bed({middle.x(), middle.y(), region.high}), kCoarseRays, kCoarseStride);
  const auto add = [&](std::vector<BedEnds>& to, const std::vector<BedStrip>& strips, std::size_t of_each) {
    for (const BedStrip& strip : strips)
      for (BedEnds& e : best_ends(strip, some.rays, lengths, some.share, of_each)) to.push_back(std::move(e));
  };
  std::vector<BedEnds> found, behind;
  add(found, strips_of(region, ranges), kEndsOfStrip);
  add(found, strips_within(region, ranges, sweep.heads[sweep.heads.size() / 2].head<2>()), kEndsOfStrip);
  found = distinct(std::move(found), kOfRegion);
  // What the region agrees with as a bed's end must not keep out beds of which it is the cab's front.
  add(behind, strips_behind(region, ranges), 1);
  for (BedEnds& e : distinct(std::move(behind), kBehindCab)) found.push_back(std::move(e));
  return found;
}

// Beds of which two regions may be the sides.
std::vector<BedEnds> interpret_pairs(const FanSweep& sweep, const std::vector<UprightRegion>& regions, const TruckRangeSet& ranges, const SizeRange& lengths) {
  std::vector<BedEnds> found;
  for (std::size_t i = 0; i < regions.size(); ++i)
    for (std::size_t k = i + 1; k < regions.size(); ++k)
      for (const BedStrip& strip : strips_of(regions[i], regions[k], ranges)) {
        const SomeRays some = about(sweep, around_bed(strip.middle), kCoarseRays, kCoarseStride);
        for (BedEnds& e : best_ends(strip, some.rays, lengths, some.share, kEndsOfStrip)) found.push_back(std::move(e));
      }
  return distinct(std::move(found), kOfPairs);
}

struct Weighed {
  BedPose pose;
  double score = 0.0;
};

// The pose after a fit, where that agrees better with the rays.
Weighed fitted(const FanSweep& sweep, const BedPose& start, const BedSizes& sizes) {
  const std::vector<Ray> rays = rays_near(sweep, start, kNearBelow, kFitStride);
  const PackedRays packed(rays);
  const FittedBed fit = fit_pose(start, rays, packed, kFitRounds, sizes);
  const double before = score_of(start, packed), after = fit.converged ? score_of(fit.pose, packed) : before;
  return after > before ? Weighed{fit.pose, after} : Weighed{start, before};
}

SizeRange fitted_lengths(const TruckRangeSet& ranges) {
  SizeRange lengths = ranges.hull(&TruckRanges::inside_length);
  lengths[0] -= kLengthSlack, lengths[1] += kLengthSlack;
  return lengths;
}

// Those whose tops are as high over what lies about them as a truck's. One that is not, a bench's face, may agree with far more rays.
std::vector<BedEnds> over_ground(const FanSweep& sweep, std::vector<BedEnds> all, const TruckRangeSet& ranges) {
  SizeRange high = ranges.hull(&TruckRanges::top_over_ground);
  high[0] -= kHeightUnsure, high[1] += kHeightUnsure;
  std::erase_if(all, [&](const BedEnds& e) { return share_of_ground(depths_beside(sweep, e.pose, kGroundStride), high, kGroundStride) < 0.5 * kGroundLeast; });
  return all;
}

}  // namespace

bool alike(const BedPose& a, const BedPose& b) {
  return a.open_end == b.open_end && (a.middle - b.middle).norm() < 0.25 && std::abs(std::remainder(a.yaw - b.yaw, std::numbers::pi)) < 0.1 &&
         std::abs(a.length - b.length) < 0.3;
}

double BedInterpretation::whole() const { return with_cab(evidence.score, cab); }

void weigh_whole(const FanSweep& sweep, BedInterpretation& i, bool to_front, int canopy_end) {
  const BedPose& p = i.pose;
  i.rays = rays_near(sweep, p);
  i.evidence = weigh(p, i.rays);
  CabProfile profile(p.width / 2, p.face(1, 1, true));
  profile.take(p, PassingRays(sweep, around_cabs(p, to_front ? kCabFarthest : kCabNear)).packed(1));
  profile.finish();
  const double at_front = p.face(0, 1, true), at_rear = -p.face(0, -1, true);
  const double front = profile.beyond(at_front, 1, 1.0, CabProfile::Returns::all), rear = profile.beyond(at_rear, -1, 1.0, CabProfile::Returns::all);
  i.cab_end = p.open_end != 0 ? -p.open_end : canopy_end != 0 ? canopy_end : front >= rear ? 1 : -1;
  i.cab_seen = i.cab_end > 0 ? front : rear;
  i.cab = i.cab_end > 0 ? profile.beyond(at_front, 1, 1.0) : profile.beyond(at_rear, -1, 1.0);
  if (to_front) i.cab_to_front = profile.to_front(i.cab_end > 0 ? at_front : at_rear, i.cab_end, 1.0);
}

double longer_length(const FanSweep& sweep, const BedPose& pose, const TruckRangeSet& ranges, double cab) {
  const SizeRange usual = ranges.hull(&TruckRanges::inside_length);
  const SomeRays some = about(sweep, around_bed(pose.middle), kLongerRays);
  const auto longer = best_ends(strip_of(pose), some.rays, {usual[1] + kLengthSlack, usual[1] + kLongest}, some.share, 1);
  if (longer.empty()) return 0.0;
  const auto within = best_ends(strip_of(pose), some.rays, usual, some.share, 1);
  if (within.empty() || longer.front().bed < kLongerBy * (within.front().bed + std::max(0.0, cab))) return 0.0;
  return longer.front().pose.length;
}

int sides_beyond(const FanSweep& sweep, const BedPose& pose, int cab_end) {
  const Eigen::Matrix3d turn = pose.rotation().transpose();
  int count = 0;
  visit_around(sweep, pose.middle, [&](std::size_t fan, std::size_t k) {
    const Eigen::Vector3d p = turn * (sweep.returns[k].at() - pose.middle);
    if (p.z() > -kBeyondBelow || p.z() < -kWallSeen) return;
    const int end = p.x() > 0.0 ? 1 : -1;
    const double beyond = end * p.x() - pose.length / 2;
    if (beyond < kBeyondFrom || beyond > kBeyondTo) return;
    const double sensor = (turn * (sweep.heads[fan] - pose.middle)).y();
    const bool far_inner = std::abs(std::abs(p.y()) - pose.width / 2) < kBeyondGate && p.y() * sensor < 0.0;
    const bool near_outer = std::abs(std::abs(p.y()) - pose.face(1, 1, true)) < kBeyondGate && p.y() * sensor > 0.0 && end != cab_end;
    const bool flat_cab = end == cab_end && !sweep.returns[k].upright;  // its roof
    count += (far_inner || near_outer) && !flat_cab ? 1 : 0;
  });
  return count;
}

std::vector<BedEnds> rough_beds(const FanSweep& sweep, const std::vector<UprightRegion>& regions, const TruckRangeSet& ranges) {
  const SizeRange lengths = fitted_lengths(ranges);
  const std::vector<UprightRegion> largest(regions.begin(), regions.begin() + static_cast<std::ptrdiff_t>(std::min(regions.size(), kRegionsMost)));
  std::vector<BedEnds> found = interpret_pairs(sweep, largest, ranges, lengths);
  for (const UprightRegion& region : largest)
    for (BedEnds& e : interpret_region(sweep, region, ranges, lengths)) found.push_back(std::move(e));
  return over_ground(sweep, std::move(found), ranges);
}

std::vector<BedInterpretation> interpret(const FanSweep& sweep, const std::vector<BedEnds>& rough_ones, const TruckRangeSet& ranges,
                                         const std::vector<BedPose>& refused) {
  const SizeRange lengths = fitted_lengths(ranges);
  const BedSizes sizes = ranges.bed_sizes();
  std::vector<BedEnds> ends;
  for (const BedEnds& rough : distinct(rough_ones, kFitted, kRoughWorth, refused)) {
    const PackedRays near = about(sweep, near_bed(rough.pose), kLiftRays).rays;
    const BedPose lifted = refined(levelled(rough.pose, near), near, sizes.width, kRefineStep, kLiftHalvings);
    const auto [p, score] = fitted(sweep, lifted, sizes);
    ends.push_back({p, rough.cab_end, score, rough.cab});
    const SomeRays around = about(sweep, around_bed(p.middle), kEndsRays);
    for (BedEnds& e : best_ends(strip_of(p), around.rays, lengths, around.share, kEndsOfStrip)) ends.push_back(std::move(e));
  }
  leave_hopeful(ends);
  std::vector<BedInterpretation> out;
  for (const BedEnds& e : distinct(std::move(ends), kFittedEnds, kFittedWorth, refused)) {
    BedInterpretation i;
    i.pose = fitted(sweep, e.pose, sizes).pose;
    weigh_whole(sweep, i);
    out.push_back(std::move(i));
  }
  out = distinct(std::move(out), kInterpretations, kFittedWorth, refused);
  leave_hopeful(out);
  return out;
}

void move_walls(const FanSweep& sweep, BedInterpretation& i, const TruckRangeSet& ranges) {
  if (bed(i) < kHopeful) return;
  i.pose = refined(i.pose, PackedRays(every(i.rays, kRefineStride)), ranges.bed_sizes().width, kRefineStep, kRefineHalvings);
  weigh_whole(sweep, i);
}

}  // namespace berm::app
