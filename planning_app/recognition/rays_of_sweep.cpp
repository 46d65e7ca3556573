#include "recognition/rays_of_sweep.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {
namespace {

using Eigen::Vector2d;

constexpr double kBeside = 0.6;           // m
constexpr std::size_t kExpected = 4096;  // rays

}  // namespace

std::vector<Ray> rays_round(const FanSweep& sweep, const Vector2d& middle, double radius, double low, double high) {
  std::vector<Ray> out;
  out.reserve(kExpected);
  visit_rays(sweep, middle, radius, low, high, [&](std::size_t fan, std::size_t k) {
    out.push_back({sweep.heads[fan], sweep.returns[k].at, sweep.returns[k].upright});
  });
  return out;
}

std::vector<Ray> rays_near(const FanSweep& sweep, const BedPose& pose, double below) {
  const double radius = std::hypot(pose.length / 2, pose.width / 2) + pose.thickness + kBeside;
  return rays_round(sweep, pose.middle.head<2>(), radius, pose.middle.z() - below, pose.middle.z() + kBeside);
}

std::vector<Ray> rays_around(const FanSweep& sweep, const Eigen::Vector3d& middle) {
  return rays_round(sweep, middle.head<2>(), kAround, middle.z() - kAroundBelow, middle.z() + kAroundAbove);
}

std::vector<Ray> every(const std::vector<Ray>& rays, std::size_t stride) {
  std::vector<Ray> some;
  for (std::size_t i = 0; i < rays.size(); i += stride) some.push_back(rays[i]);
  return some;
}

SomeRays about(const std::vector<Ray>& rays, std::size_t most, std::size_t least) {
  const std::size_t stride = std::max(least, rays.size() / most);
  return {every(rays, stride), static_cast<double>(stride)};
}

}  // namespace berm::app
