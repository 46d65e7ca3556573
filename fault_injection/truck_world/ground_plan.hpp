// Rectangles on the ground: whether what stands on them keeps apart.
#pragma once

#include <vector>

#include "truck_world/mesh.hpp"

namespace berm::truck_world {

struct GroundRectangle {
  Vector2d centre = Vector2d::Zero();
  double yaw = 0.0;                    // of the long side
  Vector2d half = Vector2d::Zero();    // half length, half width

  [[nodiscard]] Vector2d at(double u, double v) const;  // u, v in -1 .. 1
  [[nodiscard]] std::vector<Vector2d> outline(double spacing) const;
  // Least distance of its outline from the point, which must not be inside.
  [[nodiscard]] double distance(const Vector2d& point) const;
};

// Whether a straight line passes between them with gap or more.
bool apart(const GroundRectangle& a, const GroundRectangle& b, double gap);

}  // namespace berm::truck_world
