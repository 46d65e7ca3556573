// What a run is judged by beside its loads: computed after its end from what plant and app left behind.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "run/recorder.hpp"
#include "run/run_options.hpp"

namespace berm::run {

struct ShiftMeasures {
  std::vector<double> kinematic_ratios;         // kinematic_bound.hpp
  std::map<std::string, int> own_motion_stops;  // own_motion.hpp
  std::optional<double> dig_surface_error_m;    // dig_surface.hpp
};

// out: the plant's folder; machine: the machine file. Throws std::runtime_error with one line.
ShiftMeasures measure_shift(const std::string& out, const std::string& machine, const RunOptions& options, const nlohmann::json& truth,
                            const std::vector<nlohmann::json>& app_events, const std::vector<StopEvent>& stops);

// The longest planning that the app told of: the largest plan_ms of its events next_dig and dump. None when it told of none.
std::optional<double> longest_planning_ms(const std::vector<nlohmann::json>& app_events);

}  // namespace berm::run
