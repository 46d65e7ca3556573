// Stops of the kernel that nothing but the app's own motion was the cause of, by the truth of the run.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run/recorder.hpp"
#include "run/run_options.hpp"
#include "run/trace_file.hpp"

namespace berm::run {

// When something was wrong with machine, sensors, air, base or processes, or an operator intervened.
struct Disturbance { double from_s, to_s; };

// What the plant says of its scenario (truth.json, "disturbances"), and the process fault that was injected.
std::vector<Disturbance> disturbances_of(const nlohmann::json& truth, const RunOptions& options);

// Of each reason the stops at which in the seconds of memory before there was no disturbance, and no person or vehicle nearer than radius to the
// swing axis or within a metre of the place that the kernel told. memory_s: for so long the kernel takes what it saw for true, kernel.fresh;
// radius_m: of its safety region, workspace.radius.
std::map<std::string, int> own_motion_stops(const std::vector<StopEvent>& stops, const std::vector<Disturbance>& disturbances,
                                            const std::vector<TraceRow>& rows, double radius_m, double memory_s);

}  // namespace berm::run
