#include "run/run_inputs.hpp"

#include <stdexcept>

#include "run/child_process.hpp"
#include "run/out_folder.hpp"
#include "run/parameter_file.hpp"
#include "run/patience.hpp"
#include "run/scenario_names.hpp"

namespace berm::run {

namespace {

// No result goes over a file that the run reads, or over another.
void keep_apart(const RunOptions& options, const RunInputs& inputs) {
  auto read = files_of_scenario(inputs.scenario), written = run_files(options.out);
  read.push_back({"--soil", inputs.soil});
  std::erase_if(written, [](const auto& file) { return file.name.ends_with("result.json"); });  // --json has the same in it
  written.push_back({"--json", options.json});
  config::expect_apart(written, read);
}

// What is wrong with a scenario the plant says, in one line.
void check_scenario(const RunInputs& inputs, const RunAddresses& addresses, const RunFolder& folder) {
  ChildProcess plant;
  ChildOptions check;
  check.program = program_folder() + "/berm_plant";
  check.arguments = {"--scenario", inputs.scenario, "--can", addresses.can(), "--scan-port", addresses.scan_port.text(), "--out", folder.file("out"), "--check"};
  if (!inputs.soil.empty()) check.arguments.insert(check.arguments.end(), {"--soil", inputs.soil});
  plant.start(check);
  if (!plant.wait_ended(kConnectPatience_s)) throw std::runtime_error("the plant does not end its check of the scenario");
  expect_content(plant);
}

// The same of the app's scripts.
void check_scripts(const std::string& scripts) {
  if (scripts.empty()) return;
  ChildProcess checker;
  ChildOptions check;
  check.program = program_folder() + "/berm_scripts";
  check.arguments = {"--quiet", scripts};
  checker.start(check);
  if (!checker.wait_ended(kConnectPatience_s)) throw std::runtime_error("berm_scripts does not end");
  expect_content(checker);
}

}  // namespace

RunInputs checked_inputs(const RunOptions& options, const RunAddresses& addresses, const RunFolder& folder) {
  RunInputs inputs;
  inputs.scenario = find_scenario(options.scenario);
  const auto names = scenario_names(inputs.scenario);
  inputs.machine = find_machine(names.machine);
  inputs.site = find_site(names.site);
  if (!options.soil.empty()) inputs.soil = find_soil(options.soil);
  keep_apart(options, inputs);
  check_scenario(inputs, addresses, folder);
  check_scripts(options.scripts);
  return inputs;
}

}  // namespace berm::run
