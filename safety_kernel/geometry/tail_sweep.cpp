#include "geometry/tail_sweep.hpp"

#include <algorithm>
#include <cmath>

namespace berm::kernel {
namespace {

constexpr double slack_mm = 2.0; // 0.71 for rounding to the grid, 0.01 for the swing's sines in float

} // namespace

TailShape::TailShape(const berm_parameters& parameters) noexcept
    : watched(parameters.tail_watched != 0), low_mm(parameters.tail_low_mm), high_mm(parameters.tail_high_mm) {
  const double radius = parameters.own_body_radius_mm + parameters.tail_clearance_mm + slack_mm; // the tail is no longer than the own body (SK-PC-70)
  // A tail as wide as it is long has no corner to cut off: the sides are tangents then.
  const double side = std::min<double>(parameters.tail_half_width_mm + parameters.tail_clearance_mm + slack_mm, radius);
  // Lines: the sides, the back, and between them one on either side that touches the circle two thirds of the way to where the side cuts it.
  const double cut = std::asin(side / radius) * 2.0 / 3.0, c = std::cos(cut), s = std::sin(cut);
  const double side_x = -(radius - side * s) / c, back_y = radius * (1.0 - c) / s;
  const double x[tail_corners] = {slack_mm, side_x, -radius, -radius, side_x, slack_mm};
  const double y[tail_corners] = {side, side, back_y, -back_y, -side, -side};
  std::copy(x, x + tail_corners, x_mm);
  std::copy(y, y + tail_corners, y_mm);
  const double half_c = std::cos(0.5 * cut), half_s = std::sin(0.5 * cut);
  const double along[tail_normals] = {0.0, 0.0, 1.0, -1.0, -half_c, -half_c, -c, -c}, across[tail_normals] = {1.0, -1.0, 0.0, 0.0, half_s, -half_s, s, -s};
  std::copy(along, along + tail_normals, normal_x);
  std::copy(across, across + tail_normals, normal_y);
}

void tail_slice(const TailShape& tail, const SwingInterval& swing, sk_slice& slice) noexcept {
  slice.link = 0;
  slice.vertices = SK_SLICE_VERTICES;
  slice.planes = 1;
  slice.plane[0] = {0, 0, 1, tail.low_mm - 1};
  const double tangent = swing.sin_half / swing.cos_half;
  int vertex = 0;
  for (int i = 0; i < tail_corners; ++i) {
    for (const double turn : {-tangent, tangent}) { // (c rotated by the half) / cos half
      const double x = tail.x_mm[i] - turn * tail.y_mm[i], y = tail.y_mm[i] + turn * tail.x_mm[i];
      for (const int32_t z : {tail.low_mm, tail.high_mm}) {
        slice.xyz_mm[0][vertex] = static_cast<int32_t>(std::lrint(swing.cosine * x - swing.sine * y));
        slice.xyz_mm[1][vertex] = static_cast<int32_t>(std::lrint(swing.sine * x + swing.cosine * y));
        slice.xyz_mm[2][vertex] = z;
        ++vertex;
      }
    }
  }
}

} // namespace berm::kernel
