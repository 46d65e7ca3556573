// The rays of a sweep that come to a place.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "recognition/bed_model.hpp"
#include "recognition/fans.hpp"

namespace berm::app {

// Takes every return, by fan and by number, whose ray passes within radius of middle, in plan, and there comes between the heights low and high. Metres.
template <typename Take>
void visit_rays(const FanSweep& sweep, const Eigen::Vector2d& middle, double radius, double low, double high, const Take& take) {
  for (std::size_t fan = 0; fan < sweep.heads.size(); ++fan) {
    const Eigen::Vector3d& head = sweep.heads[fan];
    const Eigen::Vector2d to = middle - head.head<2>();
    const double square = to.squaredNorm();
    const FanPlan& plan = sweep.plans[fan];
    if (std::abs(plan.normal.dot(to)) > radius + plan.spread * std::sqrt(square) + 1e-6) continue;  // the whole fan passes it
    for (std::size_t k = sweep.begin[fan]; k < sweep.begin[fan + 1]; ++k) {
      const FanDirection& d = sweep.directions[k];
      const double along = d.level.dot(to);
      if (along <= 0.0 || square - along * along > radius * radius) continue;
      const double near = head.z() + d.slope * (along - radius), far = head.z() + d.slope * (along + radius);
      if (std::max(near, far) >= low && std::min(near, far) <= high) take(fan, k);
    }
  }
}

// Rays that pass within radius of middle, in plan, and there come between the heights low and high. Metres.
std::vector<Ray> rays_round(const FanSweep& sweep, const Eigen::Vector2d& middle, double radius, double low, double high);

// Rays that come to within 0.6 m of the bed's walls or opening, down to so many metres below the walls' tops.
std::vector<Ray> rays_near(const FanSweep& sweep, const BedPose& pose, double below = 1.1);

// The same for the rays of rays_around.
constexpr double kAround = 7.0;                           // m: half of the longest bed and a cab
constexpr double kAroundBelow = 2.2, kAroundAbove = 1.0;  // m of the walls' tops
template <typename Take>
void visit_around(const FanSweep& sweep, const Eigen::Vector3d& middle, const Take& take) {
  visit_rays(sweep, middle.head<2>(), kAround, middle.z() - kAroundBelow, middle.z() + kAroundAbove, take);
}

// Every stride-th of the rays.
std::vector<Ray> every(const std::vector<Ray>& rays, std::size_t stride);

// Of the rays about so many, evenly, and at most every least-th; each stands for `share` of them.
struct SomeRays {
  std::vector<Ray> rays;
  double share = 1.0;
};
SomeRays about(const std::vector<Ray>& rays, std::size_t most, std::size_t least = 1);

// Rays that may come to the bed, to what stands beyond its ends, or below it: within 7 m.
std::vector<Ray> rays_around(const FanSweep& sweep, const Eigen::Vector3d& middle);

}  // namespace berm::app
