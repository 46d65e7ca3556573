#include "geometry/kinematics.hpp"

#include <cmath>

namespace berm::kernel {
namespace {

constexpr double metres_per_mm = 1e-3;
constexpr double rad_per_urad = 1e-6;

Eigen::Vector2d direction(double elevation) noexcept { return {std::cos(elevation), std::sin(elevation)}; }

} // namespace

JointAngles joint_angles(const int32_t (&angle_urad)[4]) noexcept {
  return {angle_urad[0] * rad_per_urad, angle_urad[1] * rad_per_urad, angle_urad[2] * rad_per_urad, angle_urad[3] * rad_per_urad};
}

Eigen::Vector2d PlanarPose::to_plane(const Eigen::Vector2d& in_link) const noexcept {
  return pin + in_link.x() * along + in_link.y() * Eigen::Vector2d(-along.y(), along.x());
}

Eigen::Vector2d PlanarPose::to_link(const Eigen::Vector2d& in_plane) const noexcept {
  const Eigen::Vector2d offset = in_plane - pin;
  return {offset.dot(along), along.x() * offset.y() - along.y() * offset.x()};
}

Kinematics::Kinematics(const berm_parameters& parameters) noexcept
    : boom_pin_(parameters.boom_pin_x_mm * metres_per_mm, parameters.boom_pin_z_mm * metres_per_mm),
      boom_length_(parameters.boom_length_mm * metres_per_mm),
      stick_length_(parameters.stick_length_mm * metres_per_mm),
      bucket_length_(parameters.bucket_length_mm * metres_per_mm) {}

ImplementPose Kinematics::implements(const JointAngles& angles) const noexcept {
  const Eigen::Vector2d boom = direction(angles.boom);
  const Eigen::Vector2d stick = direction(angles.boom + angles.stick);
  const Eigen::Vector2d bucket = direction(angles.boom + angles.stick + angles.bucket);
  const Eigen::Vector2d stick_pin = boom_pin_ + boom_length_ * boom;
  const Eigen::Vector2d bucket_pin = stick_pin + stick_length_ * stick;
  return {{{boom_pin_, boom}, {stick_pin, stick}, {bucket_pin, bucket}}, bucket_pin + bucket_length_ * bucket};
}

Eigen::Isometry3d Kinematics::link_in_base(const JointAngles& angles, int link) const noexcept {
  const PlanarPose pose = implements(angles).link[link - 1];
  const double c = std::cos(angles.swing), s = std::sin(angles.swing);
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear().col(0) = Eigen::Vector3d(pose.along.x() * c, pose.along.x() * s, pose.along.y());
  out.linear().col(1) = Eigen::Vector3d(-s, c, 0.0);
  out.linear().col(2) = Eigen::Vector3d(-pose.along.y() * c, -pose.along.y() * s, pose.along.x());
  out.translation() = Eigen::Vector3d(pose.pin.x() * c, pose.pin.x() * s, pose.pin.y());
  return out;
}

Eigen::Vector3d Kinematics::tip_in_base(const JointAngles& angles) const noexcept {
  const Eigen::Vector2d tip = implements(angles).tip;
  return {tip.x() * std::cos(angles.swing), tip.x() * std::sin(angles.swing), tip.y()};
}

} // namespace berm::kernel
