// The solids that rays are cast against.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "plant/machine/kinematics.hpp"
#include "plant/world/vec3.hpp"

namespace berm::plant {

// Where a ray enters and leaves an axis-aligned box, as far as it does before range_max; enters at 0 from within.
std::optional<std::array<double, 2>> cross_box(const Ray& ray, const Vec3& low, const Vec3& high, double range_max);

// Where a ray enters an axis-aligned box, if it does before range_max; 0 from within.
std::optional<double> cast_box(const Ray& ray, const Vec3& low, const Vec3& high, double range_max);

// A box with faces along the axes of a frame.
struct BoxSolid {
  PlanarFrame frame;
  Vec3 low, high;
  [[nodiscard]] std::optional<double> cast(const Ray& ray, double range_max) const { return cast_box(frame.in(ray), low, high, range_max); }
  [[nodiscard]] std::optional<std::array<double, 2>> cross(const Ray& ray, double range_max) const { return cross_box(frame.in(ray), low, high, range_max); }
};

// An upright cylinder.
struct CylinderSolid {
  double x = 0, y = 0, z_low = 0, z_high = 0, radius = 0;
  [[nodiscard]] std::optional<double> cast(const Ray& ray, double range_max) const;
};

// A convex outline in the plane y = 0 of the upper body's frame, extruded to both sides.
class PrismSolid {
 public:
  // outline: counter-clockwise (x towards z), at least three points.
  PrismSolid(const std::vector<SwingPlanePoint>& outline, double half_width);
  [[nodiscard]] const Vec3& low() const { return low_; }
  [[nodiscard]] const Vec3& high() const { return high_; }
  // ray in the upper body's frame.
  [[nodiscard]] std::optional<double> cast(const Ray& ray, double range_max) const;

 private:
  struct Edge { double normal_x, normal_z, offset; };  // inside: normal . p <= offset
  std::vector<Edge> edge_;
  Vec3 low_, high_;
};

}  // namespace berm::plant
