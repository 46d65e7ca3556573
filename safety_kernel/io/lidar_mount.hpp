// Where a lidar sits on the upper body.
#pragma once

#include <Eigen/Core>

#include "config/parameter_block.h"
#include "core/scanline_raster.h"

namespace berm::kernel {

struct LidarMount {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();     // upper body's frame, m
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  // from the sensor's frame
};

LidarMount lidar_mount(const berm_lidar_mount& from);

// A point of the upper body's frame (m) in the base frame, the upper body being swung. The height is rounded up, so that the map's bounds the return.
sk_point lidar_base_point(const Eigen::Vector3d& upper, double cosine, double sine);

}  // namespace berm::kernel
