// Candidate separating planes of a slice.
#ifndef BERM_KERNEL_GEOMETRY_SLICE_PLANES_HPP
#define BERM_KERNEL_GEOMETRY_SLICE_PLANES_HPP

#include "geometry/swept_slices.hpp"

namespace berm::kernel {

// Length of a face's normal: fine enough that a face is met to 0.4 mm at 12 m. Bevels have the sum of two.
inline constexpr int32_t normal_scale = 16384;
inline constexpr int plane_candidates = 24; // in fours; those in use come first
inline constexpr int upright_candidates = 4;

// Normals towards the slice, in the base frame. First the upright faces (left side, right side, near, far); then for each edge of the outline that looks
// downward its face, and the bevels between that face and the two sides. Of the tail: upright ones only, all round it.
struct PlaneCandidates {
  int count = 0;
  int upright = upright_candidates; // of the first: these have no slope
  // Readable beyond count, whatever stands there. Those of a face are written in fours, of which the last is one too many.
  int32_t nx[plane_candidates + 1], ny[plane_candidates + 1], nz[plane_candidates + 1];
  float offset[plane_candidates + 1]; // n . p of the slice is no less than about this (to a few mm)
};

// Of slice i of the set.
void plane_candidates_of(const SliceSet& set, int i, PlaneCandidates& out) noexcept;

// n . v - 1 of the slice's nearest vertex: exactly the greatest d for which every vertex is on the positive side.
int64_t plane_offset(const sk_slice& slice, int32_t nx, int32_t ny, int32_t nz) noexcept;

} // namespace berm::kernel
#endif
