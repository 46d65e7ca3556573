// What a cycle shows to app and recorders.
#include <algorithm>
#include <cstring>

#include "io/cycle.hpp"

namespace berm::kernel {

std::uint8_t contract_state(std::uint16_t code) {
  switch (code) {
    case SK_STATE_INIT: return BERM_STATE_INIT;
    case SK_STATE_STANDBY: return BERM_STATE_STANDBY;
    case SK_STATE_RUN: return BERM_STATE_RUN;
    case SK_STATE_STOPPING: return BERM_STATE_STOPPING;
    case SK_STATE_STOPPED: return BERM_STATE_STOPPED;
    default: return BERM_STATE_FAULT;
  }
}

std::uint8_t Cycle::published_reason() const {
  // The stop logic keeps the first reason. When that is gone and another keeps the machine, who waits for the first waits for ever.
  if (held()) return last_hold_reason_;
  if (stop_.reason != BERM_STOP_NONE || stop_.code != SK_STATE_STANDBY) return stop_.reason;
  // In STANDBY nothing is stopped, but the app should know why RUN does not begin.
  if (!app_.heard) return BERM_STOP_NONE;
  return settled_ ? hold_reason_ : last_hold_reason_;
}

// The blocking cell of this cycle; of a latched stop that has one, the one that it was latched for.
Cycle::ShownCell Cycle::cell_of(std::uint8_t reason) const {
  ShownCell cell{false, 0, 0, 0, BERM_JOINTS};
  if (reason == BERM_STOP_INTRUDER) {
    cell.has_cell = workspace_.place(cell.x_mm, cell.y_mm, cell.height_mm);
    return cell;
  }
  const MotionVerdict& v = stop_.latched && stop_.reason == BERM_STOP_TAIL ? tail_met_ : verdict_;
  if (v.has_cell) cell = {true, v.blocked_x_mm, v.blocked_y_mm, v.blocked_height_mm, v.blocked_link};
  return cell;
}

// While a held stop, or the start, waits for a reason to stay away the place of that is shown, not none.
Cycle::ShownCell Cycle::shown_cell() const {
  const bool waits = held() || (!settled_ && stop_.code == SK_STATE_STANDBY && app_.heard);
  return waits && hold_reason_ == BERM_STOP_NONE ? last_hold_cell_ : cell_of(published_reason());
}

std::uint32_t Cycle::panel_flags(std::int64_t now_us) const {
  const MachinePicture& picture = frames_.picture();
  std::uint32_t flags = 0;
  if (frames_.operator_fresh(now_us) && picture.panel.run) flags |= BERM_PANEL_OPERATOR_RUN;
  if (frames_.spotter_fresh(now_us) && frames_.truck_parked()) flags |= BERM_PANEL_TRUCK_PARKED;
  if (frames_.spotter_fresh(now_us) && frames_.truck_leaving()) flags |= BERM_PANEL_TRUCK_LEAVING;
  if (stop_.code == SK_STATE_STANDBY && stop_.run_release == SK_RELEASE_AWAITED) flags |= BERM_PANEL_RELEASE_AWAITED;
  return flags;
}

void Cycle::report_state(const CycleInputs& in, berm_state& state) const {
  const MachinePicture& picture = frames_.picture();
  state = berm_state{};
  state.cycle = in.cycle;
  state.time_us = in.now_us;
  for (int j = 0; j < BERM_JOINTS; ++j) {
    state.joint_angle_urad[j] = picture.angle.angle_urad[j];
    state.joint_velocity_urad_s[j] = picture.velocity.velocity_urad_s[j];
    state.commanded_urad_s[j] = sent_urad_s_[j];
    state.permitted_low_urad_s[j] = verdict_.permitted_low_urad_s[j];
    state.permitted_high_urad_s[j] = verdict_.permitted_high_urad_s[j];
    state.reach_low_urad[j] = verdict_.box.low_urad[j];
    state.reach_high_urad[j] = verdict_.box.high_urad[j];
  }
  for (int s = 0; s < BERM_SCANNERS; ++s) state.pan_angle_urad[s] = scans_.pan_urad(s);
  state.payload_kg = picture.payload_kg;
  std::memcpy(state.cylinder_kpa, picture.cylinder_kpa, sizeof state.cylinder_kpa);
  state.request_sequence = request_.sequence;
  state.request_result = static_cast<std::uint8_t>(request_result_);
  state.kernel_state = contract_state(stop_.code);
  state.stop_reason = published_reason();
  state.stop_category = stop_.category;
  const ShownCell blocked = shown_cell();
  if (blocked.has_cell) {
    state.blocked_x_mm = blocked.x_mm;
    state.blocked_y_mm = blocked.y_mm;
    state.blocked_height_mm = blocked.height_mm;
    state.blocked_link = blocked.link;
  }
  std::copy(stop_count_, stop_count_ + BERM_STOP_REASONS, state.stop_count);
  state.cycle_cpu_us = in.cycle_cpu_us;
  state.panel = panel_flags(in.now_us);
  state.journal_lost = in.journal_lost;
  state.unwatched = (parameters_.tail_watched == 0 ? BERM_UNWATCHED_TAIL : 0U) | (workspace_.watched() ? 0U : BERM_UNWATCHED_WORKSPACE);
  state.separation_bearing_deg = state.separation_stop_ms = -1;
  if (verdict_.separation_known) {
    state.separation_bearing_deg = static_cast<std::int16_t>(verdict_.separation.sector * 360 / SK_SECTORS);
    const std::int32_t stop_us = verdict_.separation.stop_us;
    if (stop_us >= 0) state.separation_stop_ms = static_cast<std::int16_t>(std::min(stop_us / 1000, 32767));
  }
  state.dust_permille = sight_.dust_permille();
  state.sight = sight_.blocked_eyes();
  static_assert(SightWatch::kEyes == BERM_SIGHT_EYES);
  if (sight_.dust() == SK_DUST_SLOW) state.sight |= BERM_SIGHT_DUST_SLOW;
  if (sight_.dust() == SK_DUST_STOP) state.sight |= BERM_SIGHT_DUST_STOP;
  if (workspace_.learns()) state.sight |= BERM_SIGHT_LEARNS;
  if (workspace_.learns_lanes()) state.sight |= BERM_SIGHT_LEARNS_LANE;
  const std::int64_t confirmed_us = registration_.confirmed_us();
  state.terrain_confirmed_ms = UINT32_MAX;
  if (confirmed_us >= 0) state.terrain_confirmed_ms = static_cast<std::uint32_t>(std::clamp<std::int64_t>((in.now_us - confirmed_us) / 1000, 0, UINT32_MAX - 1));
}

void Cycle::report_decision(const CycleInputs& in, berm_decision& decision) const {
  const MachinePicture& picture = frames_.picture();
  decision = berm_decision{};
  decision.cycle = in.cycle;
  decision.time_us = in.now_us;
  for (int j = 0; j < BERM_JOINTS; ++j) {
    decision.joint_angle_urad[j] = picture.angle.angle_urad[j];
    decision.joint_velocity_urad_s[j] = picture.velocity.velocity_urad_s[j];
    decision.requested_urad_s[j] = requested_urad_s_[j];
    decision.commanded_urad_s[j] = sent_urad_s_[j];
    decision.permitted_low_urad_s[j] = verdict_.permitted_low_urad_s[j];
    decision.permitted_high_urad_s[j] = verdict_.permitted_high_urad_s[j];
    decision.reach_low_urad[j] = verdict_.box.low_urad[j];
    decision.reach_high_urad[j] = verdict_.box.high_urad[j];
  }
  decision.request_sequence = request_.sequence;
  decision.request_result = static_cast<std::uint8_t>(request_result_);
  decision.kernel_state = contract_state(stop_.code);
  decision.stop_reason = published_reason();
  decision.stop_category = stop_.category;
  decision.phase = request_.phase;
  decision.slices = static_cast<std::uint16_t>(verdict_.slices);
  decision.cells = static_cast<std::uint32_t>(verdict_.cells);
  const ShownCell blocked = shown_cell();
  if (blocked.has_cell) {
    decision.blocked_x_mm = blocked.x_mm;
    decision.blocked_y_mm = blocked.y_mm;
    decision.blocked_height_mm = blocked.height_mm;
  }
  decision.scan_points = map_points_;
}

}  // namespace berm::kernel
