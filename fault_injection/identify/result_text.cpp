#include "identify/result_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "config/json_text.hpp"
#include "identify/machine_file_text.hpp"
#include "identify/provenance_text.hpp"

namespace berm::identify {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegree = 180.0 / std::numbers::pi;

// Shortest decimal of a value on a grid.
std::string decimal(double x, int places) {
  std::string s = fmt::format("{:.{}f}", x, places);
  if (s.find('.') == std::string::npos) return s;
  s.erase(s.find_last_not_of('0') + 1);
  if (s.back() == '.') s.pop_back();
  return s;
}

double rounded(double x) { return std::round(x * 1e6) / 1e6; }

template <class Value>
std::string matrix(const std::vector<std::vector<TableEntry>>& rows, Value value) {
  std::string text = "[\n";
  for (const auto& row : rows) {
    text += "    [";
    for (std::size_t k = 0; k < row.size(); ++k) text += (k == 0 ? "" : ", ") + value(row[k]);
    text += "],\n";
  }
  return text + "  ]";
}

std::string joint_names(const Result& r) {
  if (r.joints.size() == 4) return "";
  std::string names;
  for (const std::size_t j : r.joints) names += std::string(" --joint ") + config::kJointNames[j];
  return names;
}

std::string column_names(const Result& r) {
  if (r.columns.size() == 7) return "";
  std::string names = " --columns";
  for (const std::size_t k : r.columns) names += fmt::format(" {}", k);
  return names;
}

bool any_extrapolated(const Result& r) {
  for (const auto& rows : r.bounds.table)
    for (const auto& row : rows)
      for (const TableEntry& e : row)
        if (e.extrapolated) return true;
  return false;
}

}  // namespace

std::string provenance(const Result& r) {
  return provenance_text(fmt::format("berm identify --machine {} --seed {} --repetitions {} --allowance {}{}{}", r.machine_name, r.seed, r.repetitions, decimal(r.allowance, 3),
                                     joint_names(r), column_names(r)),
                         fmt::format("{} stops, {} kg weighed{}", r.stops, decimal(std::round(r.weighed_kg / 10.0) * 10.0, 0), any_extrapolated(r) ? "; in part extrapolated" : ""));
}

std::string machine_text(const Result& r, const config::MachineFile&) {
  MachineFileText file(r.machine_path);
  for (const std::size_t j : r.joints) {
    const std::string name = config::kJointNames[j];
    file.replace("braking." + name, "angle_deg", matrix(r.bounds.table[j], [](const TableEntry& e) { return decimal(e.angle * kDegree, 2); }));
    file.replace("braking." + name, "time_s", matrix(r.bounds.table[j], [](const TableEntry& e) { return decimal(e.time, 3); }));
    if (r.bounds.acceleration[j]) file.replace("joint." + name, "acceleration_max_rad_s2", decimal(*r.bounds.acceleration[j], 2));
  }
  // A latency holds for every joint: where not all were tested, the file's may be the longer one.
  if (r.bounds.command_latency && r.joints.size() == 4) file.replace("latency", "command", fmt::format("{:.2f}", *r.bounds.command_latency));
  file.replace("braking", "provenance", toml_string(provenance(r)));
  return file.text();
}

std::string json_text(const Result& r, const config::MachineFile& machine) {
  Json out;
  out["schema"] = 1;
  out["machine"] = r.machine_name;
  out["scenario"] = r.scenario;
  out["scenario_empty"] = r.scenario_empty;
  out["seed"] = r.seed;
  out["repetitions"] = r.repetitions;
  out["allowance"] = r.allowance;
  out["provenance"] = provenance(r);
  out["stops"] = r.stops;
  out["simulated_seconds"] = rounded(r.simulated_s);
  out["weighed_kg"] = std::round(r.weighed_kg);
  out["state_frame_gap_s"] = rounded(r.largest_state_gap_s);
  out["command_obeyed_after_s"] = rounded(r.bounds.latest_obeyed);
  out["command_latency_s"] = r.bounds.command_latency ? Json(rounded(*r.bounds.command_latency)) : Json(nullptr);
  out["acceleration_window_s"] = rounded(r.bounds.window_s);
  out["joints"] = Json::array();
  for (const std::size_t j : r.joints) {
    Json joint{{"joint", config::kJointNames[j]},
               {"acceleration_measured_rad_s2", rounded(r.bounds.largest_acceleration[j])},
               {"acceleration_bound_rad_s2", rounded(r.bounds.acceleration[j].value_or(0.0))},
               {"acceleration_before_rad_s2", rounded(machine.joint[j].acceleration_max)},
               {"fastest_reading_deg_s", rounded(r.bounds.fastest_reading[j] * kDegree)}};
    for (std::size_t m = 0; m < kManners; ++m) joint[fmt::format("obeyed_after_{}_s", kMannerNames[m])] = rounded(r.bounds.earliest_obeyed[j][m]);
    out["joints"].push_back(joint);
  }
  out["entries"] = Json::array();
  for (const std::size_t j : r.joints) {
    for (std::size_t row = 0; row < r.bounds.table[j].size(); ++row) {
      for (std::size_t k = 1; k < r.bounds.table[j][row].size(); ++k) {
        const TableEntry& e = r.bounds.table[j][row][k];
        const bool seen = e.runs > 0;
        out["entries"].push_back({{"joint", config::kJointNames[j]},
                                  {"reach_m", machine.braking.reach[row]},
                                  {"column", k},
                                  {"speed_deg_s", rounded(machine.joint[j].velocity_max * static_cast<double>(k) / 7.0 * kDegree)},
                                  {"slowest_held_deg_s", seen ? Json(rounded(e.slowest_speed * kDegree)) : Json(nullptr)},
                                  {"measured_deg", seen ? Json(rounded(e.measured_angle * kDegree)) : Json(nullptr)},
                                  {"bound_deg", rounded(e.angle * kDegree)},
                                  {"before_deg", rounded(machine.braking.angle[j][row][k] * kDegree)},
                                  {"measured_s", seen ? Json(rounded(e.measured_time)) : Json(nullptr)},
                                  {"bound_s", rounded(e.time)},
                                  {"before_s", rounded(machine.braking.time[j][row][k])},
                                  {"runs", e.runs},
                                  {"extrapolated", e.extrapolated},
                                  {"between_share", e.between_share > 0.0 ? Json(rounded(e.between_share)) : Json(nullptr)}});
      }
    }
  }
  return config::json_text(out, 1);
}

std::string summary_text(const Result& r, const config::MachineFile& machine) {
  std::string text = fmt::format("\nBraking table of {} (a simulation): stop angle in degrees, measured > bound [before]\n", r.machine_name);
  for (const std::size_t j : r.joints) {
    const bool by_reach = j == swing;
    const auto& rows = r.bounds.table[j];
    for (std::size_t row = by_reach ? 0 : rows.size() - 1; row < rows.size(); ++row) {
      text += by_reach ? fmt::format("\n  swing, reach to {:g} m\n", machine.braking.reach[row]) : fmt::format("\n  {}, every reach\n", config::kJointNames[j]);
      text += "    deg/s     measured      bound     before     measured s    bound s   before s   runs\n";
      for (std::size_t k = 1; k < rows[row].size(); ++k) {
        const TableEntry& e = rows[row][k];
        const std::string angle = e.runs > 0 ? fmt::format("{:.2f}", e.measured_angle * kDegree) : "-";
        const std::string time = e.runs > 0 ? fmt::format("{:.3f}", e.measured_time) : "-";
        text += fmt::format("    {:5.1f} {:>12} {:10.2f} {:10.2f} {:>14} {:10.3f} {:10.3f} {:6}{}\n",
                            machine.joint[j].velocity_max * static_cast<double>(k) / 7.0 * kDegree, angle,
                            e.angle * kDegree,
                            machine.braking.angle[j][row][k] * kDegree, time, e.time,
                            machine.braking.time[j][row][k], e.runs, e.extrapolated ? "  extrapolated" : "");
      }
    }
  }
  for (const std::size_t j : r.joints) {
    double share = 0.0;
    int raised = 0;
    for (const auto& row : r.bounds.table[j]) {
      for (const TableEntry& e : row) {
        share = std::max(share, e.between_share);
        raised += e.between_share > 1.0 ? 1 : 0;
      }
    }
    if (share > 0.0) text += fmt::format("{}Between the columns, {}: at most {:.0f} % of the chord{}\n", j == r.joints.front() ? "\n" : "", config::kJointNames[j], 100.0 * share,
                                         raised > 0 ? fmt::format("; {} entries were raised for it", raised) : "");
  }
  text += fmt::format("\nLargest acceleration (over the kernel's {:.2f} s of state latency, cycle and command latency), rad/s2: measured > bound [before]\n",
                      r.bounds.window_s);
  for (const std::size_t j : r.joints)
    text += fmt::format("  {:<8}{:.2f} > {:.2f} [{:g}]\n", config::kJointNames[j], r.bounds.largest_acceleration[j],
                        r.bounds.acceleration[j].value_or(0.0), machine.joint[j].acceleration_max);
  if (r.bounds.command_latency) {
    text += fmt::format("Command to obeying, age of the state frame included: {:.3f} s > {:.2f} s [{:g}]{}\n", r.bounds.latest_obeyed,
                        *r.bounds.command_latency, machine.command_latency,
                        r.joints.size() == 4 ? "" : "; not all joints were tested, so the file's is kept");
  }
  text += fmt::format("State frames: {:.3f} s apart at most; their own age cannot be seen on one bus, latency.state is kept\n", r.largest_state_gap_s);
  text += fmt::format("{} stops in {:.0f} s simulated, {:.0f} kg weighed with the heaviest payload\n", r.stops, r.simulated_s, r.weighed_kg);
  return text;
}

}  // namespace berm::identify
