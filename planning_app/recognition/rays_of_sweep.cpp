#include "recognition/rays_of_sweep.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {
namespace {

constexpr double kAround = 7.0;                        // m: half of the longest bed and a cab
constexpr double kAroundBelow = 2.2, kAroundAbove = 1.0;  // m of the walls' tops
constexpr double kBeside = 0.6;                        // m

}  // namespace

std::vector<Ray> rays_round(const FanSweep& sweep, const Eigen::Vector2d& middle, double radius, double low, double high) {
  std::vector<Ray> out;
  for (std::size_t fan = 0; fan < sweep.heads.size(); ++fan) {
    const Eigen::Vector3d& head = sweep.heads[fan];
    const Eigen::Vector2d to = middle - head.head<2>();
    for (const FanReturn& r : sweep.of(fan)) {
      const Eigen::Vector3d d = r.at - head;
      const double level = d.head<2>().norm(), along = d.head<2>().dot(to) / std::max(level, 1e-9);
      if (along <= 0.0 || to.squaredNorm() - along * along > radius * radius) continue;
      const double slope = d.z() / std::max(level, 1e-9), near = head.z() + slope * (along - radius), far = head.z() + slope * (along + radius);
      if (std::max(near, far) < low || std::min(near, far) > high) continue;
      out.push_back({head, r.at, r.upright});
    }
  }
  return out;
}

std::vector<Ray> rays_near(const FanSweep& sweep, const BedPose& pose, double below) {
  const double radius = std::hypot(pose.length / 2, pose.width / 2) + pose.thickness + kBeside;
  return rays_round(sweep, pose.middle.head<2>(), radius, pose.middle.z() - below, pose.middle.z() + kBeside);
}

std::vector<Ray> rays_around(const FanSweep& sweep, const Eigen::Vector3d& middle) {
  return rays_round(sweep, middle.head<2>(), kAround, middle.z() - kAroundBelow, middle.z() + kAroundAbove);
}

}  // namespace berm::app
