// The simulated machine on open ground, for as long as tests are driven on it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "identify/driver.hpp"
#include "run/interruption.hpp"

namespace berm::identify {

struct BenchPlace {
  std::string scenario;   // file
  std::uint64_t seed = 1;
  std::string plant_out;  // folder for what the plant writes, not read here; empty: thrown away
};

// Starts the plant, goes through the tests, ends it. Throws std::runtime_error with one line.
void on_bench(const config::MachineFile& machine, const BenchPlace& place, const run::Interruption& interruption,
              const std::function<void(Driver&, MachineLink&)>& tests);

}  // namespace berm::identify
