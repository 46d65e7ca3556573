// What every identification has in common, whatever it measures: what was asked, its runs on the bench, its files.
#pragma once

#include <array>
#include <functional>
#include <string>

#include "config/machine_file.hpp"
#include "identify/bench_machine.hpp"
#include "identify/identification.hpp"

namespace berm::identify {

struct Measurement {
  std::string machine_path, machine_name, scenario, scenario_empty;
  std::array<std::string, 2> scenario_file;  // empty, loaded
  std::uint64_t seed = 1;
  int repetitions = 1;
  double weighed_kg = 0.0, simulated_s = 0.0;
};

using Say = std::function<void(const std::string&)>;  // a line of progress

// Takes from the options what there is in common; everything that can be refused is, before hours of tests. Throws std::exception with one line.
config::MachineFile begin_measurement(const Options& options, Measurement& m);

// One run's tests, on its place, with the heaviest payload or empty; its mass as weighed (kg) and how long it took (s).
struct RunTaken { double weighed_kg = 0.0, simulated_s = 0.0; };
using Tests = std::function<RunTaken(const BenchPlace& place, bool loaded, const run::Interruption& interruption, const Say& say)>;
// Loaded and empty for each repetition, each of which has the next seed.
void run_all(const Options& options, Measurement& m, const Tests& tests);

struct Findings {
  std::string machine_text, json, summary;
  std::function<void(const std::string& path)> write_picture;
};
// The machine file last: where anything fails there is none.
void write_findings(const Options& options, const Measurement& m, const Findings& findings);

}  // namespace berm::identify
