#include "planar_sweep.hpp"

#include <algorithm>
#include <cmath>

namespace berm::kernel::test {
namespace {

using Complex = std::complex<double>;
constexpr double pi = 3.141592653589793;

std::vector<double> steps(const sk_reach_box& box, int joint, bool moves, double lever_mm, double step_mm) {
  const double low = box.low_urad[joint] * 1e-6, high = box.high_urad[joint] * 1e-6;
  const int pieces = moves ? std::max(1, static_cast<int>(std::ceil((high - low) * lever_mm / step_mm))) : 0;
  std::vector<double> out;
  for (int i = 0; i <= pieces; ++i) out.push_back(pieces == 0 ? low : low + (high - low) * i / pieces);
  return out;
}

} // namespace

PlanarSweep::PlanarSweep(const berm_parameters& p, const sk_reach_box& box, int index, double step_mm)
    : swing_low_(box.low_urad[0] * 1e-6), swing_high_(box.high_urad[0] * 1e-6), half_width_mm_(p.part[index].half_width_mm), bit_(static_cast<size_t>(cells) * words, 0) {
  const berm_part& part = p.part[index];
  std::vector<Complex> corner;
  double radius = 0.0;
  for (int i = 0; i < part.vertices; ++i) {
    corner.emplace_back(part.vertex_mm[i][0], part.vertex_mm[i][1]);
    radius = std::max(radius, std::abs(corner.back()));
  }
  const double stick_lever = radius + (part.link >= 3 ? p.stick_length_mm : 0), boom_lever = stick_lever + (part.link >= 2 ? p.boom_length_mm : 0);
  std::vector<Complex> polygon(corner.size());
  for (const double boom : steps(box, 1, true, boom_lever, step_mm))
    for (const double stick : steps(box, 2, part.link >= 2, stick_lever, step_mm))
      for (const double bucket : steps(box, 3, part.link >= 3, radius, step_mm)) {
        Complex at(p.boom_pin_x_mm, p.boom_pin_z_mm);
        double elevation = boom;
        if (part.link >= 2) {
          at += std::polar(static_cast<double>(p.boom_length_mm), elevation);
          elevation += stick;
        }
        if (part.link >= 3) {
          at += std::polar(static_cast<double>(p.stick_length_mm), elevation);
          elevation += bucket;
        }
        for (size_t i = 0; i < corner.size(); ++i) polygon[i] = at + corner[i] * std::polar(1.0, elevation);
        paint(polygon);
      }
}

// Row by row between the leftmost and rightmost of the convex outline at the row's middle.
void PlanarSweep::paint(const std::vector<Complex>& polygon) {
  double z_low = 1e9, z_high = -1e9;
  for (const Complex& c : polygon) {
    z_low = std::min(z_low, c.imag());
    z_high = std::max(z_high, c.imag());
  }
  const int first = static_cast<int>(std::ceil((z_low - origin_mm) / cell_mm - 0.5)), last = static_cast<int>(std::floor((z_high - origin_mm) / cell_mm - 0.5));
  for (int row = std::max(0, first); row <= std::min(cells - 1, last); ++row) {
    const double z = origin_mm + (row + 0.5) * cell_mm;
    double left = 1e9, right = -1e9;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Complex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      if ((a.imag() > z) == (b.imag() > z)) continue;
      const double r = a.real() + (b.real() - a.real()) * (z - a.imag()) / (b.imag() - a.imag());
      left = std::min(left, r);
      right = std::max(right, r);
    }
    const int from = std::max(0, static_cast<int>(std::ceil((left - origin_mm) / cell_mm - 0.5))), to = std::min(cells - 1, static_cast<int>(std::floor((right - origin_mm) / cell_mm - 0.5)));
    if (from > to) continue;
    uint64_t* line = bit_.data() + static_cast<size_t>(row) * words;
    for (int w = from / 64; w <= to / 64; ++w) {
      const uint64_t above = w == from / 64 ? ~uint64_t{0} << (from % 64) : ~uint64_t{0};
      const uint64_t below = w == to / 64 ? ~uint64_t{0} >> (63 - to % 64) : ~uint64_t{0};
      line[w] |= above & below;
    }
  }
}

bool PlanarSweep::any(double r_low, double r_high, double z) const {
  const int row = static_cast<int>(std::floor((z - origin_mm) / cell_mm));
  const int from = static_cast<int>(std::floor((r_low - origin_mm) / cell_mm)), to = static_cast<int>(std::floor((r_high - origin_mm) / cell_mm));
  if (row < 0 || row >= cells || from < 0 || to >= cells) return false;
  const uint64_t* line = bit_.data() + static_cast<size_t>(row) * words;
  for (int i = from; i <= to; ++i)
    if ((line[i / 64] >> (i % 64) & 1U) != 0) return true;
  return false;
}

// At swing s the point lies at r = rho cos d, y = rho sin d with d = bearing - s, and is the part's where |y| <= w.
bool PlanarSweep::contains(double x, double y, double z) const {
  const double rho = std::hypot(x, y), bearing = std::atan2(y, x);
  const double a = half_width_mm_ < rho ? std::asin(half_width_mm_ / rho) : 0.5 * pi;
  for (int turn = -4; turn <= 4; ++turn) { // centre of a window of d: before the axis at even, behind it at odd half turns
    const double centre = turn * pi;
    const double low = std::max(bearing - swing_high_, centre - a) - centre, high = std::min(bearing - swing_low_, centre + a) - centre;
    if (low > high) continue;
    const double most = low <= 0.0 && high >= 0.0 ? rho : rho * std::cos(std::min(std::fabs(low), std::fabs(high)));
    const double least = rho * std::cos(std::max(std::fabs(low), std::fabs(high)));
    if (turn % 2 == 0 ? any(least, most, z) : any(-most, -least, z)) return true;
  }
  return false;
}

} // namespace berm::kernel::test
