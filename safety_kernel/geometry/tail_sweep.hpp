// The upper body's tail and what its swing sweeps: upright prisms over a convex outline seen from above.
#ifndef BERM_KERNEL_GEOMETRY_TAIL_SWEEP_HPP
#define BERM_KERNEL_GEOMETRY_TAIL_SWEEP_HPP

#include "config/parameter_block.h"
#include "core/clearance.h"

namespace berm::kernel {

inline constexpr int tail_corners = SK_SLICE_VERTICES / 4; // each at both ends of a slice's swing interval, at the underside and at the top
inline constexpr int tail_normals = 8;

// The tail at swing 0: behind the swing axis, within the half width of the swing plane and the radius of the axis. Grown by the clearance to the sides, and behind
// to the clearance beyond the own body: nearer than that no sensor tells of the ground, so that there the check would say nothing.
class TailShape {
public:
  explicit TailShape(const berm_parameters& parameters) noexcept;

  bool watched = false; // false: nothing is to be checked
  int32_t low_mm = 0, high_mm = 0;
  // Seen from above, counter-clockwise; the origin lies inside. 2 mm larger than the above: vertices are rounded to the millimetre.
  double x_mm[tail_corners] = {}, y_mm[tail_corners] = {};
  // Outward, of the outline and between its edges: for planes beside the tail.
  double normal_x[tail_normals] = {}, normal_y[tail_normals] = {};
};

// What of the swing a slice covers: the middle and half the width of its interval.
struct SwingInterval {
  double cosine, sine, cos_half, sin_half; // half below 90 degrees
};

// Every point of the grown tail is, at every swing angle of the interval, in the convex hull of the slice's vertices. The slice has the level plane below it.
// Why: rotated by t, |t| <= half, a corner c lies on the circle of radius |c|, within the triangle of the origin and the two points (c rotated by -half and by
// half) / cos half, for their chord touches that circle. The origin is in the hull of these points of all corners, since it is in the outline and the factor is at
// least 1. So the hull holds every rotated corner, and with them the rotated outline.
void tail_slice(const TailShape& tail, const SwingInterval& swing, sk_slice& slice) noexcept;

} // namespace berm::kernel
#endif
