#include "io/motion_check.hpp"

#include <algorithm>
#include <cstdlib>

#include "geometry/reach.hpp"
#include "geometry/separation.hpp"
#include "io/own_cells.hpp"

namespace berm::kernel {

namespace {

std::uint8_t reason_of(std::int32_t verdict) {
  switch (verdict) {
    case SK_BLOCKED_COLLISION: return BERM_STOP_COLLISION_PREDICTED;
    case SK_BLOCKED_UNKNOWN: return BERM_STOP_UNKNOWN_GROUND;
    case SK_BLOCKED_STALE: return BERM_STOP_STALE_GROUND;
    case SK_BLOCKED_FLOOR: return BERM_STOP_DIG_FLOOR;
    default: return BERM_STOP_INTERNAL;
  }
}

bool in_map(std::int32_t index) { return index >= 0 && index < SK_MAP_CELLS; }

std::int32_t cell_centre_mm(std::int32_t index) { return SK_MAP_ORIGIN_MM + index * SK_CELL_MM + SK_CELL_MM / 2; }

}  // namespace

std::int32_t limited_command(std::int32_t requested_urad_s, std::int32_t limit_urad_s) {
  return std::clamp(requested_urad_s, -limit_urad_s, limit_urad_s) / kCommandStepUradS * kCommandStepUradS;
}

MotionCheck::MotionCheck(const berm_parameters& parameters) : parameters_(parameters), shape_(parameters), rules_{}, columns_{}, choice_{} {
  rules_.fresh_us = parameters.fresh_us;
  rules_.margin_mm = parameters.margin_mm;
  rules_.dig_zones = parameters.dig_zones;
  std::copy(parameters.dig_zone, parameters.dig_zone + BERM_DIG_ZONES, rules_.dig_zone);
}

bool MotionCheck::reach(const MotionQuery& query, int mode, const std::int32_t* low_urad_s, const std::int32_t* high_urad_s, sk_reach_box& box) const {
  const auto joints = [&](int first, std::int32_t row) {
    for (int j = first; j < SK_JOINTS; ++j) {
      if (!sk_reach_joint(&parameters_, j, row, query.angle_urad[j], query.velocity_urad_s[j], mode, low_urad_s[j], high_urad_s[j], &box)) return false;
    }
    return true;
  };
  // The row depends on the reach, and the reach on the row: the last row bounds the intervals, so the reach over them holds for the
  // smaller intervals of any row before it too.
  if (!joints(BERM_BOOM, BERM_BRAKE_REACHES - 1)) return false;
  const std::int32_t reach_mm = max_reach_mm(parameters_, box);
  if (reach_mm < 0) return false;
  const std::int32_t row = sk_brake_row(&parameters_, reach_mm);
  return row >= 0 && joints(BERM_SWING, row);
}

bool MotionCheck::joints_within(const sk_reach_box& box, const std::int32_t* low_urad_s, const std::int32_t* high_urad_s) const {
  // A joint that stands beyond its range may move back, and only back.
  for (int j = 0; j < SK_JOINTS; ++j) {
    if (box.low_urad[j] < parameters_.joint_low_urad[j] && low_urad_s[j] < 0) return false;
    if (box.high_urad[j] > parameters_.joint_high_urad[j] && high_urad_s[j] > 0) return false;
  }
  return true;
}

void MotionCheck::note_cell(const sk_height_map& map, const sk_slice& slice, const sk_clearance_result& result, MotionVerdict& verdict) const {
  verdict.has_cell = true;
  verdict.blocked_link = static_cast<std::uint32_t>(slice.link);
  const bool inside = in_map(result.ix) && in_map(result.iy);
  verdict.blocked_x_mm = inside ? cell_centre_mm(result.ix) : 0;
  verdict.blocked_y_mm = inside ? cell_centre_mm(result.iy) : 0;
  verdict.blocked_height_mm = inside && map.seen_us[result.iy][result.ix] >= 0 ? sk_map_top(&map, result.iy, result.ix) : 0;
}

std::uint8_t MotionCheck::clear(const MotionQuery& query, const sk_height_map& map, const sk_reach_box& box, SliceSet& slices, bool creeping,
                                MotionVerdict& verdict) {
  if (!build_slices(shape_, box, slices)) return BERM_STOP_INTERNAL;
  rules_.now_us = query.now_us;
  rules_.dig_stale = creeping;  // else a bucket that stood in a pit, which hides the ground before it, could never leave
  rules_.dig_allowed = box.speed_urad_s[BERM_SWING] <= parameters_.dig_swing_limit_urad_s;
  for (int s = 0; s < slices.count; ++s) {
    const sk_slice& slice = slices.slice[s];
    rules_.own_body_radius_mm = slice.link == BERM_BOOM ? own_and_rim_radius_mm(parameters_) : 0;  // the map has the columns
    // The search may fail or be wrong: what it chose is only a claim, which the core checks.
    const sk_clearance_result result = clear_slice(map, columns_, rules_, slices, s, choice_);
    ++verdict.slices;
    verdict.cells += result.cells;
    if (result.verdict != SK_CLEAR) {
      if (!verdict.has_cell) note_cell(map, slice, result, verdict);
      return reason_of(result.verdict);
    }
  }
  return slices.count > 0 ? BERM_STOP_NONE : BERM_STOP_INTERNAL;
}

std::uint8_t MotionCheck::creep(const MotionQuery& query, const sk_height_map& map, MotionVerdict& verdict) {
  std::int32_t low[4], high[4];
  for (int j = 0; j < SK_JOINTS; ++j) {
    const std::int32_t limit = parameters_.creep_velocity_urad_s[j];
    if (std::abs(query.velocity_urad_s[j]) > limit) return verdict.reason;
    verdict.command_urad_s[j] = limited_command(query.requested_urad_s[j], limit);
    low[j] = std::min(query.under_way_low_urad_s[j], verdict.command_urad_s[j]);
    high[j] = std::max(query.under_way_high_urad_s[j], verdict.command_urad_s[j]);
  }
  sk_reach_box box{};
  if (!reach(query, SK_REACH_COMMANDED, low, high, box) || !joints_within(box, low, high)) return BERM_STOP_JOINT_RANGE;
  return clear(query, map, box, creep_slices_, true, verdict);
}

void MotionCheck::check(const MotionQuery& query, const sk_height_map& map, MotionVerdict& verdict) {
  verdict = MotionVerdict{};
  // Any command: at once in either direction.
  std::int32_t low[4], high[4];
  for (int j = 0; j < SK_JOINTS; ++j) {
    high[j] = parameters_.velocity_max_urad_s[j];
    low[j] = -high[j];
  }
  any_slices_.count = 0;
  rules_.now_us = query.now_us;
  if (!sk_columns_of(&map, &rules_, &columns_)) {
    verdict.reason = BERM_STOP_INTERNAL;
    verdict.permission = Permission::kHeld;
    return;
  }
  if (!reach(query, SK_REACH_ANY, low, high, verdict.box) || !joints_within(verdict.box, low, high)) {
    verdict.reason = BERM_STOP_JOINT_RANGE;
    build_slices(shape_, verdict.box, any_slices_);  // for observers only
  } else {
    verdict.reason = clear(query, map, verdict.box, any_slices_, false, verdict);
  }
  if (verdict.reason == BERM_STOP_NONE) {
    verdict.permission = Permission::kFull;
    for (int j = 0; j < SK_JOINTS; ++j) verdict.command_urad_s[j] = limited_command(query.requested_urad_s[j], parameters_.velocity_max_urad_s[j]);
    return;
  }
  MotionVerdict recovery = verdict;
  recovery.has_cell = false;
  const std::uint8_t blocked = creep(query, map, recovery);
  verdict.slices = recovery.slices;
  verdict.cells = recovery.cells;
  if (blocked == BERM_STOP_NONE) {
    verdict.permission = Permission::kCreep;
    std::copy(recovery.command_urad_s, recovery.command_urad_s + 4, verdict.command_urad_s);
    return;
  }
  verdict.permission = Permission::kHeld;
  if (!recovery.has_cell) return;
  // What blocks even the creeping is the nearer cause.
  verdict.reason = blocked;
  verdict.has_cell = true;
  verdict.blocked_x_mm = recovery.blocked_x_mm;
  verdict.blocked_y_mm = recovery.blocked_y_mm;
  verdict.blocked_height_mm = recovery.blocked_height_mm;
  verdict.blocked_link = recovery.blocked_link;
}

}  // namespace berm::kernel
