// By what lies within a bed, how deep its floor may lie below the tops: that of a box, and the lowest line of a half pipe.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "recognition/bed_model.hpp"
#include "recognition/depth_weights.hpp"

namespace berm::app {

// A ray in the bed's frame.
struct PlacedRay { Eigen::Vector3d from, end; };

struct ReturnsWithin {
  std::vector<double> floors;         // depths at which a box's floor lies if these are of it
  std::vector<double> pipes, beside;  // the same of a half pipe's; and of the same returns how deep they lie
  std::vector<double> faces;          // how deep those on inner faces lie
};
ReturnsWithin returns_within(const BedPose& pose, const std::vector<PlacedRay>& rays);

// Nothing lies deeper than the floor, a bed without load shows it, and a load may lie as flat as a box's; far walls go down to it.
// flatness: of what is level within, as for bed_height.
DepthWeights weigh_box_inside(const ReturnsWithin& returns, double flatness);
DepthWeights weigh_pipe_inside(const ReturnsWithin& returns, double flatness);

}  // namespace berm::app
