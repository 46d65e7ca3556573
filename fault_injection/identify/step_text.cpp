#include "identify/step_text.hpp"

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
constexpr std::array<const char*, 2> kLoadNames{"empty", "loaded"};

double rounded(double x) { return std::round(x * 1e6) / 1e6; }

std::string rates_text(const std::array<std::vector<Fitted>, 2>& rates) {
  std::string text = "[";
  for (std::size_t load = 0; load < rates.size(); ++load) {
    text += load == 0 ? "[" : ", [";
    for (std::size_t i = 0; i < rates[load].size(); ++i) text += fmt::format("{}{:.3f}", i == 0 ? "" : ", ", rates[load][i].value);
    text += "]";
  }
  return text + "]";
}

std::string direction_text(const char* joint, const char* direction, const StepFit& fit) {
  return fmt::format("[response.{}.{}]\ndead_time_s = {:.4f}\nlag_s = {:.3f}\nstop_lag_s = {:.3f}\ngain = {:.4f}\nspeeding_rad_s2 = {}\nslowing_rad_s2 = {}\n",
                     joint, direction, fit.dead_time.value, fit.lag.value, fit.stop_lag.value, fit.gain.value, rates_text(fit.speeding), rates_text(fit.slowing));
}

std::string response_text(const StepResult& r) {
  std::string reaches;
  for (const double reach : r.reach_m) reaches += fmt::format("{}{:.2f}", reaches.empty() ? "" : ", ", reach);
  std::string text = fmt::format("[response]                   # joint models for the app, fitted to step responses; rates empty, then with the heaviest payload\n"
                                 "provenance = {}\npayload_kg = {:.1f}\nreach_m = [{}]\n",
                                 toml_string(step_provenance(r)), r.weighed_kg, reaches);
  for (std::size_t j = 0; j < r.fit.size(); ++j)
    for (std::size_t d = 0; d < 2; ++d) text += direction_text(config::kJointNames[j], config::kDirectionNames[d], r.fit[j][d]);
  return text;
}

Json fitted_json(const Fitted& f) { return {{"value", rounded(f.value)}, {"confidence", rounded(f.confidence)}}; }

Json rates_json(const StepResult& r, const std::array<std::vector<Fitted>, 2>& rates) {
  Json out = Json::array();
  for (std::size_t load = 0; load < rates.size(); ++load) {
    for (std::size_t i = 0; i < rates[load].size(); ++i) {
      Json entry{{"load", kLoadNames[load]}, {"reach_m", rates[load].size() > 1 ? Json(rounded(r.reach_m[i])) : Json(nullptr)}};
      entry.update(fitted_json(rates[load][i]));
      out.push_back(entry);
    }
  }
  return out;
}

std::string rates_summary(const StepResult& r, const char* name, const std::array<std::vector<Fitted>, 2>& rates) {
  std::string text;
  for (std::size_t load = 0; load < rates.size(); ++load) {
    text += fmt::format("      {:<9}{:<8}", name, kLoadNames[load]);
    for (std::size_t i = 0; i < rates[load].size(); ++i) {
      const std::string at = rates[load].size() > 1 ? fmt::format(" at {:.1f} m", r.reach_m[i]) : "";
      text += fmt::format("{}{:.3f} +- {:.3f}{}", i == 0 ? "" : ", ", rates[load][i].value, rates[load][i].confidence, at);
    }
    text += " rad/s2\n";
  }
  return text;
}

}  // namespace

std::size_t StepResult::records() const {
  std::size_t count = 0;
  for (const auto& directions : fit)
    for (const StepFit& f : directions) count += f.records;
  return count;
}

std::string step_provenance(const StepResult& r) {
  return provenance_text(fmt::format("berm identify --steps --machine {} --seed {} --repetitions {}", r.machine_name, r.seed, r.repetitions),
                         fmt::format("{} step responses, {:.0f} kg weighed", r.records(), std::round(r.weighed_kg / 10.0) * 10.0));
}

std::string step_machine_text(const StepResult& r) {
  MachineFileText file(r.machine_path);
  file.replace_tables("response", response_text(r));
  return file.text();
}

std::string step_json_text(const StepResult& r, const config::MachineFile& machine) {
  Json out{{"schema", 1}, {"machine", r.machine_name}, {"scenario", r.scenario}, {"scenario_empty", r.scenario_empty}, {"seed", r.seed},
           {"repetitions", r.repetitions}, {"provenance", step_provenance(r)}, {"step_responses", r.records()}, {"simulated_seconds", rounded(r.simulated_s)},
           {"weighed_kg", std::round(r.weighed_kg)}, {"fits", Json::array()}};
  for (std::size_t j = 0; j < r.fit.size(); ++j) {
    for (std::size_t d = 0; d < 2; ++d) {
      const StepFit& f = r.fit[j][d];
      out["fits"].push_back({{"joint", config::kJointNames[j]}, {"direction", config::kDirectionNames[d]}, {"dead_time_s", fitted_json(f.dead_time)},
                             {"lag_s", fitted_json(f.lag)}, {"stop_lag_s", fitted_json(f.stop_lag)}, {"gain", fitted_json(f.gain)},
                             {"speeding_rad_s2", rates_json(r, f.speeding)}, {"slowing_rad_s2", rates_json(r, f.slowing)},
                             {"residual_deg_s", rounded(f.residual * kDegree)}, {"worst_residual_deg_s", rounded(f.worst_residual * kDegree)},
                             {"promised_rad_s2", rounded(machine.joint[j].acceleration_max)}, {"step_responses", f.records}, {"readings", f.samples}});
    }
  }
  return config::json_text(out, 1);
}

std::string step_summary_text(const StepResult& r, const config::MachineFile& machine) {
  std::string text = fmt::format("\nJoint models of {} (a simulation): fitted +- half of the 95 % interval\n", r.machine_name);
  for (std::size_t j = 0; j < r.fit.size(); ++j) {
    for (std::size_t d = 0; d < 2; ++d) {
      const StepFit& f = r.fit[j][d];
      text += fmt::format("\n  {} {}\n      dead time {:.4f} +- {:.4f} s, lag {:.3f} +- {:.3f} s, to zero {:.3f} +- {:.3f} s, gain {:.4f} +- {:.4f}\n",
                          config::kJointNames[j], j == 0 ? (d == 0 ? "left" : "right") : config::kDirectionNames[d], f.dead_time.value, f.dead_time.confidence,
                          f.lag.value, f.lag.confidence, f.stop_lag.value, f.stop_lag.confidence, f.gain.value, f.gain.confidence);
      text += rates_summary(r, "speeding", f.speeding) + rates_summary(r, "slowing", f.slowing);
      text += fmt::format("      residual {:.3f} deg/s, of the worst of {} step responses {:.3f}; promised {:g} rad/s2 and {:g} s\n", f.residual * kDegree, f.records,
                          f.worst_residual * kDegree, machine.joint[j].acceleration_max, machine.command_latency);
    }
  }
  return text + fmt::format("\n{} step responses in {:.0f} s simulated, {:.0f} kg weighed with the heaviest payload\n", r.records(), r.simulated_s, r.weighed_kg);
}

}  // namespace berm::identify
