#include "recognition/truck_recogniser.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

namespace berm::app {
namespace {

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

// The depth at which hits on the outer faces give way to rays that pass below the walls, by the fewest contradictions; at least the deepest return
// inside.
double wall_height(const BedPose& pose, const std::vector<Ray>& rays, const TruckRangeSet& ranges) {
  const SizeRange heights = ranges.hull(&TruckRanges::wall_height);
  const Eigen::Matrix3d rotation = pose.rotation();
  std::vector<double> hits, misses, inside;
  for (const Ray& ray : rays) {
    const Eigen::Vector3d a = rotation.transpose() * (ray.head - pose.middle), p = rotation.transpose() * (ray.at - pose.middle);
    const double face = pose.face(1, 1, true), side = a.y() > 0.0 ? 1.0 : -1.0;
    if (meet(pose, rotation, ray).what == Meeting::inside) inside.push_back(-p.z());
    if (std::abs(a.y()) < face) continue;
    const Eigen::Vector3d d = p - a;
    const double share = (side * face - a.y()) / d.y();
    const Eigen::Vector3d at = a + share * d;
    if (share < 0.0 || std::abs(at.x()) > pose.length / 2 || at.z() > -0.5) continue;
    const double off = (1.0 - share) * d.norm();
    if (std::abs(off) < 0.1) hits.push_back(-at.z());
    else if (off > 0.0) misses.push_back(-at.z());
  }
  double best = 0.5 * (heights[0] + heights[1]);
  long least = 1L << 30;
  for (double h = heights[0]; h <= heights[1]; h += 0.02) {
    const auto below = [h](double x) { return x > h; };
    const long wrong = std::count_if(hits.begin(), hits.end(), below) + std::count_if(misses.begin(), misses.end(), [h](double x) { return x < h; });
    if (wrong < least) least = wrong, best = h;
  }
  if (inside.size() >= 10) {
    const auto deep = inside.begin() + static_cast<std::ptrdiff_t>(inside.size() * 9 / 10);
    std::nth_element(inside.begin(), deep, inside.end());
    best = std::max(best, *deep);
  }
  return best;
}

// Why the bed is none; empty when it is one.
std::string refusal(const BedInterpretation& i, const FittedBed& fit, const TruckRangeSet& ranges) {
  const BedEvidence& e = i.evidence;
  const BedPose& p = fit.pose;
  if (e.score < 40.0) return fmt::format("what is most like a bed is too little like one: its evidence weighs {:.0f} of the 40 needed", e.score);
  if (!fit.converged) return "the fit of the bed did not converge";
  if (e.outer_face < 12) return fmt::format("the bed has {} returns on outer faces of its walls, and needs 12", e.outer_face);
  const int explained = e.outer_face + e.inner_face + e.wall_top + e.inside;
  if (e.through > 0.15 * explained) return fmt::format("{} rays pass through its walls, {} agree with them", e.through, explained);
  const int over_opening = e.level_inside + e.below_inside + e.above_inside;
  if (e.level_inside > 0.75 * over_opening && over_opening >= 10)
    return fmt::format("it is closed on top: {} of {} returns over its opening lie in the plane of the walls' tops", e.level_inside, over_opening);
  if (e.inside + e.inner_face < 10 && e.above_inside < 10) return "nothing was seen of the inside of the bed";
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
    const std::string why = refusal(i, own, ranges);
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
  out.height = wall_height(fit.pose, best.rays, ranges);
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
