#include "identify/identification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "config/whole_file.hpp"
#include "identify/bench_run.hpp"
#include "identify/bounds.hpp"
#include "identify/braking_picture.hpp"
#include "identify/output_files.hpp"
#include "identify/result_text.hpp"
#include "run/parameter_file.hpp"
#include "run/scenario_names.hpp"

namespace berm::identify {

namespace {

namespace fs = std::filesystem;

// Every value that will be replaced stands where it can be: known before hours of tests, not after.
void check_editable(Result result, const config::MachineFile& machine) {
  for (auto& rows : result.bounds.table) rows.assign(machine.braking.reach.size(), std::vector<TableEntry>(8));
  result.bounds.acceleration.fill(1.0);
  result.bounds.command_latency = 0.1;
  machine_text(result, machine);
}

std::vector<std::size_t> all_or(const std::vector<std::size_t>& chosen, std::size_t first, std::size_t last) {
  if (!chosen.empty()) return chosen;
  std::vector<std::size_t> all;
  for (std::size_t i = first; i <= last; ++i) all.push_back(i);
  return all;
}

// Loaded and empty for each repetition, each of which has the next seed.
std::vector<BenchRecord> run_all(const Options& options, Result& result, const config::MachineFile& machine) {
  std::vector<BenchRecord> runs;
  const Interruption interruption;
  const auto say = [&](const std::string& line) {
    if (options.quiet) return;
    fmt::print("{}\n", line);
    std::fflush(stdout);
  };
  double weighed = 0.0;
  for (int i = 0; i < options.repetitions; ++i) {
    for (const bool loaded : {true, false}) {
      BenchPlan plan;
      plan.scenario = loaded ? result.scenario : result.scenario_empty;
      plan.seed = options.seed + static_cast<std::uint64_t>(i);
      plan.loaded = loaded;
      plan.joints = result.joints;
      plan.columns = result.columns;
      if (!options.plant_out.empty()) plan.plant_out = fmt::format("{}/seed{}_{}", options.plant_out, plan.seed, loaded ? "loaded" : "empty");
      runs.push_back(run_tests(machine, plan, interruption, say));
      const BenchRecord& run = runs.back();
      result.stops += static_cast<int>(run.stops.size());
      result.simulated_s += run.simulated_s;
      result.largest_state_gap_s = std::max(result.largest_state_gap_s, run.largest_state_gap_s);
      if (loaded) weighed += run.weighed_kg / options.repetitions;
    }
  }
  result.weighed_kg = weighed;
  return runs;
}

}  // namespace

void identify(const Options& options) {
  Result result;
  result.machine_path = run::find_machine(options.machine);
  const config::MachineFile machine = config::load_machine_file(result.machine_path);
  result.machine_name = machine.name;
  result.scenario = run::find_scenario(options.scenario);
  result.scenario_empty = run::find_scenario(options.scenario_empty);
  for (const auto& scenario : {result.scenario, result.scenario_empty}) run::scenario_names(scenario);
  result.seed = options.seed;
  result.repetitions = options.repetitions;
  result.allowance = options.allowance;
  result.joints = all_or(options.joints, 0, 3);
  result.columns = all_or(options.columns, 1, 7);
  const std::string out = options.out.empty() ? machine.name + "_measured.toml" : options.out;
  for (const auto& file : {out, options.json, options.picture}) check_writable(file);
  check_editable(result, machine);

  const auto runs = run_all(options, result, machine);
  result.bounds = bounds_of(machine, runs, result.joints, options.allowance);
  result.scenario = fs::path(result.scenario).stem().string();
  result.scenario_empty = fs::path(result.scenario_empty).stem().string();
  const std::string text = machine_text(result, machine);
  check_readable(text);
  if (!options.json.empty()) config::write_whole_file(options.json, json_text(result, machine));
  if (!options.picture.empty()) write_braking_picture(options.picture, result, machine, runs);
  config::write_whole_file(out, text);
  fmt::print("{}machine file: {}\n", summary_text(result, machine), out);
  if (!options.picture.empty()) fmt::print("picture: {}\n", options.picture);
}

}  // namespace berm::identify
