#include "identify/bench_run.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "run/child_process.hpp"
#include "run/kernel_session.hpp"
#include "run/parameter_file.hpp"

namespace berm::identify {

namespace {

constexpr double kDegree = 180.0 / std::numbers::pi;
constexpr double kLargestColumn = 7.0;
constexpr double kEndPatience_s = 20.0;

// The plant, which ends with the object.
class Plant {
 public:
  Plant(const BenchPlan& plan, const std::string& can, const std::string& out) {
    run::ChildOptions options;
    options.program = run::program_folder() + "/berm_plant";
    options.arguments = {"--scenario",  plan.scenario, "--seed", std::to_string(plan.seed), "--can", can,
                         "--scan-port", std::to_string(run::free_udp_port()), "--out", out, "--lockstep"};
    child_.start(options);
  }
  // Its lines are read so that it never waits for a reader; true while it runs.
  bool runs() {
    child_.take_lines();
    return !child_.ended();
  }
  void end() {
    child_.signal(SIGTERM);
    if (!child_.wait_ended(kEndPatience_s)) throw std::runtime_error("the plant does not end");
  }
  std::string describe_end() { return child_.describe_end(); }
  // It did not like its input, and has said so.
  bool refused() const { return WIFEXITED(child_.exit_status()) && WEXITSTATUS(child_.exit_status()) != 0; }
  bool wait_ended(double seconds) { return child_.wait_ended(seconds); }

 private:
  run::ChildProcess child_;
};

StopPlan plan_of(const config::MachineFile& machine, const Station& station, std::size_t number, std::size_t column, bool between) {
  StopPlan stop;
  stop.joint = station.joint;
  stop.row = station.row;
  stop.column = column;
  stop.between = between;
  stop.station = number;
  stop.speed = machine.joint[station.joint].velocity_max * (static_cast<double>(column) - (between ? 0.5 : 0.0)) / kLargestColumn;
  return stop;
}

void test_station(Driver& driver, const config::MachineFile& machine, const BenchPlan& plan, const Station& station, std::size_t number, BenchRecord& record) {
  driver.take_pose(station.pose);
  driver.begin_station(station.joint, station.span);
  const auto highest = plan.columns.back();
  const auto test = [&](StopPlan stop, std::size_t manner, double direction) {
    stop.direction = direction;
    stop.manner = static_cast<StopManner>(manner);
    StopRecord result = driver.stop_test(stop, station.span);
    result.seed = plan.seed;
    result.loaded = plan.loaded;
    record.stops.push_back(std::move(result));
  };
  for (const std::size_t column : plan.columns) {
    if (!plan.loaded && column != highest) continue;
    for (std::size_t manner = 0; manner < kManners; ++manner) {
      for (const double direction : {1.0, -1.0}) test(plan_of(machine, station, number, column, false), manner, direction);
      if (plan.loaded) test(plan_of(machine, station, number, column, true), manner, (column + manner) % 2 == 0 ? 1.0 : -1.0);
    }
  }
}

std::string progress(const config::MachineFile& machine, const BenchPlan& plan, const Station& station, const BenchRecord& record, std::size_t begin) {
  double angle = 0.0, time = 0.0;
  for (std::size_t i = begin; i < record.stops.size(); ++i) {
    const StopRecord& s = record.stops[i];
    angle = std::max(angle, s.farthest_angle - angle_at(s, s.sent_s));
    time = std::max(time, s.rest_s - s.sent_s);
  }
  return fmt::format("seed {}, {}: {} at {:.2f} m{}: {} stops, from the command at most {:.2f} deg, {:.2f} s", plan.seed, plan.loaded ? "loaded" : "empty",
                     config::kJointNames[station.joint], station.reach_m,
                     station.joint == swing ? fmt::format(" (row to {:g} m)", machine.braking.reach[station.row]) : "",
                     record.stops.size() - begin, angle * kDegree, time);
}

void go_through(Plant& plant, MachineLink& link, const config::MachineFile& machine, const BenchPlan& plan,
                const Interruption& interruption, BenchRecord& record, const std::function<void(const std::string&)>& say) {
  const auto watch = [&] {
    interruption.check();
    if (!plant.runs()) throw std::runtime_error("the plant ended before the tests: " + plant.describe_end());
  };
  while (!link.heard(100)) watch();
  Driver driver(link, machine, watch);
  std::array<bool, 4> tested{};
  const Station* last = nullptr;
  const auto all = stations(machine, plan.joints);
  for (const Station& station : all) {
    // empty, one pose of each row and joint is enough: it is there for the acceleration, and for a load that helps
    const bool same = last != nullptr && last->joint == station.joint && last->row == station.row;
    if (!plan.loaded && same) continue;
    const std::size_t begin = record.stops.size();
    test_station(driver, machine, plan, station, static_cast<std::size_t>(&station - all.data()), record);
    if (!tested[station.joint]) {
      for (const int sevenths : {4, 7}) {
        const double speed = machine.joint[station.joint].velocity_max * sevenths / kLargestColumn;
        record.reversals.push_back({station.joint, plan.loaded, sevenths, driver.reversal_test(station.joint, speed, station.span)});
      }
    }
    tested[station.joint] = true;
    last = &station;
    say(progress(machine, plan, station, record, begin));
  }
  record.fastest_reading = driver.fastest_reading();
  record.weighed_kg = link.weighed_kg().value_or(0.0);
  record.largest_state_gap_s = link.largest_state_gap_s();
  record.simulated_s = driver.time_s();
}

}  // namespace

BenchRecord run_tests(const config::MachineFile& machine, const BenchPlan& plan, const Interruption& interruption,
                      const std::function<void(const std::string&)>& say) {
  const run::RunFolder folder;
  const std::string can = run::free_can_address();
  BenchRecord record;
  MachineLink link(can);  // before the plant: its first cycle must not be missed
  Plant plant(plan, can, plan.plant_out.empty() ? folder.file("out") : plan.plant_out);
  try {
    go_through(plant, link, machine, plan, interruption, record, say);
  } catch (const std::runtime_error&) {
    interruption.check();  // the plant hears the same signal, and falls silent
    if (plant.wait_ended(0.2) && plant.refused()) throw run::ToldAlready();
    throw;
  }
  plant.end();
  return record;
}

}  // namespace berm::identify
