#include "geometry/self_filter.hpp"

#include <algorithm>
#include <cmath>

namespace berm::kernel {
namespace {

constexpr double metres_per_mm = 1e-3;

double distance_squared_to_segment(double px, double pz, double ax, double az, double bx, double bz) noexcept {
  const double ex = bx - ax, ez = bz - az;
  const double length_squared = ex * ex + ez * ez;
  const double along = length_squared > 0.0 ? std::clamp(((px - ax) * ex + (pz - az) * ez) / length_squared, 0.0, 1.0) : 0.0;
  const double dx = px - (ax + along * ex), dz = pz - (az + along * ez);
  return dx * dx + dz * dz;
}

} // namespace

SelfFilter::SelfFilter(const berm_parameters& parameters) noexcept
    : kinematics_(parameters),
      margin_(parameters.self_margin_mm * metres_per_mm),
      body_radius_(parameters.own_body_radius_mm * metres_per_mm) {
  const int parts = std::clamp<int>(parameters.parts, 0, BERM_PARTS);
  for (int i = 0; i < parts; ++i) {
    const berm_part& shape = parameters.part[i];
    if (shape.link < 1 || shape.link > 3) continue; // refused by the parameter check long before
    Part& part = part_[parts_++];
    part.link = shape.link;
    part.vertices = std::clamp<int>(shape.vertices, 1, BERM_PART_VERTICES);
    part.half_width = shape.half_width_mm * metres_per_mm + margin_;
    part.x_low = part.z_low = INFINITY;
    part.x_high = part.z_high = -INFINITY;
    for (int v = 0; v < part.vertices; ++v) {
      part.x[v] = shape.vertex_mm[v][0] * metres_per_mm;
      part.z[v] = shape.vertex_mm[v][1] * metres_per_mm;
      part.x_low = std::min(part.x_low, part.x[v] - margin_);
      part.x_high = std::max(part.x_high, part.x[v] + margin_);
      part.z_low = std::min(part.z_low, part.z[v] - margin_);
      part.z_high = std::max(part.z_high, part.z[v] + margin_);
    }
  }
}

bool SelfFilter::near_outline(const Part& part, const Eigen::Vector2d& in_link) const noexcept {
  const double x = in_link.x(), z = in_link.y();
  if (!(x >= part.x_low && x <= part.x_high && z >= part.z_low && z <= part.z_high)) return false;
  bool inside = true;
  for (int i = 0, j = part.vertices - 1; i < part.vertices; j = i++) {
    const double side = (part.x[i] - part.x[j]) * (z - part.z[j]) - (part.z[i] - part.z[j]) * (x - part.x[j]);
    if (side < 0.0) inside = false; // counter-clockwise: the inside lies to the left
    if (distance_squared_to_segment(x, z, part.x[j], part.z[j], part.x[i], part.z[i]) <= margin_ * margin_) return true;
  }
  return inside;
}

bool SelfFilter::is_own(const Eigen::Vector3d& point, const ImplementPose& pose) const noexcept {
  if (point.z() < body_height_m && point.x() * point.x() + point.y() * point.y() < body_radius_ * body_radius_ && std::isfinite(point.z())) return true;
  return is_implement(point, pose);
}

bool SelfFilter::is_implement(const Eigen::Vector3d& point, const ImplementPose& pose) const noexcept {
  for (int i = 0; i < parts_; ++i) {
    const Part& part = part_[i];
    if (std::fabs(point.y()) > part.half_width) continue;
    if (near_outline(part, pose.link[part.link - 1].to_link({point.x(), point.z()}))) return true;
  }
  return false;
}

} // namespace berm::kernel
