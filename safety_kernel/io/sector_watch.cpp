#include "io/sector_watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace berm::kernel {

namespace {

constexpr double kPi = 3.14159265358979323846;

std::int64_t square(std::int64_t v) { return v * v; }

}  // namespace

SectorWatch::SectorWatch(const berm_parameters& parameters)
    : parameters_(parameters),
      by_lidars_(parameters.lidars > 0),
      near_mm2_(square(parameters.workspace_radius_mm / 2)),
      far_mm2_(square(std::int64_t{parameters.workspace_radius_mm} * 5 / 4)) {
  rules_.approach_mm_s = parameters.workspace_approach_mm_s;
  rules_.intrusion_mm = parameters.workspace_intrusion_mm;
  // A cell is judged in the first update at which its first point is wait_us old (SK-WM-10; that it was put off meanwhile, SK-WM-20, only makes it
  // due sooner), an obstacle stops in that very update (SK-WM-41), and updates are a period and the rest of a cycle apart (SK-WM-43).
  const std::int64_t wait_us = by_lidars_ ? parameters.workspace_lidar_wait_us : parameters.workspace_wait_us;
  const std::int64_t period_us = by_lidars_ ? parameters.workspace_lidar_period_us : parameters.workspace_period_us;
  rules_.detect_us = static_cast<std::int32_t>(sight_us() + parameters.cycle_us + wait_us + period_us + parameters.cycle_us);
  for (int k = 0; k < kQuarter; ++k) {
    cosine_[k] = std::llround(1e6 * std::cos(k * 2.0 * kPi / SK_SECTORS));
    sine_[k] = std::llround(1e6 * std::sin(k * 2.0 * kPi / SK_SECTORS));
  }
  begin();
}

void SectorWatch::begin() { sk_sectors_begin(&sectors_); }

std::int32_t SectorWatch::sector_of(std::int32_t x_mm, std::int32_t y_mm) const {
  // Turned back into the first quarter: along > 0, aside >= 0.
  std::int64_t along = x_mm, aside = y_mm;
  std::int32_t quarter = 0;
  while (quarter < 3 && !(along > 0 && aside >= 0)) {
    const std::int64_t turned = -along;
    along = aside;
    aside = turned;
    ++quarter;
  }
  std::int32_t low = 0, high = kQuarter;  // the place is not before the low edge of low, and before that of high
  while (high - low > 1) {
    const std::int32_t middle = (low + high) / 2;
    (cosine_[middle] * aside >= sine_[middle] * along ? low : high) = middle;
  }
  return quarter * kQuarter + low;
}

void SectorWatch::see(std::int32_t x_mm, std::int32_t y_mm, std::int64_t now_us) {
  if (!evaluated() || std::llabs(x_mm) > SK_COORD_MAX_MM || std::llabs(y_mm) > SK_COORD_MAX_MM) return;
  const std::int64_t distance_mm2 = square(x_mm) + square(y_mm);
  if (distance_mm2 < near_mm2_ || distance_mm2 > far_mm2_) return;
  sk_sector_see(&sectors_.sector[sector_of(x_mm, y_mm)], now_us, rules_.detect_us);
}

void SectorWatch::take(const ScanBlocks& blocks, std::int64_t now_us) {
  if (!evaluated() || by_lidars_) return;
  for (int b = 0; b < blocks.count; ++b) {
    const berm_scan_block& block = blocks.block[b];
    for (int i = 0; i < block.count; ++i)
      if (block.used[i] != 0) see(block.point_mm[i][0], block.point_mm[i][1], now_us);
  }
}

void SectorWatch::take(const LidarReturns& returns, std::int64_t now_us) {
  if (!evaluated() || !by_lidars_) return;
  for (int i = 0; i < returns.count; ++i) see(returns.hit[i].point.x_mm, returns.hit[i].point.y_mm, now_us);
}

sk_separation SectorWatch::left(std::int32_t reach_mm, std::int64_t now_us) const {
  const std::int32_t hazard_mm = std::max(reach_mm, parameters_.tail_radius_mm);
  return sk_separate(&sectors_, now_us, rules_, parameters_.workspace_radius_mm - hazard_mm);
}

}  // namespace berm::kernel
