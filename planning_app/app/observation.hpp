// The kernel's state of one cycle in the app's units, and what the app answers.
#pragma once

#include <array>
#include <cstdint>

#include "contract/berm_contract.h"
#include "motion/implement_weight.hpp"
#include "perception/scan_scheduler.hpp"

namespace berm::app {

struct Observation {
  std::uint64_t cycle = 0;
  std::int64_t time_us = 0;
  double time_s = 0.0;
  Joints angle{}, velocity{};
  std::array<double, 2> pan{};
  double payload_kg = -1.0;     // negative: unknown
  CylinderPressures pressure{};
  std::uint8_t kernel_state = BERM_STATE_INIT;
  std::uint8_t stop_reason = BERM_STOP_NONE;
  bool slowed_by_dust = false;
  bool learns_ground = false;  // everywhere, or a truck's lane: the kernel slows, in the lane only near it
  bool held_by_dust = false;    // so much that nothing may move, whatever reason is published
  std::uint32_t blocked_eyes = 0;  // BERM_SIGHT_BLOCKED bits
  std::uint8_t request_result = BERM_REQUEST_NONE;  // of what the kernel read in this cycle
  bool latched = false;         // stopped until the operator resets
  Joints commanded{};           // what the kernel told the machine in this cycle
  // Speeds permitted now, low <= 0 <= high: where a request was cut what of it went out, else the joint's largest; nothing unless running.
  Joints permitted_low{}, permitted_high{};
  double blocked_bearing = 0.0; // at which the arm points when the blocking link is over the blocking cell, for the ground's stop reasons
  double blocked_x = 0.0, blocked_y = 0.0, blocked_height = 0.0;
  bool truck_parked = false;    // the spotter's: it stands ready ...
  bool truck_leaves = false;    // ... or drives off
  bool run_switch = false;      // the operator's
  bool release_awaited = false; // nothing begins before that switch was off once

  // Whether blocked_x and blocked_y are those of a cell.
  bool has_place() const { return BERM_STOP_HAS_CELL(stop_reason) && (blocked_x != 0.0 || blocked_y != 0.0); }
  bool running() const { return kernel_state == BERM_STATE_RUN; }
};

Observation observe(const berm_state& state);

struct Answer {
  Joints velocity{};
  std::array<PanRequest, 2> pan{};
  std::uint16_t phase = BERM_PHASE_WAIT;
  bool horn = false;
};

// Fills all but guard; every value is cut to what the machine allows, so that the kernel never refuses a request for its range.
berm_request make_request(const MachineModel& machine, const Answer& answer, std::uint32_t sequence, std::int64_t stamp_us);

const char* stop_reason_name(std::uint8_t reason);
const char* request_result_name(std::uint8_t result);

}  // namespace berm::app
