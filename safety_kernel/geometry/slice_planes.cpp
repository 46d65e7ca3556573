#include "geometry/slice_planes.hpp"

#include <Eigen/Core>
#include <cmath>

namespace berm::kernel {
namespace {

struct Normal {
  double x, y, z;
};

Normal operator+(const Normal& a, const Normal& b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }

void append(PlaneNormals& list, const Normal& n) noexcept {
  if (list.count >= SK_SLICE_PLANES - 1) return; // one place is the horizontal plane's
  const double scale = normal_scale / std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
  list.x[list.count] = scale * n.x;
  list.y[list.count] = scale * n.y;
  list.z[list.count] = scale * n.z;
  ++list.count;
}

int32_t nearest(double value) noexcept { return static_cast<int32_t>(value < 0.0 ? value - 0.5 : value + 0.5); }

using Row = Eigen::Array<double, SK_SLICE_VERTICES, 1>;

} // namespace

PlaneNormals plane_normals(double side_tan, const Direction* outline, int directions) noexcept {
  constexpr double upright = 0.02; // faces closer to upright than this add nothing to the near and far planes
  const double side_cos = 1.0 / std::sqrt(1.0 + side_tan * side_tan);
  const Normal left{side_tan * side_cos, -side_cos, 0.0};
  const Normal right{side_tan * side_cos, side_cos, 0.0};
  PlaneNormals list;
  append(list, left);
  append(list, right);
  append(list, {1.0, 0.0, 0.0});
  append(list, {-1.0, 0.0, 0.0});
  for (int i = 0; i < directions; ++i) {
    if (outline[i].z > -upright) continue;
    const Normal face{-outline[i].r, 0.0, -outline[i].z};
    append(list, face);
    append(list, face + left);
    append(list, face + right);
  }
  return list;
}

void set_planes(sk_slice& slice, const PlaneNormals& normals, double cos_swing, double sin_swing) noexcept {
  // Integers below 2^53 throughout: double is exact here, and vectorises where int64 does not.
  Row x, y, z;
  for (int i = 0; i < SK_SLICE_VERTICES; ++i) {
    const int32_t* v = slice.vertex_mm[i < slice.vertices ? i : 0];
    x[i] = v[0];
    y[i] = v[1];
    z[i] = v[2];
  }
  slice.plane[0] = {0, 0, 1, static_cast<int64_t>(z.minCoeff()) - 1};
  slice.planes = 1;
  for (int i = 0; i < normals.count; ++i) {
    sk_plane& plane = slice.plane[slice.planes++];
    plane.nx = nearest(normals.x[i] * cos_swing - normals.y[i] * sin_swing);
    plane.ny = nearest(normals.x[i] * sin_swing + normals.y[i] * cos_swing);
    plane.nz = nearest(normals.z[i]);
    const double nx = plane.nx, ny = plane.ny, nz = plane.nz;
    plane.d = static_cast<int64_t>((nx * x + ny * y + nz * z).minCoeff()) - 1;
  }
}

} // namespace berm::kernel
