#include "identify/step_run.hpp"

#include <fmt/format.h>

namespace berm::identify {

namespace {

constexpr double kSevenths = 7.0;
constexpr std::array<double, 3> kSizes{2.0, 4.0, 6.0};  // sevenths of the largest speed: at all of it the gain could not be seen

void test_joint(Driver& driver, const config::MachineFile& machine, const StepRunPlan& plan, std::size_t joint, StepRun& run,
                const std::function<void(const std::string&)>& say) {
  const auto all = step_stations(machine, joint);
  for (std::size_t i = 0; i < all.size(); ++i) {
    driver.take_pose(all[i].pose);
    driver.begin_station(joint, all[i].span);
    for (const double size : kSizes) {
      for (const double direction : {1.0, -1.0}) {
        StepPlan step{joint, joint == swing ? i : 0, plan.loaded, machine.joint[joint].velocity_max * size / kSevenths, direction};
        run.records.push_back(driver.step_test(step, all[i].span));
        run.records.back().seed = plan.place.seed;
      }
    }
    say(fmt::format("seed {}, {}: {} at {:.2f} m: {} step responses", plan.place.seed, plan.loaded ? "loaded" : "empty", config::kJointNames[joint],
                    all[i].reach_m, 2 * kSizes.size()));
  }
}

}  // namespace

std::vector<Station> step_stations(const config::MachineFile& machine, std::size_t joint) {
  const auto all = stations(machine, {joint});
  if (joint != swing) return all;
  std::vector<Station> first;
  for (const Station& station : all)
    if (first.empty() || station.row != first.back().row) first.push_back(station);
  return first;
}

StepRun run_steps(const config::MachineFile& machine, const StepRunPlan& plan, const run::Interruption& interruption,
                  const std::function<void(const std::string&)>& say) {
  StepRun run;
  on_bench(machine, plan.place, interruption, [&](Driver& driver, MachineLink& link) {
    for (const std::size_t joint : {swing, boom, stick, bucket}) test_joint(driver, machine, plan, joint, run, say);
    run.weighed_kg = link.weighed_kg().value_or(0.0);
    run.simulated_s = driver.time_s();
  });
  return run;
}

}  // namespace berm::identify
