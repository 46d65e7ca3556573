#include "identify/bench_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace berm::identify {

namespace {

constexpr double kDegree = 180.0 / std::numbers::pi;
constexpr double kLargestColumn = 7.0;

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
    result.seed = plan.place.seed;
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
  return fmt::format("seed {}, {}: {} at {:.2f} m{}: {} stops, from the command at most {:.2f} deg, {:.2f} s", plan.place.seed, plan.loaded ? "loaded" : "empty",
                     config::kJointNames[station.joint], station.reach_m,
                     station.joint == swing ? fmt::format(" (row to {:g} m)", machine.braking.reach[station.row]) : "",
                     record.stops.size() - begin, angle * kDegree, time);
}

void go_through(Driver& driver, MachineLink& link, const config::MachineFile& machine, const BenchPlan& plan, BenchRecord& record,
                const std::function<void(const std::string&)>& say) {
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

BenchRecord run_tests(const config::MachineFile& machine, const BenchPlan& plan, const run::Interruption& interruption,
                      const std::function<void(const std::string&)>& say) {
  BenchRecord record;
  on_bench(machine, plan.place, interruption,
           [&](Driver& driver, MachineLink& link) { go_through(driver, link, machine, plan, record, say); });
  return record;
}

}  // namespace berm::identify
