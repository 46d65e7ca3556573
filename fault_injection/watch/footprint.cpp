#include "watch/footprint.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace berm::watch {

namespace {

constexpr double cell_m = SK_CELL_MM * 1e-3, origin_m = SK_MAP_ORIGIN_MM * 1e-3;

int cell_of(double at) { return static_cast<int>(std::floor((at - origin_m) / cell_m)); }
bool in_map(int i) { return i >= 0 && i < SK_MAP_CELLS; }

struct Cells { int x_first, x_last, y_first, y_last; };  // those of the map within reach of a point
Cells around(double x, double y, double reach) {
  const auto kept = [](int i) { return std::clamp(i, 0, SK_MAP_CELLS - 1); };
  return {kept(cell_of(x - reach)), kept(cell_of(x + reach)), kept(cell_of(y - reach)), kept(cell_of(y + reach))};
}

// Whether the square's and the rectangle's shadows on an axis of the rectangle lie apart.
bool apart(double middle, double half, double axis_x, double axis_y, const std::array<std::array<double, 2>, 4>& corner) {
  double low = 1e9, high = -1e9;
  for (const auto& c : corner) {
    const double at = axis_x * c[0] + axis_y * c[1];
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return low > middle + half || high < middle - half;
}

}  // namespace

Footprint footprint_of(const plant::MoverConfig& shape, double x, double y, double yaw) {
  return shape.vehicle ? Footprint{x, y, yaw, 0.0, shape.length, shape.width} : Footprint{x, y, yaw, shape.radius, 0.0, 0.0};
}

double distance(const Footprint& f, double x, double y) {
  const double dx = x - f.x, dy = y - f.y;
  if (f.length <= 0.0) return std::max(0.0, std::hypot(dx, dy) - f.radius);
  const double c = std::cos(f.yaw), s = std::sin(f.yaw);
  const double along = std::fabs(c * dx + s * dy) - 0.5 * f.length, across = std::fabs(c * dy - s * dx) - 0.5 * f.width;
  return std::hypot(std::max(along, 0.0), std::max(across, 0.0));
}

bool meets_square(const Footprint& f, double x, double y, double side) {
  const double near_x = std::clamp(f.x, x, x + side), near_y = std::clamp(f.y, y, y + side);
  if (f.length <= 0.0) return std::hypot(near_x - f.x, near_y - f.y) <= f.radius;
  const double c = std::cos(f.yaw), s = std::sin(f.yaw);
  const std::array<std::array<double, 2>, 4> square{{{x, y}, {x + side, y}, {x, y + side}, {x + side, y + side}}};
  if (apart(c * f.x + s * f.y, 0.5 * f.length, c, s, square) || apart(c * f.y - s * f.x, 0.5 * f.width, -s, c, square)) return false;
  const double half_x = 0.5 * (f.length * std::fabs(c) + f.width * std::fabs(s)), half_y = 0.5 * (f.length * std::fabs(s) + f.width * std::fabs(c));
  return std::fabs(near_x - f.x) <= half_x && std::fabs(near_y - f.y) <= half_y;
}

double outer_radius(const Footprint& f) { return f.length > 0.0 ? 0.5 * std::hypot(f.length, f.width) : f.radius; }

bool watched_at(const Region& region, double x, double y) {
  const int ix = cell_of(x), iy = cell_of(y);
  return in_map(ix) && in_map(iy) && region.watched(iy, ix);
}

bool meets_region(const Footprint& f, const Region& region) {
  const Cells cells = around(f.x, f.y, outer_radius(f));
  for (int iy = cells.y_first; iy <= cells.y_last; ++iy)
    for (int ix = cells.x_first; ix <= cells.x_last; ++ix)
      if (region.watched(iy, ix) && meets_square(f, origin_m + cell_m * ix, origin_m + cell_m * iy, cell_m)) return true;
  return false;
}

bool Held::somebody(int iy, int ix) const {
  if (heights == nullptr) return false;
  if (histograms == nullptr) return sk_flag_is_obstacle(heights->accumulated_flag[iy][ix]);
  return histograms->state[iy][ix] != SK_CELL_LEARNING && histograms->state[iy][ix] != SK_CELL_CLEAR;
}

bool somebody_near(const Footprint& f, double within, const Held& held, const sk_monitor_rules& rules) {
  const Cells cells = around(f.x, f.y, outer_radius(f) + within);
  for (int iy = cells.y_first; iy <= cells.y_last; ++iy)
    for (int ix = cells.x_first; ix <= cells.x_last; ++ix)
      if (rules.watched[iy][ix] != 0 && held.somebody(iy, ix) &&
          distance(f, origin_m + cell_m * (ix + 0.5), origin_m + cell_m * (iy + 0.5)) <= within)
        return true;
  return false;
}

plant::oracle::Body body_of(const plant::MoverConfig& shape, const plant::MoverPose& pose) {
  if (!shape.vehicle) return plant::oracle::Body::cylinder({pose.x, pose.y, pose.z}, shape.radius, shape.height);
  return plant::oracle::body_of(
      {shape.name, pose.x, pose.y, pose.z, pose.yaw, {-shape.length / 2, -shape.width / 2, 0}, {shape.length / 2, shape.width / 2, shape.height}});
}

}  // namespace berm::watch
