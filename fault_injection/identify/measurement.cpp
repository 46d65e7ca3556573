#include "identify/measurement.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "config/output_file.hpp"
#include "config/whole_file.hpp"
#include "identify/output_files.hpp"
#include "run/parameter_file.hpp"
#include "run/scenario_names.hpp"

namespace berm::identify {

namespace {

std::string out_of(const Options& options, const std::string& machine_name) { return options.out.empty() ? machine_name + "_measured.toml" : options.out; }

}  // namespace

config::MachineFile begin_measurement(const Options& options, Measurement& m) {
  m.machine_path = run::find_machine(options.machine);
  config::MachineFile machine = config::load_machine_file(m.machine_path);
  m.machine_name = machine.name;
  m.scenario_file = {run::find_scenario(options.scenario_empty), run::find_scenario(options.scenario)};
  for (const auto& scenario : m.scenario_file) run::scenario_names(scenario);
  m.scenario_empty = std::filesystem::path(m.scenario_file[0]).stem().string();
  m.scenario = std::filesystem::path(m.scenario_file[1]).stem().string();
  m.seed = options.seed;
  m.repetitions = options.repetitions;
  std::vector<config::NamedFile> read{{"--machine", m.machine_path}};
  for (const auto& scenario : m.scenario_file) {
    const auto files = run::files_of_scenario(scenario);
    read.insert(read.end(), files.begin(), files.end());
  }
  const std::vector<config::NamedFile> results{{"--json", options.json}, {"--picture", options.picture}};
  std::vector<config::NamedFile> written{{"--out", out_of(options, m.machine_name)}};
  written.insert(written.end(), results.begin(), results.end());
  config::expect_apart(results, read);
  config::expect_apart(written, {});  // --out may be the file to start from
  for (const auto& file : {out_of(options, m.machine_name), options.json, options.picture}) check_writable(file);
  return machine;
}

void run_all(const Options& options, Measurement& m, const Tests& tests) {
  const run::Interruption interruption;
  const Say say = [&](const std::string& line) {
    if (options.quiet) return;
    fmt::print("{}\n", line);
    std::fflush(stdout);
  };
  for (int i = 0; i < options.repetitions; ++i) {
    for (const bool loaded : {true, false}) {
      BenchPlace place{m.scenario_file[loaded], options.seed + static_cast<std::uint64_t>(i), {}};
      if (!options.plant_out.empty()) place.plant_out = fmt::format("{}/seed{}_{}", options.plant_out, place.seed, loaded ? "loaded" : "empty");
      const RunTaken taken = tests(place, loaded, interruption, say);
      m.simulated_s += taken.simulated_s;
      if (loaded) m.weighed_kg += taken.weighed_kg / options.repetitions;
    }
  }
}

void write_findings(const Options& options, const Measurement& m, const Findings& findings) {
  check_readable(findings.machine_text);
  if (!options.json.empty()) config::write_whole_file(options.json, findings.json);
  if (!options.picture.empty()) findings.write_picture(options.picture);
  const std::string out = out_of(options, m.machine_name);
  config::write_whole_file(out, findings.machine_text);
  fmt::print("{}machine file: {}\n", findings.summary, out);
  if (!options.picture.empty()) fmt::print("picture: {}\n", options.picture);
}

}  // namespace berm::identify
