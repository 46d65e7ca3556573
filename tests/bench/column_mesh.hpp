// The map as a mesh of triangles: the tops of the columns, and the walls between columns of different height.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "motion.hpp"

namespace berm::bench {

struct Mesh {
  std::vector<Vec3> vertex;
  std::vector<std::array<int, 3>> triangle;
};

Mesh column_mesh(const std::vector<std::int32_t>& heights_mm, int cells, int cell_mm);

}  // namespace berm::bench
