#include "validate/commander.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "scan/scan_packet.h"

namespace berm::validate {

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double brake_share = 0.75;   // of the braking table's deceleration
constexpr double arm_share = 0.5;      // of the arm joints' largest speeds
constexpr double landing_gain = 3.0;   // 1/s
constexpr double cycle_s = 0.01;
constexpr double lead_near = 45 * degree, lead_far = 85 * degree;  // pan ahead of the swing
constexpr double azimuth_rate = 45 * degree;  // 1/s, over the ground: 30 scanlines a second then lie less than a cell apart out to 11 m
constexpr double arrived_within = 2.0 * degree, at_rest = 0.8 * degree;

}  // namespace

Commander::Commander(const config::MachineFile& machine, const Trial& trial, double reach_m, bool looks_first)
    : machine_(machine), trial_(trial), swinging_(!looks_first) {
  std::size_t row = 0;
  while (row + 1 < machine.braking.reach.size() && machine.braking.reach[row] < reach_m) ++row;
  for (std::size_t j = 0; j < deceleration_.size(); ++j) {
    const double speed = machine.joint[j].velocity_max;
    const double table = speed * speed / (2.0 * machine.braking.angle[j][row].back());
    deceleration_[j] = brake_share * std::min(table, machine.joint[j].acceleration_max);
  }
}

double Commander::joint_speed(std::size_t j, const berm_state& state) {
  const double measured = state.joint_angle_urad[j] * 1e-6, speed = state.joint_velocity_urad_s[j] * 1e-6;
  const double latency = machine_.command_latency + machine_.state_latency;
  const double left = trial_.to[j] - (measured + speed * latency);
  const double distance = std::fabs(left), switching = deceleration_[j] / (landing_gain * landing_gain);
  const double profile = distance > switching ? std::sqrt(deceleration_[j] * (2.0 * distance - switching)) : landing_gain * distance;
  const double limit = j == 0 ? trial_.swing_speed : arm_share * machine_.joint[j].velocity_max;
  double wanted = std::copysign(std::min(profile, limit), left);
  const double up = machine_.joint[j].acceleration_max * cycle_s;
  // From what the kernel lets out, not from what was asked for: else a speed that was cut would jump when the room is there again.
  const double sent = state.commanded_urad_s[j] * 1e-6;
  const double before = std::fabs(sent) < std::fabs(asked_[j]) ? sent : asked_[j];
  if (std::fabs(wanted) > std::fabs(before)) wanted = std::clamp(wanted, before - up - 0.001, before + up + 0.001);
  return asked_[j] = wanted;
}

void Commander::pans(const berm_state& state, berm_request& request) {
  const double side = trial_.to[0] > trial_.from[0] ? 1.0 : -1.0;
  bool seen = true;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& mount = machine_.scanner[i];
    const double pan = state.pan_angle_urad[i] * 1e-6;
    low_seen_[i] = low_seen_[i] || pan < mount.pan_low + 3.0 * degree;
    high_seen_[i] = high_seen_[i] || pan > mount.pan_high - 3.0 * degree;
    seen = seen && low_seen_[i] && high_seen_[i];
    const bool leads = (side > 0.0) == (i == 0);
    double low = mount.pan_low, high = mount.pan_high;
    if (swinging_) {
      low = std::clamp(leads ? std::min(side * lead_near, side * lead_far) : -45 * degree, mount.pan_low, mount.pan_high);
      high = std::clamp(leads ? std::max(side * lead_near, side * lead_far) : 45 * degree, mount.pan_low, mount.pan_high);
    }
    if (pan > high - 1.5 * degree) up_[i] = false;
    if (pan < low + 1.5 * degree) up_[i] = true;
    request.pan_goal_urad[i] = static_cast<std::int32_t>((up_[i] ? high : low) * 1e6);
    const double rate = azimuth_rate - (up_[i] ? 1.0 : -1.0) * state.joint_velocity_urad_s[0] * 1e-6;
    request.pan_rate_urad_s[i] = static_cast<std::int32_t>(std::clamp(rate, 1.0 * degree, mount.pan_rate_max) * 1e6);
  }
  if (seen && state.kernel_state == BERM_STATE_RUN) swinging_ = true;
}

berm_request Commander::answer(const berm_state& state) {
  berm_request r{};
  r.magic = BERM_CONTRACT_MAGIC;
  r.version = BERM_CONTRACT_VERSION;
  r.phase = BERM_PHASE_SWING_TO_TRUCK;
  r.sequence = ++sequence_;
  r.stamp_us = state.time_us;
  pans(state, r);
  for (std::size_t j = 0; j < 4 && swinging_; ++j) {
    const auto limit = static_cast<std::int32_t>(machine_.joint[j].velocity_max * 1e6);
    r.joint_velocity_urad_s[j] = std::clamp(static_cast<std::int32_t>(joint_speed(j, state) * 1e6), -limit, limit);
  }
  std::uint8_t bytes[offsetof(berm_request, crc32)];
  std::memcpy(bytes, &r, sizeof bytes);
  r.crc32 = berm_crc32(bytes, sizeof bytes);
  return r;
}

bool Commander::arrived(const berm_state& state) const {
  if (!swinging_) return false;
  for (std::size_t j = 0; j < 4; ++j) {
    if (std::fabs(state.joint_angle_urad[j] * 1e-6 - trial_.to[j]) > arrived_within) return false;
    if (std::fabs(state.joint_velocity_urad_s[j] * 1e-6) > at_rest) return false;
  }
  return true;
}

}  // namespace berm::validate
