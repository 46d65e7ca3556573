#include "in_process/joint_driver.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>

#include "scan/scan_packet.h"

namespace berm::in_process {

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double brake_share = 0.75;   // of the braking table's deceleration
constexpr double arm_share = 0.5;      // of the arm joints' largest speeds
constexpr double landing_gain = 3.0;   // 1/s
constexpr double cycle_s = 0.01;
constexpr double arrived_within = 2.0 * degree, at_rest = 0.8 * degree;

}  // namespace

JointDriver::JointDriver(const config::MachineFile& machine, double reach_m) : machine_(machine) {
  std::size_t row = 0;
  while (row + 1 < machine.braking.reach.size() && machine.braking.reach[row] < reach_m) ++row;
  for (std::size_t j = 0; j < deceleration_.size(); ++j) {
    const double speed = machine.joint[j].velocity_max;
    const double table = speed * speed / (2.0 * machine.braking.angle[j][row].back());
    deceleration_[j] = brake_share * std::min(table, machine.joint[j].acceleration_max);
  }
}

double JointDriver::arm_limit(std::size_t j) const { return arm_share * machine_.joint[j].velocity_max; }

double JointDriver::speed(std::size_t j, double goal, double limit, const berm_state& state) {
  const double measured = state.joint_angle_urad[j] * 1e-6, speed = state.joint_velocity_urad_s[j] * 1e-6;
  const double latency = machine_.command_latency + machine_.state_latency;
  const double left = goal - (measured + speed * latency);
  const double distance = std::fabs(left), switching = deceleration_[j] / (landing_gain * landing_gain);
  const double profile = distance > switching ? std::sqrt(deceleration_[j] * (2.0 * distance - switching)) : landing_gain * distance;
  double wanted = std::copysign(std::min(profile, limit), left);
  const double up = machine_.joint[j].acceleration_max * cycle_s;
  // From what the kernel lets out, not from what was asked for: else a speed that was cut would jump when the room is there again.
  const double sent = state.commanded_urad_s[j] * 1e-6;
  const double before = std::fabs(sent) < std::fabs(asked_[j]) ? sent : asked_[j];
  if (std::fabs(wanted) > std::fabs(before)) wanted = std::clamp(wanted, before - up - 0.001, before + up + 0.001);
  return asked_[j] = wanted;
}

bool JointDriver::arrived(const std::array<double, 4>& goal, const berm_state& state) {
  for (std::size_t j = 0; j < 4; ++j) {
    if (std::fabs(state.joint_angle_urad[j] * 1e-6 - goal[j]) > arrived_within) return false;
    if (std::fabs(state.joint_velocity_urad_s[j] * 1e-6) > at_rest) return false;
  }
  return true;
}

void put_speeds(const std::array<double, 4>& speed, const config::MachineFile& machine, berm_request& request) {
  for (std::size_t j = 0; j < 4; ++j) {
    const auto limit = static_cast<std::int32_t>(machine.joint[j].velocity_max * 1e6);
    request.joint_velocity_urad_s[j] = std::clamp(static_cast<std::int32_t>(speed[j] * 1e6), -limit, limit);
  }
}

void seal(berm_request& request, std::uint32_t sequence, const berm_state& state) {
  request.magic = BERM_CONTRACT_MAGIC;
  request.version = BERM_CONTRACT_VERSION;
  request.sequence = sequence;
  request.stamp_us = state.time_us;
  std::uint8_t bytes[offsetof(berm_request, crc32)];
  std::memcpy(bytes, &request, sizeof bytes);
  request.crc32 = berm_crc32(bytes, sizeof bytes);
}

}  // namespace berm::in_process
