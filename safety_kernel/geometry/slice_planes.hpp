// Candidate separating planes of a slice.
#ifndef BERM_KERNEL_GEOMETRY_SLICE_PLANES_HPP
#define BERM_KERNEL_GEOMETRY_SLICE_PLANES_HPP

#include "core/clearance.h"
#include "geometry/part_sweep.hpp"

namespace berm::kernel {

// Components of normals lie within +-normal_scale. Small enough that every product of an orientation test on points within
// +-SK_COORD_MAX_MM is exact in double; fine enough that a face is met to 0.4 mm at 12 m.
inline constexpr int32_t normal_scale = 16384;

// Normals towards the slice, of length normal_scale, in the frame turned to the slice's middle swing angle (y left): the same for
// all slices of a part. First the upright faces (left side, right side, near, far); then for each direction of the outline that looks
// downward its face, and the bevels between that face and the two sides.
struct PlaneNormals {
  int count = 0;
  double x[SK_SLICE_PLANES], y[SK_SLICE_PLANES], z[SK_SLICE_PLANES];
};

// side_tan: tangent of half a slice's swing interval.
PlaneNormals plane_normals(double side_tan, const Direction* outline, int directions) noexcept;

// Fills slice.planes and slice.plane from its vertices: horizontal at index 0, then the given normals turned by the swing angle.
// Each plane has n . v > d for every vertex, with n . v = d + 1 for the nearest.
void set_planes(sk_slice& slice, const PlaneNormals& normals, double cos_swing, double sin_swing) noexcept;

} // namespace berm::kernel
#endif
