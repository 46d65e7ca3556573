#include "record/decision_json.hpp"


namespace berm::record {

namespace {

template <std::size_t N>
std::string name(const char* const (&names)[N], unsigned code) {
  return code < N ? std::string(names[code]) : "code_" + std::to_string(code);
}

constexpr const char* kReasons[] = {"none",           "collision_predicted", "unknown_ground", "stale_ground", "dig_floor", "request_hold",  "app_silent", "state_frame",
                                    "scanner_silent", "operator",            "emergency",      "joint_range",  "braking",   "machine_fault", "internal",   "clock",
                                    "base_moved", "uncommanded", "overpass", "tail", "intruder", "separation",
                                    "sensor_blocked", "dust"};
static_assert(sizeof kReasons / sizeof kReasons[0] == BERM_STOP_REASONS, "every reason has a name");
constexpr const char* kStates[] = {"init", "standby", "run", "stopping", "stopped", "fault"};
static_assert(sizeof kStates / sizeof kStates[0] == BERM_STATE_COUNT, "every state has a name");
constexpr const char* kResults[] = {"accepted", "none", "magic", "version", "crc", "sequence", "age", "range"};
static_assert(sizeof kResults / sizeof kResults[0] == BERM_REQUEST_RESULTS, "every result has a name");
constexpr const char* kPhases[] = {"idle", "dig", "lift", "swing_to_truck", "dump", "swing_to_dig", "wait"};
static_assert(sizeof kPhases / sizeof kPhases[0] == BERM_PHASE_COUNT, "every phase has a name");

void add(std::string& json, const char* key, const std::string& value) {
  json += json.size() > 1 ? ",\"" : "\"";
  json += key;
  json += "\":" + value;
}
std::string quoted(const std::string& text) { return "\"" + text + "\""; }
template <std::size_t N>
std::string list(const std::int32_t (&values)[N]) {
  std::string text = "[";
  for (std::size_t i = 0; i < N; ++i) text += (i > 0 ? "," : "") + std::to_string(values[i]);
  return text + "]";
}

std::string property(const char* key, const char* type) { return "\"" + std::string(key) + "\":{\"type\":\"" + type + "\"}"; }
std::string array(const char* key) { return "\"" + std::string(key) + "\":{\"type\":\"array\",\"items\":{\"type\":\"integer\"}}"; }

}  // namespace

std::string decision_json(const berm_decision& d) {
  std::string json = "{";
  add(json, "cycle", std::to_string(d.cycle));
  add(json, "time_us", std::to_string(d.time_us));
  add(json, "state", quoted(name(kStates, d.kernel_state)));
  add(json, "reason", quoted(name(kReasons, d.stop_reason)));
  add(json, "category", std::to_string(d.stop_category));
  add(json, "phase", quoted(name(kPhases, d.phase)));
  add(json, "request", quoted(name(kResults, d.request_result)));
  add(json, "request_sequence", std::to_string(d.request_sequence));
  add(json, "angle_urad", list(d.joint_angle_urad));
  add(json, "velocity_urad_s", list(d.joint_velocity_urad_s));
  add(json, "requested_urad_s", list(d.requested_urad_s));
  add(json, "commanded_urad_s", list(d.commanded_urad_s));
  add(json, "permitted_low_urad_s", list(d.permitted_low_urad_s));
  add(json, "permitted_high_urad_s", list(d.permitted_high_urad_s));
  add(json, "reach_low_urad", list(d.reach_low_urad));
  add(json, "reach_high_urad", list(d.reach_high_urad));
  add(json, "slices", std::to_string(d.slices));
  add(json, "cells", std::to_string(d.cells));
  add(json, "blocked_mm", list({d.blocked_x_mm, d.blocked_y_mm, d.blocked_height_mm}));
  add(json, "scan_points", std::to_string(d.scan_points));
  return json + "}";
}

std::string decision_schema() {
  std::string text = R"({"$schema":"https://json-schema.org/draft/2020-12/schema","title":"berm.Decision","type":"object","properties":{)";
  for (const char* key : {"cycle", "time_us", "category", "request_sequence", "slices", "cells", "scan_points"}) text += property(key, "integer") + ",";
  for (const char* key : {"state", "reason", "phase", "request"}) text += property(key, "string") + ",";
  for (const char* key : {"angle_urad", "velocity_urad_s", "requested_urad_s", "commanded_urad_s", "permitted_low_urad_s", "permitted_high_urad_s", "reach_low_urad", "reach_high_urad"}) text += array(key) + ",";
  return text + array("blocked_mm") + "}}";
}

std::string lost_json(std::uint64_t lost, std::uint64_t before_cycle) {
  return "{\"lost\":" + std::to_string(lost) + ",\"before_cycle\":" + std::to_string(before_cycle) + "}";
}

std::string lost_schema() {
  return R"({"$schema":"https://json-schema.org/draft/2020-12/schema","title":"berm.Lost","type":"object","properties":{)" + property("lost", "integer") + "," +
         property("before_cycle", "integer") + "}}";
}

}  // namespace berm::record
