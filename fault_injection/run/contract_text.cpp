#include "run/contract_text.hpp"

#include <fmt/format.h>

#include <array>

#include "contract/berm_contract.h"

namespace berm::run {

namespace {

template <std::size_t N>
std::string name(const std::array<const char*, N>& names, unsigned code) {
  return code < N ? std::string(names[code]) : fmt::format("code_{}", code);
}

}  // namespace

std::string stop_reason_name(unsigned reason) {
  static constexpr std::array<const char*, BERM_STOP_REASONS> names{
      "none",           "collision_predicted", "unknown_ground", "stale_ground", "dig_floor",   "request_hold", "app_silent", "state_frame",
      "scanner_silent", "operator",            "emergency",      "joint_range",  "braking",     "machine_fault", "internal",  "clock",
      "base_moved",     "uncommanded",         "overpass",       "tail",         "intruder",        "separation",
      "sensor_blocked", "dust"};
  return name(names, reason);
}

std::string kernel_state_name(unsigned state) {
  static constexpr std::array<const char*, BERM_STATE_COUNT> names{"init", "standby", "run", "stopping", "stopped", "fault"};
  return name(names, state);
}

std::string request_result_name(unsigned result) {
  static constexpr std::array<const char*, BERM_REQUEST_RESULTS> names{"accepted", "none", "magic", "version", "crc", "sequence", "age", "range"};
  return name(names, result);
}

std::string phase_name(unsigned phase) {
  static constexpr std::array<const char*, BERM_PHASE_COUNT> names{"idle", "dig", "lift", "swing_to_truck", "dump", "swing_to_dig", "wait"};
  return name(names, phase);
}

std::string cell_status_name(unsigned status) {
  static constexpr std::array<const char*, 4> names{"unknown", "observed", "stale", "own_body"};
  return name(names, status);
}

}  // namespace berm::run
