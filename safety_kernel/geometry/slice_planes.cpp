#include "geometry/slice_planes.hpp"

#include <algorithm>

#include "geometry/lanes.hpp"

namespace berm::kernel {

namespace {

void tail_candidates_of(const SliceSet& set, int i, PlaneCandidates& out) noexcept {
  static_assert(tail_normals % 4 == 0 && tail_normals <= plane_candidates);
  const double c = set.cos_swing[i % set.intervals], s = set.sin_swing[i % set.intervals];
  for (int k = 0; k < tail_normals; ++k) {
    out.nx[k] = static_cast<int32_t>(-normal_scale * (c * set.tail_normal_x[k] - s * set.tail_normal_y[k]));
    out.ny[k] = static_cast<int32_t>(-normal_scale * (s * set.tail_normal_x[k] + c * set.tail_normal_y[k]));
    out.nz[k] = 0;
    out.offset[k] = static_cast<float>(plane_offset(set.slice[i], out.nx[k], out.ny[k], 0));
  }
  out.count = out.upright = tail_normals;
}

} // namespace

void plane_candidates_of(const SliceSet& set, int i, PlaneCandidates& out) noexcept {
  if (set.slice[i].link == 0) return tail_candidates_of(set, i, out);
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
  const FourInt side_x = rounded4(upright_x), side_y = rounded4(upright_y);
  const Four side_offset = four(scale) * Four{-outline.side_offset_mm, -outline.side_offset_mm, outline.x_low_mm, -outline.x_high_mm};
  store4(out.nx, side_x);
  store4(out.ny, side_y);
  store4(out.nz, FourInt{0, 0, 0, 0});
  store4(out.offset, side_offset);
  const FourInt of_face_x = {0, side_x[0], side_x[1], 0}, of_face_y = {0, side_y[0], side_y[1], 0}; // the face itself, and with the left and the right side
  const Four of_face_offset = {0.0F, side_offset[0], side_offset[1], 0.0F};
  int count = out.upright = upright_candidates;
  for (int k = 0; k < sweep_directions; ++k) {
    if (outline.normal_z[k] > -upright || count + 3 > plane_candidates) continue;
    store4(out.nx + count, of_face_x + x[k]); // the fourth is overwritten, or beyond what is in use
    store4(out.ny + count, of_face_y + y[k]);
    store4(out.nz + count, FourInt{z[k], z[k], z[k], z[k]});
    store4(out.offset + count, of_face_offset + four(offset[k]));
    count += 3;
  }
  out.count = count;
}

// In lanes of doubles, which hold these integers exactly: components within SK_NORMAL_MAX (2^20) times any int32, three of them, stay below 2^53.
BERM_LANES_CLONES int64_t plane_offset(const sk_slice& slice, int32_t nx, int32_t ny, int32_t nz) noexcept {
  static_assert(SK_NORMAL_MAX <= (1 << 20));
  constexpr double farthest = 9007199254740992.0;
  const double x = nx, y = ny, z = nz;
  const FourDouble fx = {x, x, x, x}, fy = {y, y, y, y}, fz = {z, z, z, z};
  FourDouble four_least = {farthest, farthest, farthest, farthest};
  int i = 0;
  for (; i + 4 <= slice.vertices; i += 4) {
    const FourDouble here = fx * __builtin_convertvector(load4(slice.xyz_mm[0] + i), FourDouble) + fy * __builtin_convertvector(load4(slice.xyz_mm[1] + i), FourDouble) +
                            fz * __builtin_convertvector(load4(slice.xyz_mm[2] + i), FourDouble);
    four_least = here < four_least ? here : four_least;
  }
  double least = std::min(std::min(four_least[0], four_least[1]), std::min(four_least[2], four_least[3]));
  for (; i < slice.vertices; ++i) least = std::min(least, x * slice.xyz_mm[0][i] + y * slice.xyz_mm[1][i] + z * slice.xyz_mm[2][i]);
  return static_cast<int64_t>(least) - 1;
}

} // namespace berm::kernel
