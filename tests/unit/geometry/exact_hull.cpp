#include "exact_hull.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace berm::kernel::test {

ExactHull::ExactHull(const sk_slice& slice) {
  const int n = slice.vertices;
  for (int k = 0; k < 3; ++k) {
    low_[k] = 1e9;
    high_[k] = -1e9;
    for (int i = 0; i < n; ++i) {
      low_[k] = std::min(low_[k], static_cast<double>(slice.xyz_mm[k][i]));
      high_[k] = std::max(high_[k], static_cast<double>(slice.xyz_mm[k][i]));
    }
  }
  std::vector<std::array<int32_t, 3>> vertex;
  for (int i = 0; i < n; ++i) vertex.push_back({slice.xyz_mm[0][i], slice.xyz_mm[1][i], slice.xyz_mm[2][i]});
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b)
      for (int c = b + 1; c < n; ++c) {
        const auto &p = vertex[a], &q = vertex[b], &r = vertex[c];
        const int64_t u[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]}, v[3] = {r[0] - p[0], r[1] - p[1], r[2] - p[2]};
        const int64_t m[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
        if (m[0] == 0 && m[1] == 0 && m[2] == 0) continue;
        bool above = false, below = false; // |m| < 2^34, differences < 2^17: within int64
        for (int i = 0; i < n && !(above && below); ++i) {
          const auto& s = vertex[i];
          const int64_t side = m[0] * (s[0] - p[0]) + m[1] * (s[1] - p[1]) + m[2] * (s[2] - p[2]);
          above = above || side > 0;
          below = below || side < 0;
        }
        if (above && below) continue;
        const double sign = above ? -1.0 : 1.0;
        const double length = sign * std::sqrt(static_cast<double>(m[0]) * static_cast<double>(m[0]) + static_cast<double>(m[1]) * static_cast<double>(m[1]) +
                                               static_cast<double>(m[2]) * static_cast<double>(m[2]));
        const Facet f{static_cast<double>(m[0]) / length, static_cast<double>(m[1]) / length, static_cast<double>(m[2]) / length, 0.0};
        const double d = f.x * p[0] + f.y * p[1] + f.z * p[2];
        const bool seen = std::any_of(facet_.begin(), facet_.end(), [&](const Facet& g) {
          return std::fabs(f.x - g.x) + std::fabs(f.y - g.y) + std::fabs(f.z - g.z) + std::fabs(d - g.d) < 1e-9;
        });
        if (!seen) facet_.push_back({f.x, f.y, f.z, d});
      }
}

bool ExactHull::contains(double x, double y, double z, double tolerance_mm) const {
  if (!solid()) return false;
  for (const Facet& f : facet_)
    if (f.x * x + f.y * y + f.z * z > f.d + tolerance_mm) return false;
  return true;
}

} // namespace berm::kernel::test
