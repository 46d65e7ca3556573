// Convex slices that cover the volume swept by the implements, and by the upper body's tail where it is watched, over a reach box.
#ifndef BERM_KERNEL_GEOMETRY_SWEPT_SLICES_HPP
#define BERM_KERNEL_GEOMETRY_SWEPT_SLICES_HPP

#include "config/parameter_block.h"
#include "core/clearance.h"
#include "core/reach_box.h"
#include "geometry/part_outline.hpp"

namespace berm::kernel {

inline constexpr int swing_sub_intervals = 40; // most; wanted are at most 5 degrees each
inline constexpr int slice_capacity = (BERM_PARTS + 1) * swing_sub_intervals;

// 210 kB: lives in static or preallocated storage, never on a small stack.
struct SliceSet {
  int32_t count = 0;
  int32_t max_reach_mm = 0; // no implement point over the box is farther from the swing axis
  int32_t intervals = 0;    // slice i is of part i / intervals (the last of them the tail, link 0, where it is watched), and of swing interval i % intervals
  float cos_half = 1.0F, sin_half = 0.0F; // of half a swing interval
  float cos_swing[swing_sub_intervals], sin_swing[swing_sub_intervals]; // of an interval's middle
  double tail_normal_x[tail_normals], tail_normal_y[tail_normals];      // of the shape
  PartOutline outline[BERM_PARTS];
  sk_slice slice[slice_capacity];
};

// Every point of every part (with its width) lies, at every joint position in the box, in the convex hull of the integer vertices of some
// slice; and every point of the grown tail (tail_sweep.hpp), where it is watched. Slices stand part by part, from the swing's low end to its high end.
// Each has the level plane below it (planes == 1); the planes that the map asks for are added by the search (separation.hpp).
// False, with count 0, where parameters or box are malformed or a vertex would leave +-SK_COORD_MAX_MM; the caller must then block.
bool build_slices(const ImplementShape& shape, const sk_reach_box& box, SliceSet& out) noexcept;
// The same for a machine that is asked about once.
bool build_slices(const berm_parameters& parameters, const sk_reach_box& box, SliceSet& out) noexcept;

} // namespace berm::kernel
#endif
