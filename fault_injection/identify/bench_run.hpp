// One run on the simulated machine: starts the plant with a scenario and a seed, goes through the tests, ends it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "identify/bench_machine.hpp"
#include "identify/programme.hpp"

namespace berm::identify {

struct BenchPlan {
  BenchPlace place;
  bool loaded = true;                // with the heaviest payload: every column, and halfway below it; else the highest column alone, once in a row
  std::vector<std::size_t> joints;
  std::vector<std::size_t> columns;  // 1..7, rising
};

struct ReversalRecord { std::size_t joint = 0; bool loaded = true; int sevenths = 0; Speeds speeds; };

struct BenchRecord {
  std::vector<StopRecord> stops;
  std::vector<ReversalRecord> reversals;
  Joints fastest_reading{};                  // rad/s
  double weighed_kg = 0.0;
  double largest_state_gap_s = 0.0;
  double simulated_s = 0.0;
};

// say: a line of progress. Throws std::runtime_error with one line.
BenchRecord run_tests(const config::MachineFile& machine, const BenchPlan& plan, const run::Interruption& interruption,
                      const std::function<void(const std::string&)>& say);

}  // namespace berm::identify
