#include "geometry/swept_slices.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/lanes.hpp"
#include "geometry/turns.hpp"

// Why a slice covers its share of the sweep.
//
// 1. In the swing plane let S be the part's sweep, h_S its support function (part_sweep.hpp bounds it from above). At swing angle
//    middle + t, |t| <= half, a point (r, y, z) with |y| <= w has, in the frame turned to the middle,
//        x' = r cos t - y sin t,   y' = r sin t + y cos t.
//    So x' - r <= w sin half + max(0, -r) (1 - cos half) <= grow_far and r - x' <= w sin half + max(0, r) (1 - cos half) <= grow_near with r
//    replaced by its bounds h_S(pi) and h_S(0). Hence (x', z) lies in S + segment [-grow_near, grow_far], whose support function is
//    h_S(u) + max(grow_far u_r, -grow_near u_r).
// 2. Eliminating r gives exactly y' = x' tan t + y / cos t, so |y'| <= |x'| tan half + w / cos half. With back = max(0, -least x') the affine
//    function c(x) = (x + 2 back) tan half + w / cos half is no less than that on the outline.
// 3. The outline is the polygon of the support lines in 12 directions 30 degrees apart, raised by outline_slack_mm. The raised function is
//    the support function of a convex set too, so neighbouring lines meet in the polygon's vertices (edge lengths
//    (h[i-1] + h[i+1] - 2 cos 30 h[i]) / sin 30 are >= 0 by sublinearity), no farther out than 1 / cos 15 of the set.
//    As c is affine, the hull of the points (x_i, +-(c(x_i) + side_slack_mm), z_i) holds all (x', y', z) of 1 and 2, and a ball of radius rho about
//    each as long as rho <= outline_slack_mm and rho (1 + tan half) <= side_slack_mm.
// 4. Rounding moves a vertex by at most rho = sqrt(3)/2 mm (plus 1e-9 mm of the sums in double). The support function of the hull of the
//    moved vertices is at least the old one's less rho, hence at least that of the set of 1 and 2: it is still covered.
//
// 2 and 3 are worked out in part_outline.cpp, in floats: their error is under 0.02 mm, which the slack has room for.
namespace berm::kernel {
namespace {

constexpr double pi = 3.141592653589793;
constexpr double rad_per_urad = 1e-6;
constexpr double sub_interval_rad = 5.0 * pi / 180.0;
constexpr int32_t swing_max_urad = 20000000;
constexpr float reach_slack_mm = 0.1F; // of the sums in float

struct Swing {
  double low, half; // rad
  int intervals;
};

// Half the sub-interval is at most 4.5 degrees: a whole turn covers every swing angle.
Swing divide(const sk_reach_box& box) noexcept {
  const double low = box.low_urad[0] * rad_per_urad;
  const double span = std::min(2.0 * pi, (static_cast<double>(box.high_urad[0]) - box.low_urad[0]) * rad_per_urad);
  const int wanted = static_cast<int>(std::ceil(span / sub_interval_rad));
  const int intervals = std::clamp(wanted, 1, swing_sub_intervals);
  return {low, 0.5 * span / intervals, intervals};
}

BERM_LANES_CLONES bool place(const PartOutline& outline, float cos_swing, float sin_swing, sk_slice& slice) noexcept {
  const Four c = four(cos_swing), s = four(sin_swing), limit = four(static_cast<float>(SK_COORD_MAX_MM));
  FourInt inside = {-1, -1, -1, -1};
  for (int i = 0; i < sweep_directions; i += 4) {
    const Four x = load4(outline.x_mm + i), side = load4(outline.side_mm + i);
    const Four xc = x * c, xs = x * s, sc = side * c, ss = side * s;
    const Four lx = xc - ss, ly = xs + sc, rx = xc + ss, ry = xs - sc;
    inside &= (magnitude4(lx) <= limit) & (magnitude4(ly) <= limit) & (magnitude4(rx) <= limit) & (magnitude4(ry) <= limit);
    const FourInt z = load4(outline.z_mm + i);
    store4(slice.xyz_mm[0] + i, rounded4(lx));
    store4(slice.xyz_mm[1] + i, rounded4(ly));
    store4(slice.xyz_mm[2] + i, z);
    store4(slice.xyz_mm[0] + sweep_directions + i, rounded4(rx));
    store4(slice.xyz_mm[1] + sweep_directions + i, rounded4(ry));
    store4(slice.xyz_mm[2] + sweep_directions + i, z);
  }
  if (!all4(inside)) return false;
  slice.link = outline.link;
  slice.vertices = SK_SLICE_VERTICES;
  slice.planes = 1;
  slice.plane[0] = {0, 0, 1, outline.z_low_mm - 1};
  return true;
}

} // namespace

bool build_slices(const ImplementShape& shape, const sk_reach_box& box, SliceSet& out) noexcept {
  out.count = 0;
  if (shape.parts == 0) return false;
  if (box.low_urad[0] > box.high_urad[0] || box.low_urad[0] < -swing_max_urad || box.high_urad[0] > swing_max_urad) return false;
  static_assert(swing_sub_intervals % 4 == 0);
  const Swing swing = divide(box);
  BoxSweep sweep;
  if (!sweep.set(box, swing.half)) return false;
  double middle[swing_sub_intervals];
  for (int i = 0; i < (swing.intervals + 3) / 4 * 4; ++i) middle[i] = swing.low + (2 * i + 1) * swing.half;
  turns(middle, swing.intervals, out.cos_swing, out.sin_swing);
  out.intervals = swing.intervals;
  out.cos_half = sweep.cos_half();
  out.sin_half = sweep.sin_half();
  float reach_squared = 0.0F;
  int32_t count = 0;
  for (int part = 0; part < shape.parts; ++part) {
    PartOutline& outline = out.outline[part];
    if (!sweep.outline(shape, part, outline)) return false;
    reach_squared = std::max(reach_squared, outline.reach_squared);
    for (int i = 0; i < swing.intervals; ++i, ++count)
      if (!place(outline, out.cos_swing[i], out.sin_swing[i], out.slice[count])) return false;
  }
  if (shape.tail.watched) {
    std::copy(shape.tail.normal_x, shape.tail.normal_x + tail_normals, out.tail_normal_x);
    std::copy(shape.tail.normal_y, shape.tail.normal_y + tail_normals, out.tail_normal_y);
    for (int i = 0; i < swing.intervals; ++i, ++count)
      tail_slice(shape.tail, {out.cos_swing[i], out.sin_swing[i], out.cos_half, out.sin_half}, out.slice[count]);
  }
  out.max_reach_mm = static_cast<int32_t>(std::sqrt(reach_squared) + reach_slack_mm) + 1;
  out.count = count;
  return true;
}

bool build_slices(const berm_parameters& parameters, const sk_reach_box& box, SliceSet& out) noexcept {
  return build_slices(ImplementShape(parameters), box, out);
}

} // namespace berm::kernel
