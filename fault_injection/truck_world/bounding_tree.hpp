// Rays against triangles, by a tree of boxes round them (Wald 2007: binned surface area heuristic).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "truck_world/mesh.hpp"

namespace berm::truck_world {

struct Hit {
  double range = 0.0;          // m along the ray
  std::uint32_t triangle = 0;  // its place in the mesh
};

// Immutable after it is built; casts from several threads do not disturb each other.
class BoundingTree {
 public:
  explicit BoundingTree(const Mesh& mesh);
  // What the ray origin + range x direction (a unit vector) meets first with 0 < range < range_max, from either side of a triangle.
  // Of several at the very same range the lowest number.
  [[nodiscard]] std::optional<Hit> first(const Vector3d& origin, const Vector3d& direction, double range_max) const;

 private:
  struct Box { Vector3d low, high; };
  struct Node {
    Box box;
    std::uint32_t first = 0, count = 0;  // leaf: triangles; else count is 0, the left child follows this node and first is the right one
    int axis = 0;
  };
  struct Face { Vector3d corner, edge1, edge2; std::uint32_t number; };
  struct Work { Box box; Vector3d centre; std::uint32_t number; };
  void build(std::vector<Work>& work, std::size_t begin, std::size_t end);

  std::vector<Node> nodes_;
  std::vector<Face> faces_;
  const Mesh* mesh_;  // while building
};

}  // namespace berm::truck_world
