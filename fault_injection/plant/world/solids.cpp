#include "plant/world/solids.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace berm::plant {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

// Narrows [t_in, t_out] to where a * t <= b; false when nothing is left.
bool clip(double a, double b, double& t_in, double& t_out) {
  if (a == 0) return b >= 0;
  const double t = b / a;
  if (a > 0) t_out = std::min(t_out, t);
  else t_in = std::max(t_in, t);
  return t_in <= t_out;
}

bool clip_slab(double origin, double direction, double low, double high, double& t_in, double& t_out) {
  return clip(direction, high - origin, t_in, t_out) && clip(-direction, origin - low, t_in, t_out);
}

}  // namespace

std::optional<std::array<double, 2>> cross_box(const Ray& ray, const Vec3& low, const Vec3& high, double range_max) {
  double t_in = 0, t_out = range_max;
  if (!clip_slab(ray.origin.x, ray.direction.x, low.x, high.x, t_in, t_out)) return std::nullopt;
  if (!clip_slab(ray.origin.y, ray.direction.y, low.y, high.y, t_in, t_out)) return std::nullopt;
  if (!clip_slab(ray.origin.z, ray.direction.z, low.z, high.z, t_in, t_out)) return std::nullopt;
  return std::array<double, 2>{t_in, t_out};
}

std::optional<double> cast_box(const Ray& ray, const Vec3& low, const Vec3& high, double range_max) {
  const auto crossed = cross_box(ray, low, high, range_max);
  return crossed ? std::optional<double>((*crossed)[0]) : std::nullopt;
}

std::optional<double> CylinderSolid::cast(const Ray& ray, double range_max) const {
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

PrismSolid::PrismSolid(const std::vector<SwingPlanePoint>& outline, double half_width) : low_{inf, -half_width, inf}, high_{-inf, half_width, -inf} {
  for (size_t i = 0; i < outline.size(); ++i) {
    const SwingPlanePoint &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const double nx = b.z - a.z, nz = a.r - b.r;
    edge_.push_back({nx, nz, nx * a.r + nz * a.z});
    low_ = {std::min(low_.x, a.r), low_.y, std::min(low_.z, a.z)};
    high_ = {std::max(high_.x, a.r), high_.y, std::max(high_.z, a.z)};
  }
}

std::optional<double> PrismSolid::cast(const Ray& ray, double range_max) const {
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
