// Convex slices that cover the volume swept by the implements over a reach box.
#ifndef BERM_KERNEL_GEOMETRY_SWEPT_SLICES_HPP
#define BERM_KERNEL_GEOMETRY_SWEPT_SLICES_HPP

#include "config/parameter_block.h"
#include "core/clearance.h"
#include "core/reach_box.h"

namespace berm::kernel {

inline constexpr int sweep_directions = SK_SLICE_VERTICES / 2; // edges of a slice's outline in the swing plane
inline constexpr int swing_sub_intervals = 40;                 // most; wanted are at most 5 degrees each
inline constexpr int slice_capacity = BERM_PARTS * swing_sub_intervals;

// 180 kB: lives in static or preallocated storage, never on a small stack.
struct SliceSet {
  int32_t count = 0;
  int32_t max_reach_mm = 0; // no implement point over the box is farther from the swing axis
  sk_slice slice[slice_capacity];
};

// Every point of every part (with its width) lies, at every joint position in the box, in the convex hull of the integer vertices of some
// slice. Slices stand part by part, from the swing's low end to its high end. Each carries its separating-plane candidates, horizontal first.
// False, with count 0, where parameters or box are malformed or a vertex would leave +-SK_COORD_MAX_MM; the caller must then block.
bool build_slices(const berm_parameters& parameters, const sk_reach_box& box, SliceSet& out) noexcept;

} // namespace berm::kernel
#endif
