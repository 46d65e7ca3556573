#include "run/shift_measures.hpp"

#include <algorithm>

#include "config/machine_file.hpp"
#include "run/dig_surface.hpp"
#include "run/kinematic_bound.hpp"
#include "run/own_motion.hpp"
#include "run/trace_file.hpp"

namespace berm::run {

namespace {

constexpr int kBucketLink = 3;
constexpr double kSideWall_m = 0.15;  // of the cut, where soil slides in from beside it; and what the part is wider than the bucket

double cut_half_width(const config::MachineFile& machine) {
  double half = 0.0;
  for (const auto& part : machine.part)
    if (part.link == kBucketLink) half = std::max(half, part.half_width);
  return half - kSideWall_m;
}

}  // namespace

ShiftMeasures measure_shift(const std::string& out, const std::string& machine_file, const RunOptions& options, const nlohmann::json& truth,
                            const std::vector<nlohmann::json>& app_events, const std::vector<StopEvent>& stops) {
  const config::MachineFile machine = config::load_machine_file(machine_file);
  const std::vector<TraceRow> rows = read_trace(out + "/trace.csv");
  JointLimits limits{};
  for (std::size_t j = 0; j < limits.size(); ++j) limits[j] = {machine.joint[j].velocity_max, machine.joint[j].acceleration_max};
  ShiftMeasures measures;
  measures.kinematic_ratios = kinematic_ratios(app_events, rows, limits);
  measures.own_motion_stops = own_motion_stops(stops, disturbances_of(truth, options), rows, machine.workspace.radius, machine.kernel.fresh);
  std::vector<PlannedDig> digs = planned_digs(app_events);
  place_digs(digs, truth);
  measures.dig_surface_error_m = dig_surface_error_m(read_height_field(out + "/terrain_end.csv"), digs, cut_half_width(machine));
  return measures;
}

std::optional<double> longest_planning_ms(const std::vector<nlohmann::json>& app_events) {
  std::optional<double> longest;
  for (const auto& event : app_events) {
    const std::string name = event.value("event", "");
    if (name != "next_dig" && name != "dump") continue;
    const auto plan = event.find("plan_ms");
    if (plan != event.end() && plan->is_number()) longest = std::max(longest.value_or(0.0), plan->get<double>());
  }
  return longest;
}

}  // namespace berm::run
