// The solids that rays are cast against. Here with their bodies: a sensor casts hundreds of thousands of rays a second.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "plant/machine/kinematics.hpp"
#include "plant/world/vec3.hpp"

namespace berm::plant {

// Narrows [t_in, t_out] to where a * t <= b; false when nothing is left.
inline bool clip(double a, double b, double& t_in, double& t_out) {
  if (a == 0) return b >= 0;
  const double t = b / a;
  if (a > 0) t_out = std::min(t_out, t);
  else t_in = std::max(t_in, t);
  return t_in <= t_out;
}

inline bool clip_slab(double origin, double direction, double low, double high, double& t_in, double& t_out) {
  return clip(direction, high - origin, t_in, t_out) && clip(-direction, origin - low, t_in, t_out);
}

// Where a ray enters and leaves an axis-aligned box, as far as it does before range_max; enters at 0 from within.
inline std::optional<std::array<double, 2>> cross_box(const Ray& ray, const Vec3& low, const Vec3& high, double range_max) {
  double t_in = 0, t_out = range_max;
  if (!clip_slab(ray.origin.x, ray.direction.x, low.x, high.x, t_in, t_out)) return std::nullopt;
  if (!clip_slab(ray.origin.y, ray.direction.y, low.y, high.y, t_in, t_out)) return std::nullopt;
  if (!clip_slab(ray.origin.z, ray.direction.z, low.z, high.z, t_in, t_out)) return std::nullopt;
  return std::array<double, 2>{t_in, t_out};
}

// Where a ray enters an axis-aligned box, if it does before range_max; 0 from within.
inline std::optional<double> cast_box(const Ray& ray, const Vec3& low, const Vec3& high, double range_max) {
  const auto crossed = cross_box(ray, low, high, range_max);
  return crossed ? std::optional<double>((*crossed)[0]) : std::nullopt;
}

// A box with faces along the axes of a frame.
struct BoxSolid {
  PlanarFrame frame;
  Vec3 low, high;
  bool operator==(const BoxSolid&) const = default;
  [[nodiscard]] std::optional<double> cast(const Ray& ray, double range_max) const { return cast_box(frame.in(ray), low, high, range_max); }
  [[nodiscard]] std::optional<std::array<double, 2>> cross(const Ray& ray, double range_max) const { return cross_box(frame.in(ray), low, high, range_max); }
};

// An upright cylinder.
struct CylinderSolid {
  double x = 0, y = 0, z_low = 0, z_high = 0, radius = 0;
  bool operator==(const CylinderSolid&) const = default;
  [[nodiscard]] std::optional<double> cast(const Ray& ray, double range_max) const;
};

// A convex outline in the plane y = 0 of the upper body's frame, extruded to both sides.
class PrismSolid {
 public:
  // outline: counter-clockwise (x towards z), at least three points.
  PrismSolid(const std::vector<SwingPlanePoint>& outline, double half_width);
  bool operator==(const PrismSolid&) const = default;
  [[nodiscard]] const Vec3& low() const { return low_; }
  [[nodiscard]] const Vec3& high() const { return high_; }
  // ray in the upper body's frame.
  [[nodiscard]] std::optional<double> cast(const Ray& ray, double range_max) const;

 private:
  struct Edge {
    double normal_x, normal_z, offset;
    bool operator==(const Edge&) const = default;
  };  // inside: normal . p <= offset
  std::vector<Edge> edge_;
  Vec3 low_, high_;
};

inline std::optional<double> CylinderSolid::cast(const Ray& ray, double range_max) const {
  double t_in = 0, t_out = range_max;
  if (!clip_slab(ray.origin.z, ray.direction.z, z_low, z_high, t_in, t_out)) return std::nullopt;
  const double px = ray.origin.x - x, py = ray.origin.y - y, dx = ray.direction.x, dy = ray.direction.y;
  const double a = dx * dx + dy * dy, b = px * dx + py * dy, c = px * px + py * py - radius * radius;
  if (a == 0) return c <= 0 ? std::optional<double>(t_in) : std::nullopt;
  const double root2 = b * b - a * c;
  if (root2 < 0) return std::nullopt;
  const double root = std::sqrt(root2);
  t_in = std::max(t_in, (-b - root) / a);
  t_out = std::min(t_out, (-b + root) / a);
  return t_in <= t_out ? std::optional<double>(t_in) : std::nullopt;
}

inline std::optional<double> PrismSolid::cast(const Ray& ray, double range_max) const {
  double t_in = 0, t_out = range_max;
  if (!clip_slab(ray.origin.y, ray.direction.y, low_.y, high_.y, t_in, t_out)) return std::nullopt;
  if (!clip_slab(ray.origin.x, ray.direction.x, low_.x, high_.x, t_in, t_out)) return std::nullopt;
  for (const Edge& e : edge_) {
    if (!clip(e.normal_x * ray.direction.x + e.normal_z * ray.direction.z, e.offset - e.normal_x * ray.origin.x - e.normal_z * ray.origin.z, t_in, t_out)) {
      return std::nullopt;
    }
  }
  return t_in;
}

}  // namespace berm::plant
