#include "io/space_watch.hpp"

#include <algorithm>
#include <cmath>

#include "core/overpass.h"
#include "geometry/lanes.hpp"

namespace berm::kernel {

namespace {

bool touches(std::int32_t iy, std::int32_t ix, const berm_truck_zone& z) {
  return sk_is_touched(iy, ix, z.x_low_mm, z.y_low_mm, z.x_high_mm, z.y_high_mm);
}

// A ray's way, mm.
struct Way { double dx, dy, dz, length; };

sk_voxel voxel_at(std::int32_t place) { return {place / (SK_VOXELS * SK_VOXELS), place / SK_VOXELS % SK_VOXELS, place % SK_VOXELS}; }

// Of the points one step after another along a ray the places of their voxels in the space, -1 of one outside; four more may be written. The voxels are
// those of sk_voxel_of: of a whole number n the half above it is 1/300 from a whole number of voxels at the least, which the product's rounding cannot
// reach over.
BERM_LANES_CLONES void places_along(const sk_point& head, const Way& way, int steps, std::int32_t* place) {
  constexpr double per_voxel = 1.0 / SK_VOXEL_MM;
  const auto same = [](auto v, auto& four) { four = decltype(four + v){v, v, v, v}; };
  FourDouble length, step, half, part;
  FourInt zero, sides, levels, none;
  same(way.length, length), same(SpaceWatch::kStepMm, step), same(0.5, half), same(per_voxel, part);
  same(0, zero), same(SK_VOXELS, sides), same(SK_VOXEL_LEVELS, levels), same(-1, none);
  FourDouble k{1.0, 2.0, 3.0, 4.0}, four;
  same(4.0, four);
  for (int first = 0; first < steps; first += 4, k += four) {
    const FourDouble f = k * step / length;
    FourInt inside = none;  // all bits: yes
    const auto index = [&](std::int32_t from, double change, std::int32_t low, FourInt count) {
      const FourInt n = __builtin_convertvector(f * change, FourInt) + from - low;
      const FourInt i = __builtin_convertvector((__builtin_convertvector(n, FourDouble) + half) * part, FourInt);
      inside &= (n >= zero) & (i < count);
      return i;
    };
    const FourInt level = index(head.z_mm, way.dz, SK_VOXEL_FLOOR_MM, levels), jy = index(head.y_mm, way.dy, SK_MAP_ORIGIN_MM, sides);
    const FourInt jx = index(head.x_mm, way.dx, SK_MAP_ORIGIN_MM, sides);
    store4(place + first, inside != zero ? (level * sides + jy) * sides + jx : none);
  }
}

// Of the voxels that reach above the height.
std::int32_t lowest_above(std::int32_t z_mm) { return std::clamp((z_mm - SK_VOXEL_FLOOR_MM) / SK_VOXEL_MM, 0, SK_VOXEL_LEVELS); }

}  // namespace

SpaceWatch::SpaceWatch(const berm_parameters& parameters) : parameters_(parameters), without_zones_(parameters), limits_{}, region_{} {
  without_zones_.truck_zones = 0;
  if (parameters.workspace_histogram != 0) without_zones_.dig_zones = 0;
  sk_pass_limits(&parameters_, false, &limits_);
  begin();
  watch(true, false);
}

// Again in every cycle while the base has moved: nothing is done twice.
void SpaceWatch::begin() {
  if (!blank_) {
    sk_space_begin(&space_);
    std::fill_n(&met_us_[0][0], SK_MAP_CELLS * SK_MAP_CELLS, -1);
    std::fill_n(&low_us_[0][0], SK_MAP_CELLS * SK_MAP_CELLS, -1);
    std::fill_n(&low_mm_[0][0], SK_MAP_CELLS * SK_MAP_CELLS, 0);
  }
  std::fill_n(&soil_mm_[0][0], SK_MAP_CELLS * SK_MAP_CELLS, kNoSoilMm);
  blank_ = true;
}

void SpaceWatch::forget(const berm_lane& lane) {
  for (std::int32_t iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (std::int32_t ix = 0; ix < SK_MAP_CELLS; ++ix)
      if (sk_is_touched(iy, ix, lane.x_low_mm, lane.y_low_mm, lane.x_high_mm, lane.y_high_mm)) sk_space_forget(&space_, iy, ix);
}

void SpaceWatch::take(const sk_point& head, const sk_point& point, bool learning, std::int64_t now_us) {
  const double dx = point.x_mm - head.x_mm, dy = point.y_mm - head.y_mm, dz = point.z_mm - head.z_mm, length = std::sqrt(dx * dx + dy * dy + dz * dz);
  const double free_mm = std::min(length - kShortMm, kReachMm);
  const int steps = static_cast<int>(free_mm / kStepMm);
  std::int32_t place[kStepsMost + 4];
  if (steps > 0) places_along(head, {dx, dy, dz, length}, steps, place);
  const std::uint8_t* const flags = &space_.voxel[0][0][0];
  for (int k = 0; k < steps; ++k)
    if (place[k] >= 0 && flags[place[k]] != SK_VOXEL_FREE) sk_space_pass(&space_, voxel_at(place[k]));  // a free one stays so
  meet(point, learning, now_us);
}

void SpaceWatch::meet(const sk_point& point, bool learning, std::int64_t now_us) {
  blank_ = false;
  const sk_voxel voxel = sk_voxel_of(point.x_mm, point.y_mm, point.z_mm);
  sk_space_return(&space_, voxel, learning);
  see(voxel, now_us);
}

void SpaceWatch::see(const sk_voxel& v, std::int64_t now_us) {
  const bool inside = v.level >= 0 && v.level < SK_VOXEL_LEVELS && v.jy >= 0 && v.jy < SK_VOXELS && v.jx >= 0 && v.jx < SK_VOXELS;
  if (!inside || space_.voxel[v.level][v.jy][v.jx] != SK_VOXEL_FOREIGN) return;
  met_us_[v.jy / 2][v.jx / 2] = now_us;
  low_us_[v.jy / 2][v.jx / 2] = -1;
}

bool SpaceWatch::met_about(const sk_monitor_cell& at, std::int64_t now_us) const {
  const std::int64_t lately_us = 2 * std::int64_t{parameters_.workspace_period_us};
  for (std::int32_t iy = at.iy - 1; iy <= at.iy + 1; ++iy)
    for (std::int32_t ix = at.ix - 1; ix <= at.ix + 1; ++ix)
      if (sk_is_in_map(iy, ix) && met_us_[iy][ix] >= 0 && now_us - met_us_[iy][ix] <= lately_us) return true;
  return false;
}

void SpaceWatch::pass_low(const sk_monitor_cell& at, std::int32_t z_mm, std::int64_t now_us) {
  if (!sk_is_in_map(at.iy, at.ix) || space_.foreign[at.iy][at.ix] == 0 || met_about(at, now_us)) return;
  std::int64_t& low_us = low_us_[at.iy][at.ix];
  std::int32_t& low_mm = low_mm_[at.iy][at.ix];
  if (low_us < 0 || low_us > now_us) low_us = now_us, low_mm = z_mm;
  if (now_us - low_us < parameters_.workspace_wait_us) return;
  low_us = -1;
  for (std::int32_t level = lowest_above(std::max(low_mm, z_mm)); level < SK_VOXEL_LEVELS; ++level)
    for (std::int32_t n = 0; n < 4; ++n) {
      const sk_voxel v{level, 2 * at.iy + n / 2, 2 * at.ix + n % 2};
      if (space_.voxel[level][v.jy][v.jx] == SK_VOXEL_FOREIGN) sk_space_pass(&space_, v);
    }
}

void SpaceWatch::watch(bool lanes_open, bool truck_learned) {
  sk_watch_region(&region_, &without_zones_, lanes_open);
  for (int i = 0; i < parameters_.truck_zones; ++i) leave_out(parameters_.truck_zone[i], truck_learned);
}

void SpaceWatch::dig(const std::vector<DigWatch::Cell>& cells, bool heights_learned, bool held) {
  for (const DigWatch::Cell& cell : cells) {
    std::int32_t& soil_mm = soil_mm_[cell.at.iy][cell.at.ix];
    if (cell.stirred && !held) soil_mm = static_cast<std::int32_t>(std::lround(1e3 * cell.ceiling_m));
    else if (!cell.stirred && !heights_learned) soil_mm = kNoSoilMm;
  }
}

bool SpaceWatch::may_be_soil(const sk_point& point) const {
  const std::int32_t iy = sk_map_index(point.y_mm), ix = sk_map_index(point.x_mm);
  return sk_is_in_map(iy, ix) && point.z_mm <= soil_mm_[iy][ix];
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
