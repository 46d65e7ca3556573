#include "io/motion_check.hpp"

#include <algorithm>
#include <cstdlib>

#include "can/berm_can.h"
#include "core/overpass.h"
#include "geometry/reach.hpp"
#include "geometry/separation.hpp"

namespace berm::kernel {

namespace {

// The room ahead of the tail is of ground that was seen within a third of what is fresh: ground that will not be seen again grows stale one cycle, and a swing that had gone faster over it
// would be stopped. In the other two thirds it slows down to what is left.
constexpr std::int32_t kTailAheadShare = 3;

// Short of a row of the braking table by less than this the governor goes by the next: the arm's measured speeds scatter, and the box's reach with them; over the edge the box is a tenth of a
// radian longer in one cycle, over ground that may not be seen.
constexpr std::int32_t kNearRowMm = 150;

std::uint8_t reason_of(std::int32_t verdict, std::int32_t link) {
  if (link == BERM_SWING && (verdict == SK_BLOCKED_COLLISION || verdict == SK_BLOCKED_OVERPASS)) return BERM_STOP_TAIL;
  switch (verdict) {
    case SK_BLOCKED_COLLISION: return BERM_STOP_COLLISION_PREDICTED;
    case SK_BLOCKED_UNKNOWN: return BERM_STOP_UNKNOWN_GROUND;
    case SK_BLOCKED_STALE: return BERM_STOP_STALE_GROUND;
    case SK_BLOCKED_FLOOR: return BERM_STOP_DIG_FLOOR;
    case SK_BLOCKED_OVERPASS: return BERM_STOP_OVERPASS;
    default: return BERM_STOP_INTERNAL;
  }
}

bool in_map(std::int32_t index) { return index >= 0 && index < SK_MAP_CELLS; }

std::int32_t cell_centre_mm(std::int32_t index) { return SK_MAP_ORIGIN_MM + index * SK_CELL_MM + SK_CELL_MM / 2; }

}  // namespace

MotionCheck::MotionCheck(const berm_parameters& parameters, const OwnCells& own_cells)
    : parameters_(parameters), state_latency_us_(parameters.state_latency_us), shape_(parameters), own_cells_(own_cells), rules_{}, columns_{}, tail_columns_{}, choice_{} {
  // A cycle may be the last that the machine hears of, and may have been sent as late as that is allowed.
  parameters_.cycle_us = std::max<std::int32_t>(parameters.cycle_us, BERM_CAN_SILENCE_US) + BERM_CAN_SEND_LATE_US;
  rules_.fresh_us = parameters.fresh_us;
  rules_.margin_mm = parameters.margin_mm;
  rules_.dig_zones = parameters.dig_zones;
  std::copy(parameters.dig_zone, parameters.dig_zone + BERM_DIG_ZONES, rules_.dig_zone);
}

MotionCheck::Commands MotionCheck::commands(const MotionQuery& query, std::int32_t percent, bool creeping) const {
  Commands c{};
  for (int j = 0; j < SK_JOINTS; ++j) {
    const std::int32_t limit = creeping ? parameters_.creep_velocity_urad_s[j] : parameters_.velocity_max_urad_s[j];
    const auto slowed = static_cast<std::int32_t>(static_cast<std::int64_t>(query.requested_urad_s[j]) * percent / 100);
    c.send_urad_s[j] = sk_governor_clamp(slowed, -limit, limit);
    c.low_urad_s[j] = std::min({0, query.under_way_low_urad_s[j], c.send_urad_s[j]});
    c.high_urad_s[j] = std::max({0, query.under_way_high_urad_s[j], c.send_urad_s[j]});
  }
  return c;
}

bool MotionCheck::reach(const MotionQuery& query, const Commands& c, sk_reach_box& box) const {
  const auto joints = [&](int first, std::int32_t row) {
    for (int j = first; j < SK_JOINTS; ++j) {
      if (!sk_reach_joint(&parameters_, j, row, query.angle_urad[j], query.velocity_urad_s[j], SK_REACH_COMMANDED, c.low_urad_s[j], c.high_urad_s[j], &box)) return false;
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

bool MotionCheck::joints_within(const sk_reach_box& box, const Commands& c) const {
  // A joint that stands beyond its range may move back, and only back.
  for (int j = 0; j < SK_JOINTS; ++j) {
    if (box.low_urad[j] < parameters_.joint_low_urad[j] && c.low_urad_s[j] < 0) return false;
    if (box.high_urad[j] > parameters_.joint_high_urad[j] && c.high_urad_s[j] > 0) return false;
  }
  return true;
}

bool MotionCheck::folds(const MotionQuery& query, const Commands& c) const {
  const auto none_up = [&](int j) { return c.high_urad_s[j] <= 0 && query.velocity_urad_s[j] <= parameters_.standstill_urad_s; };
  const auto none_down = [&](int j) { return c.low_urad_s[j] >= 0 && query.velocity_urad_s[j] >= -parameters_.standstill_urad_s; };
  return none_up(BERM_SWING) && none_down(BERM_SWING) && none_down(BERM_BOOM) && none_up(BERM_STICK) && none_up(BERM_BUCKET);
}

void MotionCheck::note_cell(const sk_height_map& map, const sk_slice& slice, const sk_clearance_result& result, MotionVerdict& verdict) const {
  verdict.has_cell = true;
  verdict.blocked_link = static_cast<std::uint32_t>(slice.link);
  const bool inside = in_map(result.ix) && in_map(result.iy);
  verdict.blocked_x_mm = inside ? cell_centre_mm(result.ix) : 0;
  verdict.blocked_y_mm = inside ? cell_centre_mm(result.iy) : 0;
  verdict.blocked_height_mm = inside && map.seen_us[result.iy][result.ix] >= 0 ? sk_map_top(&map, result.iy, result.ix) : 0;
}

std::uint8_t MotionCheck::clear_one(const sk_height_map& map, SliceSet& slices, std::int32_t index, bool ahead, sk_clearance_result& result, MotionVerdict& verdict) {
  const sk_slice& slice = slices.slice[index];
  const bool tail = slice.link == BERM_SWING;
  rules_.own_body_radius_mm = tail || slice.link == BERM_BOOM ? own_and_rim_radius_mm(parameters_) : 0;  // the map has the columns
  rules_.fresh_us = !tail ? parameters_.fresh_us : ahead ? tail_ahead_fresh_us() : parameters_.tail_fresh_us;
  const sk_columns& columns = !tail ? columns_ : ahead ? tail_ahead_columns_ : tail_columns_;
  // The search may fail or be wrong: what it chose is only a claim, which the core checks.
  result = clear_slice(map, columns, rules_, slices, index, choice_);
  ++verdict.slices;
  verdict.cells += result.cells;
  return result.verdict == SK_CLEAR ? static_cast<std::uint8_t>(BERM_STOP_NONE) : reason_of(result.verdict, slice.link);
}

std::uint8_t MotionCheck::clear(const MotionQuery& query, const sk_height_map& map, const sk_reach_box& box, SliceSet& slices, bool dig_stale,
                                MotionVerdict& verdict) {
  if (!build_slices(shape_, box, slices)) return BERM_STOP_INTERNAL;
  rules_.now_us = query.now_us;
  rules_.dig_stale = dig_stale;
  rules_.dig_allowed = box.speed_urad_s[BERM_SWING] <= parameters_.dig_swing_limit_urad_s;
  for (std::int32_t i = 0; i < slices.count; ++i) {
    sk_clearance_result result;
    const std::uint8_t reason = clear_one(map, slices, i, false, result, verdict);
    if (reason == BERM_STOP_NONE) continue;
    note_cell(map, slices.slice[i], result, verdict);
    return reason;
  }
  return slices.count > 0 ? BERM_STOP_NONE : BERM_STOP_INTERNAL;
}

// The verdict's box is this one; on success its commands are these.
std::uint8_t MotionCheck::judge(const MotionQuery& query, const sk_height_map& map, const Commands& c, SliceSet& slices, bool creeping, MotionVerdict& verdict) {
  sk_reach_box box{};
  const bool bounded = reach(query, c, box);
  verdict.box = box;
  if (!bounded || !joints_within(box, c)) {
    if (!build_slices(shape_, box, slices)) slices.count = 0;  // for observers only
    return BERM_STOP_JOINT_RANGE;
  }
  const std::uint8_t reason = clear(query, map, box, slices, creeping && folds(query, c), verdict);
  if (reason != BERM_STOP_NONE) return reason;
  std::copy(c.send_urad_s, c.send_urad_s + SK_JOINTS, verdict.command_urad_s);
  return BERM_STOP_NONE;
}

// The request is not clear: slowed, then creeping.
bool MotionCheck::slower(const MotionQuery& query, const sk_height_map& map, MotionVerdict& verdict) {
  constexpr std::int32_t shares_percent[] = {50, 25, 0};  // 0: braked, but not stopped
  bool asked = false, slow = true;
  for (int j = 0; j < SK_JOINTS; ++j) {
    asked = asked || query.requested_urad_s[j] != 0;
    slow = slow && std::abs(query.velocity_urad_s[j]) <= parameters_.creep_velocity_urad_s[j];
  }
  MotionVerdict trial = verdict;
  const auto take = [&](Permission permission) {
    trial.permission = permission;
    trial.reason = verdict.reason;
    verdict = trial;
    return true;
  };
  for (const std::int32_t percent : shares_percent) {
    if (!asked || (percent == 0 && slow)) break;
    if (judge(query, map, commands(query, percent, false), other_slices_, false, trial) == BERM_STOP_NONE) return take(Permission::kGoverned);
  }
  trial.has_cell = false;
  const std::uint8_t blocked = slow ? judge(query, map, commands(query, 100, true), other_slices_, true, trial) : verdict.reason;
  if (blocked == BERM_STOP_NONE) return take(Permission::kCreep);
  verdict.slices = trial.slices;
  verdict.cells = trial.cells;
  if (!trial.has_cell) return false;
  // What blocks even the creeping is the nearer cause.
  trial.reason = blocked;
  trial.box = verdict.box;
  verdict = trial;
  return false;
}

std::int64_t MotionCheck::room_ahead(const MotionQuery& query, const sk_height_map& map, std::int64_t wanted_urad, MotionVerdict& verdict) {
  const bool up = query.requested_urad_s[BERM_SWING] > 0;
  const std::int64_t angle = query.angle_urad[BERM_SWING];
  const std::int64_t certified = up ? verdict.box.high_urad[BERM_SWING] : verdict.box.low_urad[BERM_SWING];
  const std::int64_t range = up ? parameters_.joint_high_urad[BERM_SWING] : parameters_.joint_low_urad[BERM_SWING];
  const std::int64_t wanted = up ? std::min(angle + wanted_urad, range) : std::max(angle - wanted_urad, range);
  if (up ? wanted <= certified : wanted >= certified) return std::llabs(wanted - angle);
  const std::int64_t from = std::min(certified, wanted), to = std::max(certified, wanted);
  sk_reach_box ahead = verdict.box;
  ahead.low_urad[BERM_SWING] = static_cast<std::int32_t>(from);
  ahead.high_urad[BERM_SWING] = static_cast<std::int32_t>(to);
  if (!build_slices(shape_, ahead, other_slices_) || !make_tail_ahead_columns(map)) return std::llabs(certified - angle);
  const std::int32_t intervals = other_slices_.intervals, bodies = other_slices_.count / intervals;
  for (std::int32_t near = 0; near < intervals; ++near) {
    for (std::int32_t part = 0; part < bodies; ++part) {
      const std::int32_t interval = up ? near : intervals - 1 - near;
      sk_clearance_result result;
      if (clear_one(map, other_slices_, part * intervals + interval, true, result, verdict) == BERM_STOP_NONE) continue;
      return std::llabs(certified - angle) + (to - from) * near / intervals;
    }
  }
  return std::llabs(wanted - angle);
}

void MotionCheck::govern_swing(const MotionQuery& query, const sk_height_map& map, MotionVerdict& verdict) {
  const std::int32_t requested = verdict.command_urad_s[BERM_SWING];
  const std::int32_t next = sk_brake_row(&parameters_, request_slices_.max_reach_mm + kNearRowMm);
  const std::int32_t row = next >= 0 ? next : BERM_BRAKE_REACHES - 1;  // the box has been bounded
  std::int32_t level = 0;  // that the request needs
  while (level + 1 < SK_GOVERNOR_LEVELS && sk_governor_speed(&parameters_, BERM_SWING, level) < std::abs(requested)) ++level;
  if (level == 0) return;
  const std::int64_t wanted_urad = sk_governor_room(&parameters_, BERM_SWING, row, level);
  const std::int64_t room_urad = wanted_urad < 0 ? 0 : room_ahead(query, map, wanted_urad, verdict);
  const std::int32_t speed = sk_governor_speed(&parameters_, BERM_SWING, sk_governor_level(&parameters_, BERM_SWING, row, room_urad));
  verdict.command_urad_s[BERM_SWING] = sk_governor_clamp(requested, -speed, speed);
}

// Made anew when a truck is admitted or is no longer: seldom, and a bounded time.
bool MotionCheck::limit_overpass(bool truck_admitted) {
  if (limited_ && truck_admitted == truck_admitted_) return true;
  limited_ = sk_pass_limits(&parameters_, truck_admitted, &rules_);
  own_cells_.permit(rules_);
  truck_admitted_ = truck_admitted;
  return limited_;
}

bool MotionCheck::make_columns(const sk_height_map& map) {
  rules_.fresh_us = parameters_.fresh_us;
  if (!sk_columns_of(&map, &rules_, &columns_)) return false;
  if (!shape_.tail.watched) return true;
  rules_.fresh_us = parameters_.tail_fresh_us;
  return sk_columns_of(&map, &rules_, &tail_columns_);
}

std::int32_t MotionCheck::tail_ahead_fresh_us() const { return std::max(parameters_.tail_fresh_us / kTailAheadShare, 1); }

bool MotionCheck::make_tail_ahead_columns(const sk_height_map& map) {
  if (!shape_.tail.watched) return true;
  rules_.fresh_us = tail_ahead_fresh_us();
  return sk_columns_of(&map, &rules_, &tail_ahead_columns_);
}

void MotionCheck::certify(const MotionQuery& query, const sk_height_map& map, MotionVerdict& verdict) {
  verdict.permission = Permission::kFull;
  verdict.reason = judge(query, map, commands(query, 100, false), request_slices_, false, verdict);
  if (verdict.reason == BERM_STOP_NONE) {
    govern_swing(query, map, verdict);
  } else if (!slower(query, map, verdict)) {
    verdict.permission = Permission::kHeld;
  }
}

bool MotionCheck::sweeps_near_lane(const MotionQuery& query) {
  sk_reach_box box{};
  if (!reach(query, commands(query, 100, false), box) || !build_slices(shape_, box, other_slices_)) return true;
  const sk_slice* const first = other_slices_.slice;
  return !std::all_of(first, first + other_slices_.count, [this](const sk_slice& slice) { return sk_away_from_lanes(&parameters_, &slice); });
}

void MotionCheck::cut_to_share(MotionQuery& query, std::int32_t permille) const {
  for (int j = 0; j < SK_JOINTS; ++j) {
    const auto speed = static_cast<std::int32_t>(std::int64_t{parameters_.velocity_max_urad_s[j]} * permille / SK_WHOLE_PERMILLE);
    query.requested_urad_s[j] = sk_governor_clamp(query.requested_urad_s[j], -speed, speed);
  }
}

bool MotionCheck::separate(MotionQuery& query, MotionVerdict& verdict) const {
  if (query.sectors == nullptr) return true;
  sk_reach_box box{};
  const bool bounded = reach(query, commands(query, 100, false), box);
  const std::int32_t reach_mm = bounded ? max_reach_mm(parameters_, box) : SK_COORD_MAX_MM;
  verdict.separation = query.sectors->left(reach_mm, query.now_us);
  verdict.separation_known = true;
  if (!bounded || !query.sectors->enforced()) return true;  // what is not bounded is held, or slowed until it is
  const std::int32_t row = sk_brake_row(&parameters_, reach_mm);
  bool may_move = false;
  for (int j = 0; j < SK_JOINTS; ++j) {
    const std::int32_t level = sk_governor_timed_level(&parameters_, j, row, verdict.separation.stop_us);
    const std::int32_t speed = sk_governor_timed_speed(&parameters_, j, level);
    query.requested_urad_s[j] = std::clamp(query.requested_urad_s[j], -speed, speed);
    may_move = may_move || level > 0;
  }
  return may_move;
}

bool MotionCheck::stands_in_time(const MotionQuery& query, MotionVerdict& verdict) const {
  const std::int32_t reach_mm = max_reach_mm(parameters_, verdict.box);
  const std::int32_t row = reach_mm < 0 ? -1 : sk_brake_row(&parameters_, reach_mm);
  if (row < 0) return false;
  verdict.separation = query.sectors->left(reach_mm, query.now_us);
  for (int j = 0; j < SK_JOINTS; ++j) {
    const std::int32_t sent = verdict.command_urad_s[j];
    const bool asked = std::min(query.under_way_low_urad_s[j], sent) != 0 || std::max(query.under_way_high_urad_s[j], sent) != 0;
    if (!asked && std::abs(query.velocity_urad_s[j]) <= parameters_.standstill_urad_s) continue;
    const std::int64_t time_us = sk_governor_stop_time(&parameters_, j, row, verdict.box.speed_urad_s[j]);
    if (time_us < 0 || time_us > verdict.separation.stop_us) return false;
  }
  return true;
}

void MotionCheck::check(const MotionQuery& query, const sk_height_map& map, MotionVerdict& verdict) {
  verdict = MotionVerdict{};
  request_slices_.count = 0;
  rules_.now_us = query.now_us;
  parameters_.state_latency_us = static_cast<std::int32_t>(std::min<std::int64_t>(state_latency_us_ + query.late_us, INT32_MAX));
  if (!limit_overpass(query.truck_admitted) || !make_columns(map)) {
    verdict.permission = Permission::kHeld;
    verdict.reason = BERM_STOP_INTERNAL;
    return;
  }
  MotionQuery cut = query;
  cut_to_share(cut, query.speed_permille);
  if (query.lane_speed_permille < query.speed_permille && sweeps_near_lane(cut)) cut_to_share(cut, query.lane_speed_permille);
  const bool may_move = separate(cut, verdict);
  certify(cut, map, verdict);
  if (verdict.permission == Permission::kHeld) return;
  if (query.sectors != nullptr && query.sectors->enforced() && !(may_move && stands_in_time(query, verdict))) {
    verdict.permission = Permission::kHeld;
    verdict.reason = BERM_STOP_SEPARATION;
    verdict.has_cell = false;
    return;
  }
  for (int j = 0; j < SK_JOINTS; ++j) {
    const std::int32_t sent = verdict.command_urad_s[j], limit = parameters_.velocity_max_urad_s[j];
    const bool whole = sent == sk_governor_clamp(query.requested_urad_s[j], -limit, limit);
    verdict.permitted_low_urad_s[j] = whole ? -limit : std::min(0, sent);
    verdict.permitted_high_urad_s[j] = whole ? limit : std::max(0, sent);
  }
}

}  // namespace berm::kernel
