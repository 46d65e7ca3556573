// Forward kinematics of the implements. SI units; angles as in the parameter block: boom is the elevation of the boom's pin line, stick is
// relative to the boom's line, bucket to the stick's; positive turns upward. Upper body's frame: x forward, y left, z up, origin on the
// ground under the swing axis; the base frame is the same at swing 0.
#ifndef BERM_KERNEL_GEOMETRY_KINEMATICS_HPP
#define BERM_KERNEL_GEOMETRY_KINEMATICS_HPP

#include <Eigen/Geometry>

#include "config/parameter_block.h"

namespace berm::kernel {

struct JointAngles {
  double swing = 0.0, boom = 0.0, stick = 0.0, bucket = 0.0; // rad
};

JointAngles joint_angles(const int32_t (&angle_urad)[4]) noexcept;

// A link in the swing plane: r forward, z up.
struct PlanarPose {
  Eigen::Vector2d pin;   // near pin (r, z), m
  Eigen::Vector2d along; // unit vector of the link's x axis; its z axis is (-along.y, along.x)

  Eigen::Vector2d to_plane(const Eigen::Vector2d& in_link) const noexcept;
  Eigen::Vector2d to_link(const Eigen::Vector2d& in_plane) const noexcept;
};

// Poses of boom, stick and bucket, at index link - 1.
struct ImplementPose {
  PlanarPose link[3];
  Eigen::Vector2d tip; // bucket tip (r, z), m
};

class Kinematics {
public:
  explicit Kinematics(const berm_parameters& parameters) noexcept;

  ImplementPose implements(const JointAngles& angles) const noexcept;

  // From the frame of link (1 boom, 2 stick, 3 bucket; y to the left) to the base frame.
  Eigen::Isometry3d link_in_base(const JointAngles& angles, int link) const noexcept;

  Eigen::Vector3d tip_in_base(const JointAngles& angles) const noexcept;

private:
  Eigen::Vector2d boom_pin_;
  double boom_length_, stick_length_, bucket_length_;
};

} // namespace berm::kernel
#endif
