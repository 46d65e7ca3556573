#include "watch/scenario_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "plant/machine/plant_profile.hpp"
#include "plant/process/scenario.hpp"
#include "run/contract_text.hpp"
#include "run/kernel_session.hpp"
#include "run/load_run.hpp"
#include "run/recognised_truck.hpp"
#include "run/scenario_names.hpp"
#include "run/trace_reader.hpp"
#include "watch/journal_walk.hpp"
#include "watch/monitor_picture.hpp"
#include "watch/swept_reach.hpp"
#include "watch/traced_world.hpp"
#include "watch/watched_files.hpp"

namespace berm::watch {

namespace {

using nlohmann::ordered_json;

constexpr double long_enough_inside_s = 1.0;

// Follows the run's trace beside its replayed kernel.
class Follower {
 public:
  Follower(const std::string& trace, const plant::ImplementShape& shape, const std::vector<plant::MoverConfig>& movers, MonitorPictureInput* picture)
      : trace_(trace), reach_(shape), movers_(movers), watch_(names_of(movers)), picture_(picture) {}

  void take(const kernel::Cycle& cycle, const kernel::CycleOutputs& out) {
    const berm_state& s = out.state;
    const double t = static_cast<double>(s.time_us) * 1e-6;
    if (!trace_.seek(t)) return;
    const plant::JointState joints = joints_of(trace_);
    presences_.clear();
    for (const auto& mover : movers_) {
      const plant::MoverPose pose = pose_of(trace_, mover.name);
      presences_.push_back({true, footprint_of(mover, pose.x, pose.y, pose.yaw), reach_.distance(joints.angle, body_of(mover, pose))});
    }
    const bool still = std::all_of(joints.velocity.begin(), joints.velocity.end(), [](double v) { return std::fabs(v) < standstill_rad_s; });
    const auto& workspace = cycle.workspace();
    watch_.step({t, s.kernel_state, s.stop_reason, s.blocked_x_mm * 1e-3, s.blocked_y_mm * 1e-3, s.blocked_height_mm * 1e-3, still,
                 monitors_of(workspace), {&workspace.rules(), &workspace.space()}},
                presences_);
    if (picture_ != nullptr && watch_.alarms().size() == 1 && !pictured_) {
      keep_picture(workspace, fmt::format("the first alarm, {:.2f} s", t));
      pictured_ = true;
    }
  }

  void end(const kernel::Cycle& cycle, double t) {
    if (picture_ != nullptr && !pictured_) keep_picture(cycle.workspace(), fmt::format("the end, {:.2f} s, no alarm", t));
  }

  const IntruderWatch& watch() const { return watch_; }

 private:
  static std::vector<std::string> names_of(const std::vector<plant::MoverConfig>& movers) {
    std::vector<std::string> names;
    for (const auto& mover : movers) names.push_back(mover.name);
    return names;
  }

  void keep_picture(const kernel::WorkspaceWatch& workspace, const std::string& moment) {
    picture_->title = moment + " (simulation)";
    picture_->monitor = workspace.monitor();
    if (const sk_monitor_histogram* h = workspace.histogram()) picture_->histogram = std::make_unique<sk_monitor_histogram>(*h);
    picture_->rules = workspace.rules();
    for (const Presence& p : presences_) picture_->now.push_back(p.footprint);
  }

  run::TraceReader trace_;
  SweptReach reach_;
  const std::vector<plant::MoverConfig>& movers_;
  IntruderWatch watch_;
  MonitorPictureInput* picture_;
  std::vector<Presence> presences_;
  bool pictured_ = false;
};

bool undetected(const IntruderRecord& r) { return r.inside_s >= long_enough_inside_s && !r.detected_s && !r.stopped_s; }

ordered_json number(const std::optional<double>& value) { return value ? ordered_json(std::round(*value * 1000.0) / 1000.0) : ordered_json(nullptr); }

}  // namespace

bool ScenarioResult::held() const {
  return contacts == 0 && false_alarms == 0 && std::none_of(intruders.begin(), intruders.end(), undetected);
}

ScenarioResult watch_scenario(const ScenarioOptions& options) {
  const run::RunFolder folder;
  const WatchedFiles files = write_watched(options.scenario, options.machine, options.histogram, options.max_time_s, folder.path());
  const plant::Scenario scenario = plant::load_scenario(files.scenario, options.profiles);
  const plant::PlantProfile profile = plant::load_plant_profile(scenario.machine_file);
  run::RunOptions load;
  load.scenario = files.scenario;
  load.seed = options.seed;
  load.trucks = options.trucks;
  load.out = options.out.empty() ? folder.file("run") : options.out;
  const run::RunResult done = run::load_trucks(load);
  if (done.journal_lost > 0) throw std::runtime_error(fmt::format("the journal lost {} cycles: the kernel cannot be replayed", done.journal_lost));

  const auto picture = options.picture.empty() ? nullptr : std::make_unique<MonitorPictureInput>();
  Follower follower(load.out + "/trace.csv", profile.shape, scenario.world.movers, picture.get());
  ScenarioResult result;
  result.scenario = options.scenario;
  result.seed = options.seed;
  result.contacts = done.contacts;
  walk_replayed(load.out + "/journal.mcap", [&](const kernel::Cycle& cycle, const kernel::CycleOutputs& out) {
    follower.take(cycle, out);
    const double t = static_cast<double>(out.state.time_us) * 1e-6;
    if (t > done.truth.value("simulated_seconds", 0.0) - 0.005) follower.end(cycle, t);
    result.simulated_seconds = t;
  });
  result.intruders = follower.watch().records();
  result.alarms = follower.watch().alarms();
  result.false_alarms = follower.watch().false_alarms();
  if (picture) {
    run::describe_site(files.machine, files.site, picture->site);
    picture->site.truck_bed = run::recognised_bed(done.app_events);
    picture->paths = run::mover_paths(load.out + "/trace.csv");
    std::erase_if(picture->paths, [](const run::MoverPath& path) { return run::is_truck(path.name); });
    picture->alarms = result.alarms;
    write_monitor_picture(options.picture, *picture);
  }
  return result;
}

ordered_json flat_json(const ScenarioResult& result) {
  ordered_json intruders = ordered_json::array(), alarms = ordered_json::array();
  for (const auto& r : result.intruders)
    intruders.push_back({{"name", r.name},
                         {"entered_s", number(r.entered_s)},
                         {"detected_s", number(r.detected_s)},
                         {"detected_by", r.detected_s ? ordered_json(run::stop_reason_name(r.detected_by)) : ordered_json(nullptr)},
                         {"standstill_s", number(r.standstill_s)},
                         {"distance_at_detection_m", number(r.distance_at_detection_m)},
                         {"distance_at_standstill_m", number(r.distance_at_standstill_m)},
                         {"inside_s", number(r.inside_s)},
                         {"undetected", undetected(r)}});
  for (const Alarm& a : result.alarms)
    alarms.push_back({{"time_s", number(a.time_s)},
                      {"x_m", a.x},
                      {"y_m", a.y},
                      {"height_m", a.height},
                      {"nearest", a.nearest.empty() ? ordered_json(nullptr) : ordered_json(a.nearest)}});
  return {{"scenario", result.scenario}, {"seed", result.seed}, {"simulated_seconds", result.simulated_seconds}, {"contacts", result.contacts},
          {"false_alarms", result.false_alarms}, {"intruders", intruders}, {"alarms", alarms}};
}

std::string summary_text(const ScenarioResult& result) {
  std::string text =
      fmt::format("\nWorkspace ({}, seed {}; a simulation, judged by the plant's truth)\n  {:<18}{:>12}{:>12}{:>12}  {:<24}{:>14}{:>16}\n",
                  result.scenario, result.seed, "", "entered", "detected", "stood", "by", "at detection", "at standstill");
  const auto s = [](const std::optional<double>& value, const char* unit) {
    return value ? fmt::format("{:.2f} {}", *value, unit) : std::string("-");
  };
  for (const auto& r : result.intruders)
    text += fmt::format("  {:<18}{:>12}{:>12}{:>12}  {:<24}{:>14}{:>16}{}\n", r.name, s(r.entered_s, "s"), s(r.detected_s, "s"),
                        s(r.standstill_s, "s"), r.detected_s ? run::stop_reason_name(r.detected_by) : "-", s(r.distance_at_detection_m, "m"),
                        s(r.distance_at_standstill_m, "m"), undetected(r) ? "  UNDETECTED" : "");
  if (result.intruders.empty()) text += "  nobody is in this scenario\n";
  text += fmt::format("  contacts (oracle) {}; false alarms {}\n", result.contacts, result.false_alarms);
  for (const Alarm& a : result.alarms)
    text += fmt::format("  alarm at {:.2f} s, cell ({:.2f}, {:.2f}), height {:.2f} m: {}\n", a.time_s, a.x, a.y, a.height,
                        a.nearest.empty() ? "FALSE, nobody near" : a.nearest);
  return text;
}

}  // namespace berm::watch
