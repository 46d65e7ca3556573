#include "app/observation.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "scan/scan_packet.h"

namespace berm::app {

namespace {

constexpr std::uint8_t category_held = 2;  // merely held: berm_contract.h, stop_category

std::int32_t micro(double value, double low, double high) {
  const double clamped = std::clamp(value, low, high) * 1e6;
  return static_cast<std::int32_t>(std::trunc(clamped));  // toward zero: never beyond a limit
}

}  // namespace

Observation observe(const berm_state& state) {
  Observation o;
  o.cycle = state.cycle;
  o.time_us = state.time_us;
  o.time_s = static_cast<double>(state.time_us) * 1e-6;
  for (std::size_t j = 0; j < joints; ++j) {
    o.angle[j] = state.joint_angle_urad[j] * 1e-6;
    o.velocity[j] = state.joint_velocity_urad_s[j] * 1e-6;
    o.commanded[j] = state.commanded_urad_s[j] * 1e-6;
    if (state.kernel_state != BERM_STATE_RUN) continue;
    o.permitted_low[j] = std::min(state.permitted_low_urad_s[j], 0) * 1e-6;
    o.permitted_high[j] = std::max(state.permitted_high_urad_s[j], 0) * 1e-6;
  }
  for (std::size_t i = 0; i < o.pan.size(); ++i) o.pan[i] = state.pan_angle_urad[i] * 1e-6;
  o.payload_kg = state.payload_kg;
  for (std::size_t c = 0; c < o.pressure.size(); ++c) o.pressure[c] = {static_cast<double>(state.cylinder_kpa[c][0]), static_cast<double>(state.cylinder_kpa[c][1])};
  o.kernel_state = state.kernel_state;
  o.stop_reason = state.stop_reason;
  o.slowed_by_dust = (state.sight & BERM_SIGHT_DUST_SLOW) != 0;
  o.learns_ground = (state.sight & (BERM_SIGHT_LEARNS | BERM_SIGHT_LEARNS_LANE)) != 0;
  o.held_by_dust = (state.sight & BERM_SIGHT_DUST_STOP) != 0;
  o.blocked_eyes = state.sight & (BERM_SIGHT_BLOCKED(BERM_SIGHT_EYES) - 1u);
  o.request_result = state.request_result;
  o.latched = state.kernel_state == BERM_STATE_FAULT || (state.kernel_state == BERM_STATE_STOPPED && state.stop_category != category_held);
  const double behind = state.blocked_link == BERM_SWING ? -1.0 : 1.0;  // the upper body's tail meets it: the arm points the other way
  o.blocked_bearing = std::atan2(behind * state.blocked_y_mm, behind * state.blocked_x_mm);
  o.blocked_x = state.blocked_x_mm * 1e-3;
  o.blocked_y = state.blocked_y_mm * 1e-3;
  o.blocked_height = state.blocked_height_mm * 1e-3;
  o.run_switch = (state.panel & BERM_PANEL_OPERATOR_RUN) != 0;
  o.release_awaited = (state.panel & BERM_PANEL_RELEASE_AWAITED) != 0;
  o.truck_parked = (state.panel & BERM_PANEL_TRUCK_PARKED) != 0;
  o.truck_leaves = (state.panel & BERM_PANEL_TRUCK_LEAVING) != 0;
  return o;
}

berm_request make_request(const MachineModel& machine, const Answer& answer, std::uint32_t sequence, std::int64_t stamp_us) {
  berm_request r{};
  r.magic = BERM_CONTRACT_MAGIC;
  r.version = BERM_CONTRACT_VERSION;
  r.phase = answer.phase;
  r.sequence = sequence;
  r.flags = answer.horn ? BERM_REQUEST_FLAG_HORN : 0u;
  r.stamp_us = stamp_us;
  for (std::size_t j = 0; j < joints; ++j) {
    const double limit = machine.joint[j].velocity_max;
    r.joint_velocity_urad_s[j] = micro(answer.velocity[j], -limit, limit);
  }
  for (std::size_t i = 0; i < answer.pan.size(); ++i) {
    const ScannerMount& mount = machine.scanner[i];
    r.pan_goal_urad[i] = micro(answer.pan[i].goal, mount.pan_low, mount.pan_high);
    r.pan_rate_urad_s[i] = micro(answer.pan[i].rate, 0.0, mount.pan_rate_max);
  }
  std::uint8_t bytes[offsetof(berm_request, crc32)];
  std::memcpy(bytes, &r, sizeof bytes);
  r.crc32 = berm_crc32(bytes, sizeof bytes);
  return r;
}

const char* stop_reason_name(std::uint8_t reason) {
  static constexpr const char* names[BERM_STOP_REASONS] = {"none", "collision predicted", "unknown ground", "stale ground", "dig floor",
                                                           "request hold", "app silent", "state frame", "scanner silent", "operator",
                                                           "emergency", "joint range", "braking", "machine fault", "internal", "clock",
                                                           "base moved", "uncommanded", "overpass", "tail", "intruder",
                                                           "separation", "sensor blocked", "dust"};
  return reason < BERM_STOP_REASONS ? names[reason] : "unnamed";
}

const char* request_result_name(std::uint8_t result) {
  static constexpr const char* names[BERM_REQUEST_RESULTS] = {"accepted", "none", "magic", "version", "crc", "sequence", "age", "range"};
  return result < BERM_REQUEST_RESULTS ? names[result] : "unnamed";
}

}  // namespace berm::app
