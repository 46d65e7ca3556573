// The ground of a scene: the bench on which the excavator stands, its face, and the lower ground of the loading place. Base frame, metres.
#pragma once

#include <cstdint>

#include "truck_world/mesh.hpp"
#include "truck_world/random_streams.hpp"

namespace berm::truck_world {

struct SiteGround {
  Vector2d place = Vector2d::Zero();     // where the truck, or what stands for it, is
  double drop = 0.0;                     // of the lower ground there under the bench
  Vector2d gradient = Vector2d::Zero();  // of the lower ground
  double crest = 0.0, toe = 0.0;         // of the bench's face: distances from the swing axis towards the place
  double roughness = 0.0;                // standard deviation of the surface

  // Without roughness.
  [[nodiscard]] double height(const Vector2d& at) const;
  // Fine round the place, coarse far away, 60 m to every side of it. hole: half length and half width of a rectangle round the place that is left
  // out, turned by hole_yaw; a cell that reaches into it is left out whole.
  [[nodiscard]] Mesh mesh(Random& random, const Vector2d& hole = Vector2d::Zero(), double hole_yaw = 0.0) const;
};

constexpr double ground_cell = 0.3;  // m, round the place

}  // namespace berm::truck_world
