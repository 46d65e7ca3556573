#include "io/lidar_mount.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/height_map.h"

namespace berm::kernel {

LidarMount lidar_mount(const berm_lidar_mount& from) {
  LidarMount mount;
  mount.place = Eigen::Vector3d(from.x_mm, from.y_mm, from.z_mm) * 1e-3;
  const Eigen::AngleAxisd yaw(from.yaw_urad * 1e-6, Eigen::Vector3d::UnitZ()), pitch(from.pitch_urad * 1e-6, Eigen::Vector3d::UnitY());
  mount.turn = (yaw * pitch * Eigen::AngleAxisd(from.roll_urad * 1e-6, Eigen::Vector3d::UnitX())).toRotationMatrix();
  return mount;
}

sk_point lidar_base_point(const Eigen::Vector3d& upper, double cosine, double sine) {
  const auto mm = [](double m) { return static_cast<std::int32_t>(std::lround(m * 1e3)); };
  const auto z = static_cast<std::int32_t>(std::ceil(upper.z() * 1e3));
  return {mm(cosine * upper.x() - sine * upper.y()), mm(sine * upper.x() + cosine * upper.y()), std::clamp(z, -SK_HEIGHT_MAX_MM, SK_HEIGHT_MAX_MM)};
}

}  // namespace berm::kernel
