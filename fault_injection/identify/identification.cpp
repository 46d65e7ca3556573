#include "identify/identification.hpp"

#include <algorithm>

#include "identify/bench_run.hpp"
#include "identify/bounds.hpp"
#include "identify/braking_picture.hpp"
#include "identify/measurement.hpp"
#include "identify/output_files.hpp"
#include "identify/result_text.hpp"

namespace berm::identify {

namespace {

// Every value that will be replaced stands where it can be, and the file can be read with others in their places: known before hours of tests, not after.
void check_editable(Result result, const config::MachineFile& machine) {
  for (const std::size_t j : result.joints) {
    result.bounds.acceleration[j] = machine.joint[j].acceleration_max;
    for (std::size_t row = 0; row < machine.braking.reach.size(); ++row) {
      auto& entries = result.bounds.table[j].emplace_back(machine.braking.angle[j][row].size());
      for (std::size_t k = 0; k < entries.size(); ++k) {
        entries[k].angle = machine.braking.angle[j][row][k];
        entries[k].time = machine.braking.time[j][row][k];
      }
    }
  }
  result.bounds.command_latency = machine.command_latency;
  check_readable(machine_text(result, machine));
}

std::vector<std::size_t> all_or(const std::vector<std::size_t>& chosen, std::size_t first, std::size_t last) {
  if (!chosen.empty()) return chosen;
  std::vector<std::size_t> all;
  for (std::size_t i = first; i <= last; ++i) all.push_back(i);
  return all;
}

}  // namespace

void identify(const Options& options) {
  Result result;
  const config::MachineFile machine = begin_measurement(options, result);
  result.allowance = options.allowance;
  result.joints = all_or(options.joints, 0, 3);
  result.columns = all_or(options.columns, 1, 7);
  check_editable(result, machine);

  std::vector<BenchRecord> runs;
  run_all(options, result, [&](const BenchPlace& place, bool loaded, const run::Interruption& interruption, const Say& say) {
    runs.push_back(run_tests(machine, {place, loaded, result.joints, result.columns}, interruption, say));
    const BenchRecord& run = runs.back();
    result.stops += static_cast<int>(run.stops.size());
    result.largest_state_gap_s = std::max(result.largest_state_gap_s, run.largest_state_gap_s);
    return RunTaken{run.weighed_kg, run.simulated_s};
  });
  result.bounds = bounds_of(machine, runs, result.joints, options.allowance);
  write_findings(options, result, {machine_text(result, machine), json_text(result, machine), summary_text(result, machine),
                                   [&](const std::string& path) { write_braking_picture(path, result, machine, runs); }});
}

}  // namespace berm::identify
