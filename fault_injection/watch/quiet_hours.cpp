#include "watch/quiet_hours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <thread>

#include "in_process/workers.hpp"
#include "plant/machine/plant_profile.hpp"
#include "plant/process/scenario.hpp"
#include "run/contract_text.hpp"
#include "run/kernel_session.hpp"
#include "run/load_run.hpp"
#include "run/parameter_file.hpp"
#include "run/trace_reader.hpp"
#include "watch/intrusion.hpp"
#include "watch/journal_walk.hpp"
#include "watch/swept_reach.hpp"
#include "watch/traced_world.hpp"
#include "watch/watched_files.hpp"

namespace berm::watch {

namespace {

using nlohmann::ordered_json;

constexpr const char* scenario_name = "two_trucks";
constexpr int trucks = 2;
constexpr double near_m = 1.0;               // of a cell's middle: what stands there
constexpr double column_radius = 0.15, column_low = -3.0, column_high = 8.0;  // of the cell, for the oracle
constexpr double hour_s = 3600.0, longest_run_s = 1800.0;
constexpr double longest_pause_s = 30.0;      // of a machine at work: a truck leaves and the next comes
constexpr double beyond_alarm_s = 2.0;       // of the run that repeats one

// Of a run: spans in which the kernel said intruder, and the time for which the machine stood for another reason, longer than any exchange of trucks.
void account(const std::string& journal, QuietRun& run) {
  bool said = false;
  double before = 0.0, moved = 0.0;
  walk_decisions(journal, [&](const berm_decision& d) {
    const bool says = d.stop_reason == BERM_STOP_INTRUDER;
    const double t = static_cast<double>(d.time_us) * 1e-6;
    if (says && !said) run.alarms.push_back({run.seed, t, 0.0, d.blocked_x_mm * 1e-3, d.blocked_y_mm * 1e-3, d.blocked_height_mm * 1e-3, {}});
    if (says) run.alarms.back().for_s = t - run.alarms.back().time_s;
    if (std::any_of(std::begin(d.commanded_urad_s), std::end(d.commanded_urad_s), [](std::int32_t v) { return v != 0; })) moved = t;
    if (says) run.held_s += t - before;
    else if (t - moved > longest_pause_s) run.idle_s += t - before;
    said = says;
    before = t;
  });
}

// What is within a metre of the alarm's cell at its time: the truck (its outline from above), else the implements (over or in the cell's column).
std::string what_stands(const QuietAlarm& alarm, const plant::WorldConfig& world, const SweptReach& reach, run::TraceReader& trace) {
  if (!trace.seek(alarm.time_s)) return "unknown";
  std::vector<std::string> found;
  const auto names = trace.movers();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const plant::MoverPose pose = pose_of(trace, names[i]);
    plant::TruckConfig truck = world.trucks[i % world.trucks.size()];
    truck.x = pose.x, truck.y = pose.y, truck.yaw = pose.yaw;
    const double away = distance_from_truck(truck, alarm.x, alarm.y);
    if (away <= near_m) found.push_back(away > 0.0 ? fmt::format("{:.2f} m beside {}", away, names[i]) : names[i]);
  }
  const auto column = plant::oracle::Body::cylinder({alarm.x, alarm.y, column_low}, column_radius, column_high - column_low);
  const double implements_m = reach.distance(joints_of(trace).angle, column);
  if (implements_m <= near_m)
    found.push_back(implements_m > 0.0 ? fmt::format("an implement {:.2f} m beside it", implements_m) : "an implement over it");
  if (found.empty()) return "nothing but ground";
  return found.size() > 1 ? found[0] + ", " + found[1] : found[0];
}

QuietRun one_run(const QuietOptions& options, std::uint64_t seed, double max_time_s) {
  const run::RunFolder folder;
  const WatchedFiles files = write_watched(scenario_name, options.machine, options.histogram, max_time_s, folder.path());
  const plant::Scenario scenario = plant::load_scenario(files.scenario, options.profiles);
  run::RunOptions load;
  load.scenario = files.scenario;
  load.trucks = trucks;
  load.seed = seed;
  load.out = folder.file("run");
  load.quiet = true;
  const run::RunResult done = run::load_trucks(load);
  if (done.journal_lost > 0) throw std::runtime_error(fmt::format("seed {}: the journal lost {} cycles", seed, done.journal_lost));
  QuietRun result;
  result.seed = seed;
  result.seconds = done.truth.value("simulated_seconds", 0.0);
  result.end_reason = done.truth.value("end_reason", "");
  result.contacts = done.contacts;
  result.trucks_loaded = run::flat_json(done).value("trucks_loaded", 0);
  for (const auto& [reason, count] : done.stops) result.other_stops += reason == run::stop_reason_name(BERM_STOP_INTRUDER) ? 0 : count;
  account(load.out + "/journal.mcap", result);
  run::TraceReader trace(load.out + "/trace.csv");
  const SweptReach reach(plant::load_plant_profile(scenario.machine_file).shape);
  for (QuietAlarm& alarm : result.alarms) alarm.what = what_stands(alarm, scenario.world, reach, trace);
  return result;
}

std::string command_of(const QuietResult& result, const QuietAlarm& alarm) {
  const std::string histogram = result.options.histogram ? " --histogram" : "";
  return fmt::format("./berm watch --scenario {} --trucks {} --seed {} --machine {}{} --max-time {:.0f}", scenario_name, trucks, alarm.seed, result.options.machine, histogram,
                     std::ceil(alarm.time_s + beyond_alarm_s));
}

}  // namespace

double QuietResult::seconds() const {
  double sum = 0.0;
  for (const QuietRun& r : runs) sum += r.seconds - r.held_s - r.idle_s;
  return sum;
}

int QuietResult::false_alarms() const {
  int sum = 0;
  for (const QuietRun& r : runs) sum += static_cast<int>(r.alarms.size());
  return sum;
}

int QuietResult::contacts() const {
  int sum = 0;
  for (const QuietRun& r : runs) sum += r.contacts;
  return sum;
}

QuietResult watch_quiet_hours(const QuietOptions& options, const std::function<void(const QuietResult&)>& told) {
  const auto begin = std::chrono::steady_clock::now();
  QuietResult result;
  result.options = options;
  const int jobs = options.jobs > 0 ? options.jobs : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const double wanted_s = options.hours * hour_s, run_s = std::min(longest_run_s, wanted_s);
  // Seed after seed, whatever the number that runs at a time: what a round has beyond the hours is not counted.
  for (std::uint64_t first = options.seed; result.seconds() < wanted_s; first += static_cast<std::uint64_t>(jobs)) {
    std::vector<QuietRun> round(static_cast<std::size_t>(jobs));
    const auto do_one = [&](int i) { round[static_cast<std::size_t>(i)] = one_run(options, first + static_cast<std::uint64_t>(i), run_s); };
    in_process::run_trials(jobs, jobs, do_one, [&](int, int i) {
      const QuietRun& r = round[static_cast<std::size_t>(i)];
      fmt::print("seed {}: {:.0f} s, stood {:.0f} s for long, {} of {} trucks loaded, {} alarm(s), {}\n", r.seed, r.seconds, r.idle_s, r.trucks_loaded,
                 trucks, r.alarms.size(), r.end_reason);
      std::fflush(stdout);
    });
    const double before = result.seconds();
    for (QuietRun& r : round)
      if (result.seconds() < wanted_s) result.runs.push_back(std::move(r));
    if (result.seconds() <= before) throw std::runtime_error("no time passes: the machine stands from the first moment of every run");
    result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (told) told(result);
  }
  return result;
}

ordered_json flat_json(const QuietResult& result) {
  ordered_json runs = ordered_json::array(), alarms = ordered_json::array();
  int other_stops = 0;
  double held_s = 0.0, idle_s = 0.0;
  for (const QuietRun& r : result.runs) {
    other_stops += r.other_stops;
    held_s += r.held_s;
    idle_s += r.idle_s;
    runs.push_back({{"seed", r.seed},
                    {"seconds", r.seconds},
                    {"held_s", r.held_s},
                    {"idle_s", r.idle_s},
                    {"trucks_loaded", r.trucks_loaded},
                    {"false_alarms", r.alarms.size()},
                    {"end_reason", r.end_reason}});
    for (const QuietAlarm& a : r.alarms)
      alarms.push_back({{"seed", a.seed},
                        {"time_s", a.time_s},
                        {"held_s", a.for_s},
                        {"x_m", a.x},
                        {"y_m", a.y},
                        {"height_m", a.height},
                        {"what", a.what},
                        {"command", command_of(result, a)}});
  }
  return {{"hours", result.seconds() / hour_s},
          {"false_alarms", result.false_alarms()},
          {"machine", result.options.machine},
          {"histogram", result.options.histogram},
          {"seed", result.options.seed},
          {"held_s", held_s},
          {"idle_s", idle_s},
          {"contacts", result.contacts()},
          {"other_stops", other_stops},
          {"runs", runs},
          {"alarms", alarms},
          {"wall_seconds", result.wall_seconds}};
}

std::string summary_text(const QuietResult& result) {
  const auto j = flat_json(result);
  std::string text = fmt::format(
      "\nQuiet hours ({}, from seed {}; a simulation with nobody there)\n  hours {:.2f} in {} runs (and {:.0f} s held by alarms, {:.0f} s that it stood for long); "
      "false alarms {}; contacts {}; other stops {}\n",
      scenario_name, result.options.seed, result.seconds() / hour_s, result.runs.size(), j["held_s"].get<double>(), j["idle_s"].get<double>(), result.false_alarms(),
      result.contacts(), j["other_stops"].get<int>());
  for (const QuietRun& r : result.runs)
    for (const QuietAlarm& a : r.alarms)
      text += fmt::format("  FALSE ALARM, seed {}: {:.2f} s, for {:.1f} s, cell ({:.2f}, {:.2f}), height {:.2f} m: {}\n    {}\n", a.seed, a.time_s,
                          a.for_s, a.x, a.y, a.height, a.what, command_of(result, a));
  return text;
}

}  // namespace berm::watch
