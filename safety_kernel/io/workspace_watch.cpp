#include "io/workspace_watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/monitor_forget.h"
#include "core/monitor_settle.h"

namespace berm::kernel {

WorkspaceWatch::WorkspaceWatch(const berm_parameters& parameters) : parameters_(parameters), space_(parameters) {
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
  space_.begin();
  space_.watch(lanes_open_, false);
  for (Last& last : last_) last = Last{};
  where_ = {-1, -1};
  in_space_ = begun_ = false;
  in_space_us_ = -1;
  learned_us_ = lane_learned_us_ = kNotLearning;
}

sk_point WorkspaceWatch::head(int scanner, std::int64_t time_us, const JointHistory& joints) const {
  const berm_scanner_mount& mount = parameters_.scanner[scanner];
  const double swing = joints.at(time_us).angles.swing, cosine = std::cos(swing), sine = std::sin(swing);
  const auto mm = [](double v) { return static_cast<std::int32_t>(std::lround(v)); };
  return {mm(cosine * mount.x_mm - sine * mount.y_mm), mm(sine * mount.x_mm + cosine * mount.y_mm), mount.z_mm};
}

bool WorkspaceWatch::learning(const sk_point& point) const {
  if (!begun_ || learned_us_ != kNotLearning) return true;
  return lane_learned_us_ != kNotLearning && std::any_of(parameters_.lane, parameters_.lane + parameters_.lanes, [&](const berm_lane& lane) {
    return sk_is_touched(sk_map_index(point.y_mm), sk_map_index(point.x_mm), lane.x_low_mm, lane.y_low_mm, lane.x_high_mm, lane.y_high_mm);
  });
}

void WorkspaceWatch::take(const ScanBlocks& blocks, const JointHistory& joints, std::int64_t now_us) {
  if (!watched()) return;
  for (int b = 0; b < blocks.count; ++b) {
    const berm_scan_block& block = blocks.block[b];
    Last& last = last_[block.scanner % BERM_SCANNERS];
    const sk_point from = head(block.scanner % BERM_SCANNERS, block.time_us, joints);
    for (int i = 0; i < block.count; ++i) {
      const sk_point point{block.point_mm[i][0], block.point_mm[i][1], block.point_mm[i][2]};
      const std::int32_t index = block.first_index + i;
      if (block.used[i] == 0) continue;
      if (last.scanline == block.scanline && last.index + 1 == index) interpolate(last.point, point, now_us);
      insert(point, false, now_us);
      if (space_.kept()) space_.take(from, point, learning(point));
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

void WorkspaceWatch::trucks(bool spotter_fresh, bool parked, std::int64_t now_us) {
  if (!watched() || !spotter_fresh || parked != lanes_open_) return;
  lanes_open_ = !parked;
  for (int i = 0; i < parameters_.lanes; ++i) {
    const berm_lane& lane = parameters_.lane[i];
    sk_forget_rectangle(&monitor_, lane.x_low_mm, lane.y_low_mm, lane.x_high_mm, lane.y_high_mm);
    space_.forget(lane);
  }
  lane_learned_us_ = now_us + parameters_.workspace_learn_us;
  sk_watch_region(&rules_, &parameters_, lanes_open_);
  space_.watch(lanes_open_, false);
}

// What is CHANGED by now belongs to the ground: it explains what is seen beside it.
void WorkspaceWatch::end_learning(std::int64_t now_us) {
  constexpr std::int32_t kSide = -SK_MAP_ORIGIN_MM;
  if (!begun_) learned_us_ = now_us + parameters_.workspace_learn_us;
  begun_ = true;
  const bool all = learned_us_ != kNotLearning && now_us >= learned_us_, lanes = lane_learned_us_ != kNotLearning && now_us >= lane_learned_us_;
  if (all) sk_settle_rectangle(&monitor_, rules_.continuous, -kSide, -kSide, kSide, kSide);
  for (int i = 0; lanes && i < parameters_.lanes; ++i) {
    const berm_lane& lane = parameters_.lane[i];
    sk_settle_rectangle(&monitor_, rules_.continuous, lane.x_low_mm, lane.y_low_mm, lane.x_high_mm, lane.y_high_mm);
  }
  if (all) learned_us_ = kNotLearning;
  if (lanes) lane_learned_us_ = kNotLearning;
  if (all || lanes) space_.watch(lanes_open_, !lanes_open_ && learned_us_ == kNotLearning && lane_learned_us_ == kNotLearning);
}

bool WorkspaceWatch::intruder(std::int64_t now_us) {
  where_ = {-1, -1};
  if (space_.find(where_)) in_space_us_ = now_us;
  in_space_ = where_.iy >= 0;
  return in_space_us_ >= 0 && now_us - in_space_us_ < rules_.dwell_us;
}

bool WorkspaceWatch::step(std::int64_t now_us) {
  if (!watched()) return false;
  end_learning(now_us);
  sk_monitor_cell risen{-1, -1};
  const bool rises = sk_monitor_step(&monitor_, &rules_, now_us, &risen), foreign = intruder(now_us);
  if (risen.iy >= 0) {
    where_ = risen;
    in_space_ = false;
  }
  return rises || foreign;
}

bool WorkspaceWatch::place(std::int32_t& x_mm, std::int32_t& y_mm, std::int32_t& height_mm) const {
  if (where_.iy < 0) return false;
  x_mm = SK_MAP_ORIGIN_MM + SK_CELL_MM * where_.ix + SK_CELL_MM / 2;
  y_mm = SK_MAP_ORIGIN_MM + SK_CELL_MM * where_.iy + SK_CELL_MM / 2;
  height_mm = in_space_ ? space_.foreign_height_mm(where_) : monitor_.obstacle_height_mm[where_.iy][where_.ix];
  return true;
}

}  // namespace berm::kernel
