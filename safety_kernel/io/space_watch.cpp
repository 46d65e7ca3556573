#include "io/space_watch.hpp"

#include <algorithm>
#include <cmath>

#include "core/overpass.h"

namespace berm::kernel {

namespace {

bool touches(std::int32_t iy, std::int32_t ix, const berm_truck_zone& z) {
  return sk_is_touched(iy, ix, z.x_low_mm, z.y_low_mm, z.x_high_mm, z.y_high_mm);
}

}  // namespace

SpaceWatch::SpaceWatch(const berm_parameters& parameters) : parameters_(parameters), without_truck_zones_(parameters), limits_{}, region_{} {
  without_truck_zones_.truck_zones = 0;
  sk_pass_limits(&parameters_, false, &limits_);
  begin();
  watch(true, false);
}

// Again in every cycle while the base has moved: nothing is done twice.
void SpaceWatch::begin() {
  if (!blank_) sk_space_begin(&space_);
  blank_ = true;
}

void SpaceWatch::forget(const berm_lane& lane) {
  for (std::int32_t iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (std::int32_t ix = 0; ix < SK_MAP_CELLS; ++ix)
      if (sk_is_touched(iy, ix, lane.x_low_mm, lane.y_low_mm, lane.x_high_mm, lane.y_high_mm)) sk_space_forget(&space_, iy, ix);
}

void SpaceWatch::take(const sk_point& head, const sk_point& point, bool learning) {
  const double dx = point.x_mm - head.x_mm, dy = point.y_mm - head.y_mm, dz = point.z_mm - head.z_mm, length = std::sqrt(dx * dx + dy * dy + dz * dz);
  const double free_mm = std::min(length - kShortMm, kReachMm);
  const int steps = static_cast<int>(free_mm / kStepMm);
  sk_voxel passed{-1, -1, -1};
  for (int k = 1; k <= steps; ++k) {
    const double f = k * kStepMm / length;
    const auto at = [f](std::int32_t from, double change) { return from + static_cast<std::int32_t>(f * change); };
    const sk_voxel v = sk_voxel_of(at(head.x_mm, dx), at(head.y_mm, dy), at(head.z_mm, dz));
    if (v.level == passed.level && v.jy == passed.jy && v.jx == passed.jx) continue;
    sk_space_pass(&space_, v);
    passed = v;
  }
  meet(point, learning);
}

void SpaceWatch::meet(const sk_point& point, bool learning) {
  blank_ = false;
  sk_space_return(&space_, sk_voxel_of(point.x_mm, point.y_mm, point.z_mm), learning);
}

void SpaceWatch::watch(bool lanes_open, bool truck_learned) {
  sk_watch_region(&region_, &without_truck_zones_, lanes_open);
  for (int i = 0; i < parameters_.truck_zones; ++i) leave_out(parameters_.truck_zone[i], truck_learned);
}

bool SpaceWatch::stands_high(std::int32_t iy, std::int32_t ix) const {
  const std::int32_t limit_mm = std::max<std::int32_t>(limits_.pass_mm[iy][ix], SK_VOXEL_FLOOR_MM);
  for (std::int32_t k = (limit_mm - SK_VOXEL_FLOOR_MM) / SK_VOXEL_MM + 1; k < SK_VOXEL_LEVELS; ++k)
    for (std::int32_t n = 0; n < 4; ++n)
      if (space_.voxel[k][2 * iy + n / 2][2 * ix + n % 2] == SK_VOXEL_SOLID) return true;
  return false;
}

void SpaceWatch::leave_out(const berm_truck_zone& zone, bool truck_learned) {
  std::int32_t low_y = SK_MAP_CELLS, high_y = -1, low_x = SK_MAP_CELLS, high_x = -1;
  for (std::int32_t iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (std::int32_t ix = 0; ix < SK_MAP_CELLS; ++ix) {
      if (!touches(iy, ix, zone) || (truck_learned && !stands_high(iy, ix))) continue;
      low_y = std::min(low_y, iy);
      high_y = std::max(high_y, iy);
      low_x = std::min(low_x, ix);
      high_x = std::max(high_x, ix);
    }
  for (std::int32_t iy = low_y; iy <= high_y; ++iy)
    for (std::int32_t ix = low_x; ix <= high_x; ++ix) region_.watched[iy][ix] = 0;
}

bool SpaceWatch::find(sk_monitor_cell& where) const { return kept() && sk_space_find(&space_, &region_, parameters_.workspace_foreign, &where); }

std::int32_t SpaceWatch::foreign_height_mm(const sk_monitor_cell& cell) const {
  for (std::int32_t k = SK_VOXEL_LEVELS - 1; k >= 0; --k)
    for (std::int32_t n = 0; n < 4; ++n)
      if (space_.voxel[k][2 * cell.iy + n / 2][2 * cell.ix + n % 2] == SK_VOXEL_FOREIGN) return SK_VOXEL_FLOOR_MM + SK_VOXEL_MM * k;
  return SK_VOXEL_FLOOR_MM;
}

}  // namespace berm::kernel
