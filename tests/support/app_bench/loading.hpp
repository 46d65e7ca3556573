// The sequencer at work on the miniature bench, cycle by cycle.
#pragma once

#include <cstdlib>

#include "app/sequencer.hpp"
#include "app_bench/bench_finder.hpp"
#include "app_bench/bench_machine.hpp"
#include "perception/scan_intake.hpp"

namespace berm::app_bench {

struct Loading {
  Loading(int trucks, const app::Joints& start, int log_fd = std::getenv("BERM_TEST_VERBOSE") ? 1 : -1, const app::SiteModel& site = bench())
      : machine(zx200()), plant(machine, start, 7), log(log_fd), scripts(shipped_scripts()), sequencer(machine, site, trucks, scripts, finder, log), intake(machine) {}

  void step() {
    const app::Observation o = app::observe(plant.state());
    intake.take(plant.segment(), sequencer.terrain(), sequencer.bed(), sequencer.sweep());
    if (o.cycle % 25 == 0) sequencer.kernel_map().take(plant.segment());
    last = sequencer.step(o);
    request = app::make_request(machine, last, ++sequence, o.time_us);
    plant.step(request);
    seconds += machine.cycle;
  }
  void go(double for_s) {
    for (const double end = seconds + for_s; seconds < end;) step();
  }

  app::MachineModel machine;
  BenchMachine plant;
  BenchFinder finder;
  app::ProgressLog log;
  app::ScriptSet scripts;
  app::Sequencer sequencer;
  app::ScanIntake intake;
  app::Answer last;
  berm_request request{};
  std::uint32_t sequence = 0;
  double seconds = 0.0;
};

inline app::Joints start_pose() { return {0.0, app::radians(38.0), app::radians(-100.0), app::radians(-100.0)}; }

}  // namespace berm::app_bench
