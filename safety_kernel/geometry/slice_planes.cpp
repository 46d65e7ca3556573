#include "geometry/slice_planes.hpp"

#include <algorithm>

#include "geometry/lanes.hpp"

namespace berm::kernel {

void plane_candidates_of(const SliceSet& set, int i, PlaneCandidates& out) noexcept {
  constexpr float upright = 0.02F; // faces closer to upright than this add nothing to the near and far planes
  constexpr float scale = static_cast<float>(normal_scale);
  const PartOutline& outline = set.outline[i / set.intervals];
  const float c = set.cos_swing[i % set.intervals], s = set.sin_swing[i % set.intervals];
  const Four outward = four(-scale);
  alignas(16) int32_t x[sweep_directions], y[sweep_directions], z[sweep_directions];
  alignas(16) float offset[sweep_directions];
  for (int k = 0; k < sweep_directions; k += 4) {
    const Four r = outward * load4(outline.normal_r + k);
    store4(x + k, rounded4(r * four(c)));
    store4(y + k, rounded4(r * four(s)));
    store4(z + k, rounded4(outward * load4(outline.normal_z + k)));
    store4(offset + k, outward * load4(outline.offset_mm + k));
  }
  // sides: (sin half, -+cos half) turned by the swing; near and far: (+-1, 0)
  const Four upright_x = four(scale) * (Four{set.sin_half, set.sin_half, 1.0F, -1.0F} * four(c) - Four{-set.cos_half, set.cos_half, 0.0F, 0.0F} * four(s));
  const Four upright_y = four(scale) * (Four{set.sin_half, set.sin_half, 1.0F, -1.0F} * four(s) + Four{-set.cos_half, set.cos_half, 0.0F, 0.0F} * four(c));
  store4(out.nx, rounded4(upright_x));
  store4(out.ny, rounded4(upright_y));
  store4(out.nz, FourInt{0, 0, 0, 0});
  store4(out.offset, four(scale) * Four{-outline.side_offset_mm, -outline.side_offset_mm, outline.x_low_mm, -outline.x_high_mm});
  out.count = upright_candidates;
  for (int k = 0; k < sweep_directions; ++k) {
    if (outline.normal_z[k] > -upright || out.count + 3 > plane_candidates) continue;
    for (const int side : {-1, 0, 1}) { // the face itself, and with the left and the right side
      const int to = out.count++;
      out.nx[to] = x[k] + (side < 0 ? 0 : out.nx[side]);
      out.ny[to] = y[k] + (side < 0 ? 0 : out.ny[side]);
      out.nz[to] = z[k];
      out.offset[to] = offset[k] + (side < 0 ? 0.0F : out.offset[side]);
    }
  }
}

int64_t plane_offset(const sk_slice& slice, int32_t nx, int32_t ny, int32_t nz) noexcept {
  int64_t least = INT64_MAX;
  for (int i = 0; i < slice.vertices; ++i) {
    least = std::min(least, static_cast<int64_t>(nx) * slice.xyz_mm[0][i] + static_cast<int64_t>(ny) * slice.xyz_mm[1][i] + static_cast<int64_t>(nz) * slice.xyz_mm[2][i]);
  }
  return least - 1;
}

} // namespace berm::kernel
