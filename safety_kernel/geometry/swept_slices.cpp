#include "geometry/swept_slices.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/part_sweep.hpp"
#include "geometry/reach.hpp"
#include "geometry/slice_planes.hpp"

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
namespace berm::kernel {
namespace {

constexpr double pi = 3.141592653589793;
constexpr double rad_per_urad = 1e-6;
constexpr double sub_interval_rad = 5.0 * pi / 180.0;
constexpr double outline_slack_mm = 3.0; // 0.87 for rounding; the rest for lengths that the parameter block rounds to the millimetre
constexpr double side_slack_mm = 2.0;
constexpr int32_t swing_max_urad = 20000000;

struct Swing {
  double low, half; // rad
  int intervals;

  double middle(int i) const noexcept { return low + (2 * i + 1) * half; }
};

struct Outline {
  PlaneNormals normals;
  double x_mm[sweep_directions], z_mm[sweep_directions], side_mm[sweep_directions];
};

// Half the sub-interval is at most 4.5 degrees: a whole turn covers every swing angle.
Swing divide(const sk_reach_box& box) noexcept {
  const double low = box.low_urad[0] * rad_per_urad;
  const double span = std::min(2.0 * pi, (static_cast<double>(box.high_urad[0]) - box.low_urad[0]) * rad_per_urad);
  const int wanted = static_cast<int>(std::ceil(span / sub_interval_rad));
  const int intervals = std::clamp(wanted, 1, swing_sub_intervals);
  return {low, 0.5 * span / intervals, intervals};
}

void outline_of(const PartSweep& sweep, double half, Outline& out) noexcept {
  const double w = sweep.half_width_mm();
  const double sagitta = 1.0 - std::cos(half);
  const double farthest = std::max(0.0, sweep.support(direction_of(0.0)));
  const double behind = std::max(0.0, sweep.support(direction_of(pi)));
  const double grow_near = farthest * sagitta + w * std::sin(half);
  const double grow_far = behind * sagitta + w * std::sin(half);

  Direction direction[sweep_directions];
  double h[sweep_directions];
  for (int i = 0; i < sweep_directions; ++i) {
    const Direction u = direction_of(sweep.elevation_mid() + i * (2.0 * pi / sweep_directions));
    direction[i] = u;
    h[i] = sweep.support(u) + std::max(grow_far * u.r, -grow_near * u.r) + outline_slack_mm;
  }
  double back = 0.0;
  for (int i = 0; i < sweep_directions; ++i) {
    const int j = (i + 1) % sweep_directions;
    const Direction &u = direction[i], &v = direction[j];
    const double determinant = u.r * v.z - u.z * v.r; // sin 30
    out.x_mm[i] = (h[i] * v.z - h[j] * u.z) / determinant;
    out.z_mm[i] = (h[j] * u.r - h[i] * v.r) / determinant;
    back = std::max(back, -out.x_mm[i]);
  }
  for (int i = 0; i < sweep_directions; ++i)
    out.side_mm[i] = (out.x_mm[i] + 2.0 * back) * std::tan(half) + w / std::cos(half) + side_slack_mm;
  out.normals = plane_normals(std::tan(half), direction, sweep_directions);
}

bool to_grid(double value, int32_t& out) noexcept {
  if (!(std::fabs(value) <= SK_COORD_MAX_MM)) return false;
  out = static_cast<int32_t>(value < 0.0 ? value - 0.5 : value + 0.5); // to the nearest; inline where lround is a call
  return true;
}

bool place(const Outline& outline, double swing, int link, sk_slice& slice) noexcept {
  const double c = std::cos(swing), s = std::sin(swing);
  slice.link = link;
  slice.vertices = SK_SLICE_VERTICES;
  for (int i = 0; i < sweep_directions; ++i) {
    const double x = outline.x_mm[i], y = outline.side_mm[i];
    int32_t* left = slice.vertex_mm[2 * i];
    int32_t* right = slice.vertex_mm[2 * i + 1];
    if (!to_grid(x * c - y * s, left[0]) || !to_grid(x * s + y * c, left[1]) || !to_grid(outline.z_mm[i], left[2])) return false;
    if (!to_grid(x * c + y * s, right[0]) || !to_grid(x * s - y * c, right[1])) return false;
    right[2] = left[2];
  }
  set_planes(slice, outline.normals, c, s);
  return true;
}

} // namespace

bool build_slices(const berm_parameters& parameters, const sk_reach_box& box, SliceSet& out) noexcept {
  out.count = 0;
  out.max_reach_mm = max_reach_mm(parameters, box);
  if (out.max_reach_mm < 0) return false; // has checked every part and the boxes of boom, stick and bucket
  if (box.low_urad[0] > box.high_urad[0] || box.low_urad[0] < -swing_max_urad || box.high_urad[0] > swing_max_urad) return false;

  const Swing swing = divide(box);
  int32_t count = 0;
  for (int part = 0; part < parameters.parts; ++part) {
    PartSweep sweep;
    if (!sweep.set(parameters, box, part)) return false;
    Outline outline;
    outline_of(sweep, swing.half, outline);
    for (int i = 0; i < swing.intervals; ++i, ++count)
      if (!place(outline, swing.middle(i), sweep.link(), out.slice[count])) return false;
  }
  out.count = count;
  return true;
}

} // namespace berm::kernel
