#include "column_mesh.hpp"

namespace berm::bench {

Mesh column_mesh(const std::vector<std::int32_t>& heights_mm, int cells, int cell_mm) {
  Mesh mesh;
  const double cell = cell_mm * 1e-3, origin = -0.5 * cells * cell;
  const auto square = [&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const int first = static_cast<int>(mesh.vertex.size());
    for (const Vec3& v : {a, b, c, d}) mesh.vertex.push_back(v);
    mesh.triangle.push_back({first, first + 1, first + 2});
    mesh.triangle.push_back({first, first + 2, first + 3});
  };
  for (int iy = 0; iy < cells; ++iy)
    for (int ix = 0; ix < cells; ++ix) {
      const double x = origin + ix * cell, y = origin + iy * cell, z = heights_mm[iy * cells + ix] * 1e-3;
      square({x, y, z}, {x + cell, y, z}, {x + cell, y + cell, z}, {x, y + cell, z});
      const double east = ix + 1 < cells ? heights_mm[iy * cells + ix + 1] * 1e-3 : z;
      if (east != z) square({x + cell, y, z}, {x + cell, y, east}, {x + cell, y + cell, east}, {x + cell, y + cell, z});
      const double north = iy + 1 < cells ? heights_mm[(iy + 1) * cells + ix] * 1e-3 : z;
      if (north != z) square({x, y + cell, z}, {x, y + cell, north}, {x + cell, y + cell, north}, {x + cell, y + cell, z});
    }
  return mesh;
}

}  // namespace berm::bench
