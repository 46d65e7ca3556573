#include "convex_body.hpp"

#include <cmath>

namespace berm::bench {

std::vector<int> ConvexBody::faces() const {
  const int n = static_cast<int>(corner.size()) / 2;
  std::vector<int> out;
  out.push_back(n);
  for (int i = n - 1; i >= 0; --i) out.push_back(i);  // seen from the left an outline runs clockwise
  out.push_back(n);
  for (int i = 0; i < n; ++i) out.push_back(n + i);
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    for (const int k : {4, i, j, n + j, n + i}) out.push_back(k);
  }
  return out;
}

ConvexBody body_of(const sk_slice& slice) {
  ConvexBody body;
  for (int i = 0; i < slice.vertices; ++i) body.corner.push_back({slice.xyz_mm[0][i] * 1e-3, slice.xyz_mm[1][i] * 1e-3, slice.xyz_mm[2][i] * 1e-3});
  return body;
}

ConvexBody body_of(const berm_parameters& parameters, const berm_part& part, const Joints& joints) {
  ConvexBody body;
  for (const double side : {1.0, -1.0})
    for (int i = 0; i < part.vertices; ++i)
      body.corner.push_back(part_point(parameters, part, joints, part.vertex_mm[i][0] * 1e-3, part.vertex_mm[i][1] * 1e-3, side * part.half_width_mm * 1e-3));
  return body;
}

ConvexBody body_of(const berm_part& part) {
  ConvexBody body;
  for (const double side : {1.0, -1.0})
    for (int i = 0; i < part.vertices; ++i) body.corner.push_back({part.vertex_mm[i][0] * 1e-3, side * part.half_width_mm * 1e-3, part.vertex_mm[i][1] * 1e-3});
  return body;
}

Pose pose_of(const berm_parameters& parameters, int link, const Joints& joints) {
  berm_part part{};
  part.link = link;
  const Vec3 at = part_point(parameters, part, joints, 0, 0, 0), x = part_point(parameters, part, joints, 1, 0, 0), z = part_point(parameters, part, joints, 0, 1, 0),
             y = part_point(parameters, part, joints, 0, 0, 1);
  const auto less = [](const Vec3& a, const Vec3& b) { return Vec3{a.x - b.x, a.y - b.y, a.z - b.z}; };
  return {less(x, at), less(y, at), less(z, at), at};
}

}  // namespace berm::bench
