#include "soak/shift_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

namespace berm::soak {

namespace {

using nlohmann::json;

constexpr double kMemoryJudged_h = 1.0;  // before, the slope is that of the buffers which a truck needs and gives back
constexpr double kStuck_s = 900.0;  // without a pass: a truck takes five minutes, the longest wait for one four

json maybe(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

// The longest time between two passes, or from the last to the end.
json longest_standstill(const run::RunResult& r, double seconds) {
  double last = 0.0, longest = 0.0, from = 0.0;
  const auto until = [&](double t) {
    if (t - last > longest) longest = t - last, from = last;
    last = t;
  };
  for (const json& event : r.app_events)
    if (event.value("event", "") == "pass") until(event.value("time_s", 0.0));
  until(seconds);
  return {{"seconds", longest}, {"from_s", from}};
}

bool memory_is_judged(const json& report) { return report["memory_growth_kib_per_hour"].is_number() && report["hours"].get<double>() >= 0.999 * kMemoryJudged_h; }

std::string memory_text(const json& report) {
  const json& growth = report["memory_growth_kib_per_hour"];
  if (!growth.is_number()) return "too short to judge whether kernel and app grow";
  const std::string slope = fmt::format("kernel and app grow by {:.1f} KiB an hour", growth.get<double>());
  return slope + (memory_is_judged(report) ? fmt::format(" (at most {:g})", report["memory_growth_most_kib_per_hour"].get<double>()) : "; too short to judge: under an hour");
}

// As the scenario has them.
json soil_changes(const DrawnShift& drawn) {
  json changes = json::array();
  for (const DrawnSoil& s : drawn.soil)
    changes.push_back({{"at_s", s.at_s}, {"repose_deg", s.repose_deg}, {"bank_slope_deg", s.bank_slope_deg}, {"resistance", s.resistance}, {"stick_fraction", s.stick_fraction}});
  return changes;
}

std::string soil_text(const json& changes, double seconds) {
  std::vector<std::string> each;
  for (const json& c : changes)
    if (c["at_s"].get<double>() <= seconds)
      each.push_back(fmt::format("from {:.0f} s repose {:.1f} deg, {:.1f} % sticks", c["at_s"].get<double>(), c["repose_deg"].get<double>(), 100 * c["stick_fraction"].get<double>()));
  return each.empty() ? "did not change" : fmt::format("{}", fmt::join(each, "; "));
}

// What the app last said of what it waits for.
std::string last_word(const run::RunResult& r) {
  for (auto e = r.app_events.rbegin(); e != r.app_events.rend(); ++e)
    if (e->value("event", "") == "operator_needed" || e->value("event", "") == "face_exhausted") return fmt::format("{}: {}", e->value("reason", e->value("event", "")), e->value("advice", ""));
  return "";
}

}  // namespace

json shift_json(const run::RunResult& r, double hours, const DrawnShift& drawn, double memory_growth_most) {
  json out = run::flat_json(r);
  out["soil"] = soil_changes(drawn);
  const double seconds = out["simulated_seconds"].get<double>();
  const auto left = r.truth.value("trucks_left", json::array());
  std::vector<double> loads;
  for (const json& truck : left) loads.push_back(truck.value("load_kg", 0.0));
  const auto all = out["payload_kg"].get<std::vector<double>>();
  const double tonnes = 1e-3 * std::accumulate(all.begin(), all.end(), 0.0);
  out["payload_kg"] = loads;  // of those that left: most trucks of a run that could take more never came
  out["hours"] = seconds / 3600;
  out["hours_asked"] = hours;
  out["trucks"] = loads.size();
  out["tonnes"] = tonnes;
  out["tonnes_per_hour"] = seconds > 0 ? tonnes * 3600 / seconds : 0.0;
  int needless = 0;
  for (const auto& [reason, count] : r.measures.own_motion_stops) needless += count;
  out["needless_stops"] = needless;
  out["memory_growth_kib_per_hour"] = maybe(r.memory.kib_per_hour);
  out["memory_growth_most_kib_per_hour"] = memory_growth_most;
  out["memory_growth_kernel_kib_per_hour"] = maybe(r.memory.kernel_kib_per_hour);
  out["memory_growth_app_kib_per_hour"] = maybe(r.memory.app_kib_per_hour);
  out["realtime_factor"] = r.wall_seconds > 0 ? seconds / r.wall_seconds : 0.0;
  const json still = longest_standstill(r, seconds);
  out["longest_without_pass_s"] = still["seconds"];
  out["longest_without_pass_from_s"] = still["from_s"];
  out["stuck"] = still["seconds"].get<double>() > kStuck_s;
  out["last_operator_message"] = last_word(r);
  out["closest_approach_what"] = r.truth.value("closest_approach_what", "");
  out["operator_presses"] = r.truth.contains("operator_presses") ? r.truth["operator_presses"].size() : 0;
  out["hand_lifts"] = r.truth.contains("hand_lifts") ? r.truth["hand_lifts"].size() : 0;
  // Not of the truck that was being loaded when the shift ended.
  for (const char* key : {"load_height_stddev_m", "load_centre_offset_m"}) out[std::string(key) + "_worst"] = maybe(run::worst_of_trucks_left(r.truth, key));
  return out;
}

std::string shift_text(const json& j) {
  std::string text = fmt::format("\nReport of the shift (seed {}; a simulation)\n", j["seed"].dump());
  const auto row = [&text](const std::string& name, const std::string& value) { text += fmt::format("  {:<22}{}\n", name, value); };
  const auto number = [&j](const char* key, int digits) { return j[key].is_number() ? fmt::format("{:.{}f}", j[key].get<double>(), digits) : std::string("none"); };
  row("time", fmt::format("{} h of {} h, {} times real time; end: {}", number("hours", 2), number("hours_asked", 2), number("realtime_factor", 1), j["end_reason"].get<std::string>()));
  row("trucks", fmt::format("{} left, {} of them loaded to 95 % or more; {} bench moves", j["trucks"].dump(), j["trucks_loaded"].dump(), j["bench_moves"].dump()));
  row("tonnes", fmt::format("{}, {} an hour", number("tonnes", 1), number("tonnes_per_hour", 1)));
  row("passes", fmt::format("{}, seconds median {}, p95 {}", j["passes"].dump(), number("pass_seconds_median", 1), number("pass_seconds_p95", 1)));
  row("kernel stops", j["kernel_stops"].dump());
  row("needless stops", fmt::format("{} {}", j["needless_stops"].dump(), j["own_motion_stops"].dump()));
  row("operator's presses", fmt::format("{}; lifted the implements by hand: {}", j["operator_presses"].dump(), j["hand_lifts"].dump()));
  row("contacts (oracle)", j["contacts"].dump());
  row("closest approach", fmt::format("{} m {}", number("closest_approach_m", 2), j["closest_approach_what"].get<std::string>()));
  row("spill", fmt::format("{:.2f} % of what was dug", 100 * j["spill_fraction"].get<double>()));
  row("soil", soil_text(j["soil"], j["simulated_seconds"].get<double>()));
  row("worst load", fmt::format("centre {} m off, height standard deviation {} m", number("load_centre_offset_m_worst", 2), number("load_height_stddev_m_worst", 2)));
  row("memory", memory_text(j));
  row("longest without pass", fmt::format("{} s from {} s{}", number("longest_without_pass_s", 0), number("longest_without_pass_from_s", 0), j["stuck"].get<bool>() ? ": STUCK; " + j["last_operator_message"].get<std::string>() : ""));
  return text;
}

std::vector<std::string> shortcomings(const json& j) {
  std::vector<std::string> reasons;
  if (j["contacts"].get<int>() > 0) reasons.push_back(fmt::format("{} contact(s)", j["contacts"].dump()));
  if (j["hours"].get<double>() < 0.999 * j["hours_asked"].get<double>()) reasons.push_back(fmt::format("the shift ended early: {}", j["end_reason"].get<std::string>()));
  if (memory_is_judged(j) && j["memory_growth_kib_per_hour"].get<double>() > j["memory_growth_most_kib_per_hour"].get<double>())
    reasons.push_back(fmt::format("kernel and app grow by {:.1f} KiB an hour", j["memory_growth_kib_per_hour"].get<double>()));
  if (j["stuck"].get<bool>()) reasons.push_back(fmt::format("no pass for {:.0f} s", j["longest_without_pass_s"].get<double>()));
  return reasons;
}

}  // namespace berm::soak
