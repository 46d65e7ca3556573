#include "run/run_result.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "run/percentile_json.hpp"
#include "run/recognised_truck.hpp"

namespace berm::run {

namespace {

using nlohmann::json;

constexpr double kLoadedShare = 0.95;          // of the target: a truck that counts as loaded
constexpr double kStandstillWithin_s = 6.0;    // 0.5 s of silence, 0.1 s latency and the longest stop of the braking table, 4.4 s, with a second to spare

std::vector<double> pass_seconds(const RunResult& r) {
  std::vector<double> seconds;
  for (const auto& event : r.app_events)
    if (event.value("event", "") == "pass") seconds.push_back(event.value("seconds", 0.0));
  return seconds;
}

std::vector<double> loads(const RunResult& r) { return r.truth.value("truck_load_kg", std::vector<double>{}); }

int trucks_loaded(const RunResult& r) {
  const double target = r.truth.value("target_kg", 0.0);
  const auto kg = loads(r);
  return static_cast<int>(std::count_if(kg.begin(), kg.end(), [target](double load) { return target > 0.0 && load >= kLoadedShare * target; }));
}

// Seconds from the first thing that should stop the machine to its standstill; null when there was none of either.
json standstill_after_fault(const RunResult& r) {
  const auto fault = r.truth.find("fault_s"), still = r.truth.find("first_standstill_after_fault_s");
  if (fault == r.truth.end() || still == r.truth.end() || !fault->is_number() || !still->is_number()) return nullptr;
  return still->get<double>() - fault->get<double>();
}

json maybe(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

std::string place(const StopEvent& stop) {
  if (!stop.has_place) return fmt::format("{:.1f} s", stop.time_s);
  return fmt::format("{:.1f} s at ({:.1f}, {:.1f}) height {:.1f} m", stop.time_s, stop.x_m, stop.y_m, stop.height_m);
}

std::string stops_text(const RunResult& r) {
  if (r.stops.empty()) return "none";
  std::string text;
  for (const auto& [reason, count] : r.stops) {
    text += fmt::format("{}{} {}", text.empty() ? "" : "; ", reason, count);
    std::vector<std::string> where;
    for (const auto& stop : r.stop_events)
      if (stop.reason == reason && where.size() < 3) where.push_back(place(stop));
    text += fmt::format(" ({}{})", fmt::join(where, ", "), count > 3 ? ", ..." : "");
  }
  return text;
}

std::string own_stops_text(const RunResult& r) {
  if (r.measures.own_motion_stops.empty()) return "none";
  std::vector<std::string> each;
  for (const auto& [reason, count] : r.measures.own_motion_stops) each.push_back(fmt::format("{} {}", reason, count));
  return fmt::format("{}", fmt::join(each, "; "));
}

// The app's own holds, each over when it says "released" or the run ends.
struct AppHold { double from_s, seconds; std::string by; };

std::vector<AppHold> app_holds(const RunResult& r) {
  std::vector<AppHold> holds;
  bool open = false;
  const double end_s = r.truth.value("simulated_seconds", 0.0);
  for (const auto& event : r.app_events) {
    const std::string name = event.value("event", "");
    const double time_s = event.value("time_s", 0.0);
    if (name == "held") {
      holds.push_back({time_s, end_s - time_s, held_by(event)});
      open = true;
    } else if (name == "released" && open) {
      const double seconds = event.value("held_s", 0.0);
      holds.back() = {time_s - seconds, seconds, holds.back().by};
      open = false;
    }
  }
  return holds;
}

// What the app says of its time under the kernel's governor: its own count at its exit; of an app that was killed, the spans that it had told of.
struct SlowedTime {
  double seconds = 0.0;
  int spans = 0;
  double least_share = 1.0;
};

SlowedTime slowed_time(const RunResult& r) {
  SlowedTime slowed;
  for (const auto& event : r.app_events) {
    const std::string name = event.value("event", "");
    const double seconds = event.value("slowed_s", 0.0), least = event.value("least_share", 1.0);
    if (name == "exit") return {seconds, event.value("slowed_spans", 0), least};
    if (name == "slowed") ++slowed.spans;
    if (name != "full_speed") continue;
    slowed.seconds += seconds;
    slowed.least_share = std::min(slowed.least_share, least);
  }
  return slowed;
}

std::string slowed_text(const SlowedTime& slowed) {
  if (slowed.spans == 0) return "never";
  return fmt::format("{:.1f} s in {} span{} (least {:.0f} %)", slowed.seconds, slowed.spans, slowed.spans == 1 ? "" : "s", 100 * slowed.least_share);
}

std::string holds_text(const std::vector<AppHold>& holds) {
  if (holds.empty()) return "none of more than 1 s";
  std::vector<std::string> each;
  for (const auto& hold : holds)
    if (each.size() < 5) each.push_back(fmt::format("{:.1f} s from {:.1f} s, {}", hold.seconds, hold.from_s, hold.by));
  return fmt::format("{} ({}{})", holds.size(), fmt::join(each, "; "), holds.size() > each.size() ? "; ..." : "");
}

}  // namespace

std::string held_by(const json& held) {
  const std::string what = held.value("by", "?");
  if (!held.contains("bearing_deg")) return what;
  const std::string place = fmt::format("{} at bearing {:.0f} deg, {:.1f} m", what, held.value("bearing_deg", 0.0), held.value("distance_m", 0.0));
  return held.contains("height_m") ? fmt::format("{}, height {:.1f} m", place, held.value("height_m", 0.0)) : place;
}

std::string operator_needed_for(const json& event) {
  const std::string reason = event.value("reason", "?");
  if (!event.contains("x_m")) return reason;
  return fmt::format("{} for {:.0f} s at ({:.1f}, {:.1f}) height {:.1f} m", reason, event.value("stopped_s", 0.0), event.value("x_m", 0.0), event.value("y_m", 0.0),
                     event.value("height_m", 0.0));
}

std::optional<double> worst_of_trucks_left(const json& truth, const char* key) {
  std::optional<double> worst;
  for (const json& truck : truth.value("trucks_left", json::array())) worst = std::max(worst.value_or(0.0), truck.value(key, 0.0));
  return worst;
}

json flat_json(const RunResult& r) {
  json out;
  out["scenario"] = r.options.scenario;
  out["soil"] = r.options.soil.empty() ? json(nullptr) : json(r.options.soil);
  out["seed"] = r.options.seed;
  out["trucks_loaded"] = trucks_loaded(r);
  const auto passes = pass_seconds(r);
  out["passes"] = passes.size();
  out["pass_seconds"] = passes;
  out["pass_seconds_median"] = percentile_or_null<json>(passes, 0.5);
  out["pass_seconds_p95"] = percentile_or_null<json>(passes, 0.95);
  out["kinematic_ratio_median"] = percentile_or_null<json>(r.measures.kinematic_ratios, 0.5);
  out["dig_surface_error_m"] = maybe(r.measures.dig_surface_error_m);
  out["plan_ms_max"] = maybe(longest_planning_ms(r.app_events));
  out["target_kg"] = r.truth.value("target_kg", 0.0);
  out["payload_kg"] = loads(r);
  out["spill_fraction"] = r.truth.value("spill_fraction", 0.0);
  for (const char* key : {"load_centre_offset_m", "load_height_stddev_m"}) {
    const double last = r.truth.value(key, 0.0);
    out[key] = last;
    out[std::string(key) + "_worst"] = std::max(last, worst_of_trucks_left(r.truth, key).value_or(0.0));
  }
  out["bench_moves"] = r.truth.contains("bench_moves") ? r.truth["bench_moves"].size() : 0;
  out["recognition_error_m"] = recognition_errors(r.app_events, r.truth);
  out["contacts"] = r.contacts;
  out["closest_approach_m"] = r.truth.contains("closest_approach_m") ? r.truth["closest_approach_m"] : json(nullptr);
  out["kernel_stops"] = r.stops;
  out["own_motion_stops"] = r.measures.own_motion_stops;
  std::vector<double> hold_seconds;
  for (const auto& hold : app_holds(r)) hold_seconds.push_back(hold.seconds);
  out["app_hold_seconds"] = hold_seconds;
  const SlowedTime slowed = slowed_time(r);
  out["slowed_seconds"] = slowed.seconds;
  out["slowed_spans"] = slowed.spans;
  out["kernel_faults"] = r.kernel_faults;
  for (const char* name : {"cycle_us_p50", "cycle_us_p99", "cycle_us_max"}) out[name] = r.kernel.contains(name) ? r.kernel[name] : json(nullptr);
  for (const char* key : {"tail_watched", "workspace_watched"}) out[key] = r.kernel.contains(key) ? json(r.kernel[key].get<int>() != 0) : json(nullptr);
  out["simulated_seconds"] = r.truth.value("simulated_seconds", 0.0);
  out["wall_seconds"] = r.wall_seconds;
  out["end_reason"] = r.truth.value("end_reason", "");
  out["standstill_after_fault_s"] = standstill_after_fault(r);
  out["journal_lost"] = r.journal_lost;
  out["pid_plant"] = r.pids[0];
  out["pid_kernel"] = r.pids[1];
  out["pid_app"] = r.pids[2];
  out["pid_journal"] = r.pids[3];
  return out;
}

std::vector<std::string> shortcomings(const RunResult& r) {
  std::vector<std::string> reasons;
  if (r.contacts > 0) reasons.push_back(fmt::format("{} contact(s)", r.contacts));
  if (!r.interrupted.empty()) reasons.push_back(fmt::format("interrupted ({}) after {:.1f} s", r.interrupted, r.truth.value("simulated_seconds", 0.0)));
  if (r.options.fault && !r.fault_struck) {
    // Nothing was shown of it, whatever else went well.
    if (r.interrupted.empty()) reasons.push_back(fmt::format("the run ended before the fault ({:g} s): after {:.1f} s", r.options.fault->at_s, r.truth.value("simulated_seconds", 0.0)));
    return reasons;
  }
  // The journal's end must not be felt, and who goes on has his work to do: such a run is judged as any other.
  const auto fault_is = [&](FaultKind kind) { return r.options.fault->kind == kind; };
  const bool goes_on = r.options.fault && (fault_is(FaultKind::kill_journal) || fault_is(FaultKind::pause_app) || fault_is(FaultKind::pause_kernel));
  if (r.options.fault && !goes_on) {
    const auto standstill = standstill_after_fault(r);
    if (!standstill.is_number()) reasons.emplace_back("the machine did not come to a standstill after the fault");
    else if (standstill.get<double>() > kStandstillWithin_s) reasons.push_back(fmt::format("standstill only {:.2f} s after the fault", standstill.get<double>()));
    return reasons;
  }
  if (trucks_loaded(r) < r.options.trucks) reasons.push_back(fmt::format("{} of {} trucks loaded to {:.0f} % of target", trucks_loaded(r), r.options.trucks, 100 * kLoadedShare));
  if (r.kernel_faults > 0) reasons.push_back(fmt::format("{} kernel fault(s), the first: {}", r.kernel_faults, r.first_fault));
  return reasons;
}

std::string summary_text(const RunResult& r) {
  const auto j = flat_json(r);
  const auto passes = pass_seconds(r);
  const auto kg = loads(r);
  const double target = j["target_kg"].get<double>();
  const std::string soil = r.options.soil.empty() ? "" : ", soil " + r.options.soil;
  std::string text = fmt::format("\nSummary ({}{}, seed {}; a simulation)\n", r.options.scenario, soil, r.options.seed);
  const auto row = [&text](const std::string& name, const std::string& value) { text += fmt::format("  {:<22}{}\n", name, value); };
  std::vector<std::string> trucks;
  for (const double load : kg)
    if (load > 0.0) trucks.push_back(fmt::format("{:.2f} t ({:.1f} %)", load / 1000, target > 0 ? 100 * load / target : 0.0));
  row("trucks loaded", fmt::format("{} of {}", j["trucks_loaded"].get<int>(), r.options.trucks));
  row("payload", trucks.empty() ? "none" : fmt::format("{} of {:.2f} t target", fmt::join(trucks, ", "), target / 1000));
  row("passes", fmt::format("{}", passes.size()));
  if (!passes.empty()) {
    const auto [shortest, longest] = std::minmax_element(passes.begin(), passes.end());
    row("seconds per pass", fmt::format("median {:.1f}, p95 {:.1f}, {:.1f} to {:.1f}", j["pass_seconds_median"].get<double>(), j["pass_seconds_p95"].get<double>(),
                                        *shortest, *longest));
  }
  if (j["kinematic_ratio_median"].is_number())
    row("lift to next dig", fmt::format("median {:.2f} times what the joints' limits allow", j["kinematic_ratio_median"].get<double>()));
  if (j["dig_surface_error_m"].is_number()) row("surface of the digs", fmt::format("{:.1f} cm from the plan on average", 100 * j["dig_surface_error_m"].get<double>()));
  if (j["plan_ms_max"].is_number()) row("longest planning", fmt::format("{:.1f} ms", j["plan_ms_max"].get<double>()));
  row("spill", fmt::format("{:.2f} % of what was dug", 100 * j["spill_fraction"].get<double>()));
  if (!trucks.empty())
    row("load", fmt::format("centre {:.2f} m off the bed's, height standard deviation {:.2f} m{}", j["load_centre_offset_m_worst"].get<double>(),
                            j["load_height_stddev_m_worst"].get<double>(), trucks.size() > 1 ? ", at most" : ""));
  if (const auto errors = recognition_errors(r.app_events, r.truth); !errors.empty())
    row("trucks recognised", fmt::format("{}, the worst corner {:.1f} cm off", errors.size(), 100 * *std::max_element(errors.begin(), errors.end())));
  row("contacts (oracle)", fmt::format("{}", r.contacts));
  if (r.truth.contains("contact_list"))
    for (const auto& contact : r.truth["contact_list"]) row("", contact.is_string() ? contact.get<std::string>() : contact.dump());
  if (j["closest_approach_m"].is_number())
    row("closest approach", fmt::format("{:.2f} m{}", j["closest_approach_m"].get<double>(),
                                        r.truth.contains("closest_approach_what") && r.truth["closest_approach_what"].is_string() ? fmt::format(" ({})", r.truth["closest_approach_what"].get<std::string>()) : ""));
  row("kernel stops", stops_text(r));
  row("by own motion", own_stops_text(r));
  row("slowed by the kernel", slowed_text(slowed_time(r)));
  row("held by the app", holds_text(app_holds(r)));
  if (r.kernel.contains("tail_watched") && r.kernel["tail_watched"] == 0) row("tail", "not watched by the kernel: the ground round it must be fenced");
  if (r.kernel.contains("workspace_watched") && r.kernel["workspace_watched"] == 0) row("workspace", "not watched by the kernel: nobody may come into it");
  row("kernel faults", r.kernel_faults == 0 ? "none" : fmt::format("{} (first: {})", r.kernel_faults, r.first_fault));
  if (j["cycle_us_p50"].is_number())
    row("kernel cycle, CPU", fmt::format("median {} us, p99 {} us, maximum {} us", j["cycle_us_p50"].dump(), j["cycle_us_p99"].dump(), j["cycle_us_max"].dump()));
  row("journal", r.journal_lost == 0 ? "every cycle" : fmt::format("{} cycles LOST", r.journal_lost));
  if (j["standstill_after_fault_s"].is_number()) row("after the fault", fmt::format("standstill in {:.2f} s", j["standstill_after_fault_s"].get<double>()));
  const double simulated = j["simulated_seconds"].get<double>();
  row("time", fmt::format("{:.1f} s simulated in {:.1f} s: {:.1f} times real time", simulated, r.wall_seconds, r.wall_seconds > 0 ? simulated / r.wall_seconds : 0.0));
  row("processes", fmt::format("plant {}, kernel {}, app {}, journal {}", r.pids[0], r.pids[1], r.pids[2], r.pids[3]));
  for (const auto& note : r.notes) row("note", note);
  return text;
}

}  // namespace berm::run
