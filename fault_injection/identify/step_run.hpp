// The step responses of one run on the simulated machine.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "identify/bench_machine.hpp"
#include "identify/programme.hpp"

namespace berm::identify {

struct StepRunPlan {
  BenchPlace place;
  bool loaded = true;              // with the heaviest payload
};

struct StepRun {
  std::vector<StepRecord> records;
  double weighed_kg = 0.0, simulated_s = 0.0;
};

// Poses in which a joint is tested. Swing: the first of each reach of the braking table that the implements have; the others: all.
std::vector<Station> step_stations(const config::MachineFile& machine, std::size_t joint);

// say: a line of progress. Throws std::runtime_error with one line.
StepRun run_steps(const config::MachineFile& machine, const StepRunPlan& plan, const run::Interruption& interruption,
                  const std::function<void(const std::string&)>& say);

}  // namespace berm::identify
