#include "recognition/rays_of_sweep.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {
namespace {

using Eigen::Vector2d;

constexpr double kAround = 7.0;                        // m: half of the longest bed and a cab
constexpr double kAroundBelow = 2.2, kAroundAbove = 1.0;  // m of the walls' tops
constexpr double kBeside = 0.6;                        // m

}  // namespace

std::vector<Ray> rays_round(const FanSweep& sweep, const Vector2d& middle, double radius, double low, double high) {
  std::vector<Ray> out;
  for (std::size_t fan = 0; fan < sweep.heads.size(); ++fan) {
    const Eigen::Vector3d& head = sweep.heads[fan];
    const Vector2d to = middle - head.head<2>();
    const double square = to.squaredNorm();
    const FanPlan& plan = sweep.plans[fan];
    if (std::abs(plan.normal.dot(to)) > radius + plan.spread * std::sqrt(square) + 1e-6) continue;
    for (std::size_t k = sweep.begin[fan]; k < sweep.begin[fan + 1]; ++k) {
      const FanDirection& d = sweep.directions[k];
      const double along = d.level.dot(to);
      if (along <= 0.0 || square - along * along > radius * radius) continue;
      const double near = head.z() + d.slope * (along - radius), far = head.z() + d.slope * (along + radius);
      if (std::max(near, far) < low || std::min(near, far) > high) continue;
      out.push_back({head, sweep.returns[k].at, sweep.returns[k].upright});
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
