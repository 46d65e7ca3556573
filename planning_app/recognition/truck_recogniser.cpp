#include "recognition/truck_recogniser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace berm::app {
namespace {

constexpr double kScoreLeast = 62.0;  // evidence of a bed
constexpr double kPi = 3.14159265358979323846;

// For a cab beyond an end of the bed: rays that end where every cab has its lower half, less those that pass through there.
int cab_evidence(const FanSweep& sweep, const BedPose& pose, int side) {
  const Eigen::Matrix3d rotation = pose.rotation();
  const double begin = pose.length / 2 + pose.thickness + 0.5;
  const Eigen::Array3d low(side > 0 ? begin : -begin - 0.8, -1.0, -1.9), high(side > 0 ? begin + 0.8 : -begin, 1.0, -1.0);
  int count = 0;
  for (const FanReturn& r : sweep.returns) {
    const Eigen::Vector3d a = rotation.transpose() * (sweep.heads[r.fan] - pose.middle), end = rotation.transpose() * (r.at - pose.middle);
    const Eigen::Array3d d = end - a, first = (low - a.array()) / d, second = (high - a.array()) / d;
    const double in = first.min(second).maxCoeff(), out = first.max(second).minCoeff(), range = (end - a).norm();
    if (in >= out || in <= 0.0 || in * range > range + 0.5) continue;
    count += out * range + 0.15 < range ? -1 : 1;
  }
  return count;
}

void turn_round(BedPose& pose) {
  pose.yaw = std::remainder(pose.yaw + kPi, 2 * kPi);
  pose.pitch = -pose.pitch;
  pose.roll = -pose.roll;
  pose.open_end = -pose.open_end;
}

// Where rays cross the outer face of a wall that faces the sensor: how deep below its top those that end there are, and those that pass.
struct FaceDepths {
  std::vector<double> hits, passes;
};

FaceDepths face_depths(const BedPose& pose, const std::vector<Ray>& rays, int axis) {
  FaceDepths out;
  const Eigen::Matrix3d rotation = pose.rotation();
  for (const Ray& ray : rays) {
    const Eigen::Vector3d a = rotation.transpose() * (ray.head - pose.middle), d = rotation.transpose() * (ray.at - ray.head);
    const int side = a[axis] > 0.0 ? 1 : -1;
    const double face = pose.face(axis, side, true);
    if (std::abs(a[axis]) < face || (axis == 0 && side == pose.open_end)) continue;
    const double share = (side * face - a[axis]) / d[axis];
    const Eigen::Vector3d at = a + share * d;
    if (share < 0.0 || std::abs(at[1 - axis]) > pose.face(1 - axis, 1, false) || at.z() > -0.5) continue;
    const double off = (1.0 - share) * d.norm();
    if (std::abs(off) < 0.1) out.hits.push_back(-at.z());
    else if (off > 0.0) out.passes.push_back(-at.z());
  }
  return out;
}

// The depth at which hits on an outer face give way to rays that pass below the wall, by the fewest contradictions; at least that of the load's or
// floor's deeper returns. An end wall reaches down to the floor in every class, the side of a half pipe does not.
double wall_height(const BedPose& pose, const std::vector<Ray>& rays, const TruckRangeSet& ranges) {
  const SizeRange heights = ranges.hull(&TruckRanges::wall_height);
  FaceDepths depths = face_depths(pose, rays, 0);
  if (depths.hits.size() < 12 || depths.passes.size() < 6) depths = face_depths(pose, rays, 1);
  double best = 0.5 * (heights[0] + heights[1]);
  long least = 1L << 30;
  for (double h = heights[0]; h <= heights[1]; h += 0.02) {
    const long wrong = std::count_if(depths.hits.begin(), depths.hits.end(), [h](double x) { return x > h; }) +
                       std::count_if(depths.passes.begin(), depths.passes.end(), [h](double x) { return x < h; });
    if (wrong < least) least = wrong, best = h;
  }
  std::vector<double> inside;
  const Eigen::Matrix3d rotation = pose.rotation();
  for (const Ray& ray : rays) {
    const RayMeeting m = meet(pose, rotation, ray);
    if (m.what == Meeting::inside) inside.push_back(-m.end.z());
  }
  if (inside.size() >= 10) {
    const auto deep = inside.begin() + static_cast<std::ptrdiff_t>(inside.size() * 9 / 10);
    std::nth_element(inside.begin(), deep, inside.end());
    best = std::max(best, *deep);
  }
  return best;
}

// Of the returns within 1.5 m outside the walls, the share that lies as low as the ground beside a truck.
double share_low_beside(const FanSweep& sweep, const BedPose& pose) {
  const Eigen::Matrix3d rotation = pose.rotation();
  int low = 0, all = 0;
  for (const FanReturn& r : sweep.returns) {
    const Eigen::Vector3d p = rotation.transpose() * (r.at - pose.middle);
    const double beyond = std::max(std::abs(p.x()) - pose.length / 2, std::abs(p.y()) - pose.width / 2) - pose.thickness;
    if (beyond < 0.2 || beyond > 1.5) continue;
    ++all;
    low += p.z() < -1.5 ? 1 : 0;
  }
  return all == 0 ? 1.0 : static_cast<double>(low) / all;
}

// Why the bed is none; empty when it is one.
std::string refusal(const FanSweep& sweep, const BedInterpretation& i, const FittedBed& fit, const TruckRangeSet& ranges) {
  const BedEvidence& e = i.evidence;
  const BedPose& p = fit.pose;
  if (e.score < kScoreLeast)
    return fmt::format("what is most like a bed is too little like one: its evidence weighs {:.0f} of the {:.0f} needed", e.score, kScoreLeast);
  if (!fit.converged) return "the fit of the bed did not converge";
  // From behind an open rear the walls show their inner faces alone.
  if (e.outer_face < 12 && (p.open_end == 0 || e.inner_face < 150))
    return fmt::format("the bed has {} returns on outer faces of its walls, and needs 12", e.outer_face);
  // A closed box, a lorry's board or a trench box matches as well from outside: the far walls' inside tells a bed.
  if (e.inner_face < 8) return fmt::format("the bed has {} returns on inner faces of its far walls, and needs 8", e.inner_face);
  const int explained = e.outer_face + e.inner_face + e.wall_top + e.inside;
  if (e.through > 0.15 * explained) return fmt::format("{} rays pass through its walls, {} agree with them", e.through, explained);
  const int over_opening = e.level_inside + e.below_inside + e.above_inside;
  if (e.level_inside > 0.75 * over_opening && over_opening >= 10)
    return fmt::format("it is closed on top: {} of {} returns over its opening lie in the plane of the walls' tops", e.level_inside, over_opening);
  const double low = share_low_beside(sweep, p);
  if (low < 0.15) return fmt::format("the ground beside it lies too high: {:.0f} % of the returns there are 1.5 m below the walls' tops", 100 * low);
  if (ranges.find(p.length, p.width, p.open_end != 0) == nullptr)
    return fmt::format("its opening of {:.2f} by {:.2f} m is outside every class of trucks", p.length, p.width);
  return {};
}

RecognisedTruck recognise(const std::vector<ScanPoint>& points, const std::array<double, 3>& viewpoint, const TruckRangeSet& ranges) {
  RecognisedTruck out;
  const FanSweep sweep = make_fans(points, viewpoint);
  out.reason = sweep.reason;
  if (!out.reason.empty()) return out;
  const std::vector<UprightRegion> regions = upright_regions(sweep, upright_segments(sweep));
  out.reason = "the sweep shows no upright wall";
  if (regions.empty()) return out;
  std::vector<BedInterpretation> interpretations = interpret(sweep, regions, ranges);
  out.reason = "no upright wall can be one of a bed";
  if (interpretations.empty()) return out;
  // The one that survives verification with the most evidence; with none, why the first did not.
  FittedBed fit;
  BedInterpretation best;
  for (BedInterpretation& i : interpretations) {
    FittedBed own = fit_bed(i.pose, i.rays, 3);
    i.rays = rays_near(sweep, own.pose);
    i.evidence = weigh(own.pose, i.rays);
    const std::string why = refusal(sweep, i, own, ranges);
    if (why.empty() ? i.evidence.score > best.evidence.score : &i == &interpretations.front()) {
      out.evidence = i.evidence;
      out.pose = own.pose;
      out.reason = why;
    }
    if (!why.empty() || i.evidence.score <= best.evidence.score) continue;
    fit = own;
    best = i;
  }
  if (!out.reason.empty()) return out;

  const bool reversed = fit.pose.open_end != 0 ? fit.pose.open_end == 1 : cab_evidence(sweep, fit.pose, -1) > cab_evidence(sweep, fit.pose, 1);
  if (reversed) {
    turn_round(fit.pose);
    const Eigen::Matrix<double, 8, 1> sign{1, 1, 1, 1, -1, -1, 1, 1};
    fit.covariance = sign.asDiagonal() * fit.covariance * sign.asDiagonal();
  }
  out.found = true;
  out.pose = fit.pose;
  out.truck_class = ranges.find(fit.pose.length, fit.pose.width, fit.pose.open_end != 0)->name;
  out.corners = opening_corners(fit.pose);
  out.yaw = fit.pose.yaw;
  out.length = fit.pose.length;
  out.width = fit.pose.width;
  out.height = wall_height(fit.pose, rays_near(sweep, fit.pose, 2.5), ranges);
  out.open_rear = fit.pose.open_end != 0;
  out.pose_covariance = fit.covariance;
  out.covariance = corner_covariance(fit);
  return out;
}

}  // namespace

RecognisedTruck recognise_truck(const std::vector<ScanPoint>& points, const std::array<double, 3>& viewpoint, const TruckRangeSet& ranges) {
  const auto begin = std::chrono::steady_clock::now();
  RecognisedTruck out = recognise(points, viewpoint, ranges);
  out.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  return out;
}

}  // namespace berm::app
