#include "io/workspace_watch.hpp"

#include <algorithm>
#include <cstdlib>

#include "core/monitor_forget.h"

namespace berm::kernel {

WorkspaceWatch::WorkspaceWatch(const berm_parameters& parameters) : parameters_(parameters) {
  rules_.height_threshold_mm = parameters.workspace_rise_mm;
  rules_.neighbour_threshold_mm = parameters.workspace_neighbour_mm;
  rules_.slope_threshold_mm = parameters.workspace_slope_mm;
  rules_.wait_us = parameters.workspace_wait_us;
  rules_.period_us = parameters.workspace_period_us;
  rules_.dwell_us = parameters.workspace_dwell_us;
  rules_.continuous = parameters.workspace_follows != 0;
  sk_watch_region(&rules_, &parameters_, lanes_open_);
  begin();
}

void WorkspaceWatch::begin() {
  sk_monitor_begin(&monitor_);
  for (Last& last : last_) last = Last{};
  where_ = {-1, -1};
}

void WorkspaceWatch::take(const ScanBlocks& blocks, std::int64_t now_us) {
  if (!watched()) return;
  for (int b = 0; b < blocks.count; ++b) {
    const berm_scan_block& block = blocks.block[b];
    Last& last = last_[block.scanner % BERM_SCANNERS];
    for (int i = 0; i < block.count; ++i) {
      const sk_point point{block.point_mm[i][0], block.point_mm[i][1], block.point_mm[i][2]};
      const std::int32_t index = block.first_index + i;
      if (block.used[i] == 0) continue;
      if (last.scanline == block.scanline && last.index + 1 == index) interpolate(last.point, point, now_us);
      insert(point, false, now_us);
      last = {block.scanline, index, point};
    }
  }
}

void WorkspaceWatch::insert(const sk_point& point, bool interpolated, std::int64_t now_us) {
  sk_monitor_insert(&monitor_, sk_map_index(point.y_mm), sk_map_index(point.x_mm), point.z_mm, interpolated, now_us);
}

// In steps of half a cell: what a corner of the line cuts off stays EMPTY.
void WorkspaceWatch::interpolate(const sk_point& from, const sk_point& to, std::int64_t now_us) {
  const std::int64_t dx = std::int64_t{to.x_mm} - from.x_mm, dy = std::int64_t{to.y_mm} - from.y_mm, dz = std::int64_t{to.z_mm} - from.z_mm;
  const std::int64_t steps = std::min<std::int64_t>(std::max(std::abs(dx), std::abs(dy)) / (SK_CELL_MM / 2), kStepsMost);
  for (std::int64_t k = 1; k < steps; ++k) {
    const auto along = [k, steps](std::int32_t start, std::int64_t change) { return static_cast<std::int32_t>(start + change * k / steps); };
    insert({along(from.x_mm, dx), along(from.y_mm, dy), along(from.z_mm, dz)}, true, now_us);
  }
}

void WorkspaceWatch::trucks(bool spotter_fresh, bool parked) {
  if (!watched() || !spotter_fresh || parked != lanes_open_) return;
  lanes_open_ = !parked;
  for (int i = 0; i < parameters_.lanes; ++i) {
    const berm_lane& lane = parameters_.lane[i];
    sk_forget_rectangle(&monitor_, lane.x_low_mm, lane.y_low_mm, lane.x_high_mm, lane.y_high_mm);
  }
  sk_watch_region(&rules_, &parameters_, lanes_open_);
}

bool WorkspaceWatch::step(std::int64_t now_us) { return watched() && sk_monitor_step(&monitor_, &rules_, now_us, &where_); }

bool WorkspaceWatch::place(std::int32_t& x_mm, std::int32_t& y_mm, std::int32_t& height_mm) const {
  if (where_.iy < 0) return false;
  x_mm = SK_MAP_ORIGIN_MM + SK_CELL_MM * where_.ix + SK_CELL_MM / 2;
  y_mm = SK_MAP_ORIGIN_MM + SK_CELL_MM * where_.iy + SK_CELL_MM / 2;
  height_mm = monitor_.obstacle_height_mm[where_.iy][where_.ix];
  return true;
}

}  // namespace berm::kernel
