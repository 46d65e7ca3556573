// The rays of a sweep that come to a place.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "recognition/bed_model.hpp"
#include "recognition/fans.hpp"

namespace berm::app {

// Rays that pass within radius of middle, in plan, and there come between the heights low and high. Metres.
std::vector<Ray> rays_round(const FanSweep& sweep, const Eigen::Vector2d& middle, double radius, double low, double high);

// Rays that come to within 0.6 m of the bed's walls or opening, down to so many metres below the walls' tops.
std::vector<Ray> rays_near(const FanSweep& sweep, const BedPose& pose, double below = 1.1);

// Rays that may come to the bed, to what stands beyond its ends, or below it: within 7 m.
std::vector<Ray> rays_around(const FanSweep& sweep, const Eigen::Vector3d& middle);

}  // namespace berm::app
