#include "identify/step_identification.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "config/whole_file.hpp"
#include "identify/output_files.hpp"
#include "identify/step_picture.hpp"
#include "run/parameter_file.hpp"
#include "run/scenario_names.hpp"

namespace berm::identify {

namespace {

namespace fs = std::filesystem;

std::vector<StepRun> run_all(const Options& options, StepResult& result, const config::MachineFile& machine) {
  std::vector<StepRun> runs;
  const Interruption interruption;
  const auto say = [&](const std::string& line) {
    if (options.quiet) return;
    fmt::print("{}\n", line);
    std::fflush(stdout);
  };
  for (int i = 0; i < options.repetitions; ++i) {
    for (const bool loaded : {true, false}) {
      StepRunPlan plan;
      plan.place = {loaded ? result.scenario : result.scenario_empty, options.seed + static_cast<std::uint64_t>(i), {}};
      if (!options.plant_out.empty()) plan.place.plant_out = fmt::format("{}/seed{}_{}", options.plant_out, plan.place.seed, loaded ? "loaded" : "empty");
      plan.loaded = loaded;
      plan.joints = {swing, boom, stick, bucket};
      runs.push_back(run_steps(machine, plan, interruption, say));
      result.simulated_s += runs.back().simulated_s;
      if (loaded) result.weighed_kg += runs.back().weighed_kg / options.repetitions;
    }
  }
  return runs;
}

void fit_all(StepResult& result, const config::MachineFile& machine, const std::vector<StepRun>& runs) {
  for (std::size_t j = 0; j < result.fit.size(); ++j) {
    for (std::size_t d = 0; d < 2; ++d) {
      std::vector<const StepRecord*> records;
      for (const StepRun& run : runs)
        for (const StepRecord& record : run.records)
          if (record.plan.joint == j && (record.plan.direction > 0.0) == (d == 0)) records.push_back(&record);
      result.fit[j][d] = fit_steps(records, j == swing ? result.reach_m.size() : 1, machine.joint[j].velocity_max, machine.joint[j].acceleration_max);
    }
  }
}

}  // namespace

void identify_steps(const Options& options) {
  StepResult result;
  result.machine_path = run::find_machine(options.machine);
  const config::MachineFile machine = config::load_machine_file(result.machine_path);
  result.machine_name = machine.name;
  result.scenario = run::find_scenario(options.scenario);
  result.scenario_empty = run::find_scenario(options.scenario_empty);
  for (const auto& scenario : {result.scenario, result.scenario_empty}) run::scenario_names(scenario);
  result.seed = options.seed;
  result.repetitions = options.repetitions;
  const std::string out = options.out.empty() ? machine.name + "_measured.toml" : options.out;
  for (const auto& file : {out, options.json, options.picture}) check_writable(file);
  for (const Station& station : step_stations(machine, swing)) result.reach_m.push_back(station.reach_m);

  const auto runs = run_all(options, result, machine);
  fit_all(result, machine, runs);
  result.scenario = fs::path(result.scenario).stem().string();
  result.scenario_empty = fs::path(result.scenario_empty).stem().string();
  const std::string text = step_machine_text(result);
  check_readable(text);
  if (!options.json.empty()) config::write_whole_file(options.json, step_json_text(result, machine));
  if (!options.picture.empty()) write_step_picture(options.picture, result, machine, runs);
  config::write_whole_file(out, text);
  fmt::print("{}machine file: {}\n", step_summary_text(result, machine), out);
  if (!options.picture.empty()) fmt::print("picture: {}\n", options.picture);
}

}  // namespace berm::identify
