// berm identify: measures a machine's braking table, accelerations and command latency over its bus, or its step responses.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>

#include "config/command_line.hpp"
#include "config/standard_error.hpp"
#include "identify/step_identification.hpp"
#include "run/parameter_file.hpp"

int main(int argc, char** argv) {
  berm::identify::Options options;
  bool steps = false;
  const std::map<std::string, std::size_t> joints{{"swing", 0}, {"boom", 1}, {"stick", 2}, {"bucket", 3}};
  std::vector<std::string> joint_names;
  CLI::App app{
      "Measures the machine's braking table, largest accelerations and command latency: step and stop tests of each joint at each speed and reach, with\n"
      "the heaviest payload and empty, over the machine's CAN frames alone (on the simulated machine, without the kernel). Writes a machine file with\n"
      "the measured bounds, rounded up; everything else in it stays as it is. Takes some minutes.",
      "berm identify"};
  app.add_option("--machine", options.machine,
                 "machine file to start from: a name or a TOML file; its present braking table only guides where tests begin")->capture_default_str();
  app.add_option("--out", options.out, "the new machine file (default: NAME_measured.toml); may be the one to start from");
  app.add_option("--seed", options.seed, "seed of the first repetition; the next ones count up")->capture_default_str();
  app.add_option("--repetitions", options.repetitions, "runs of every test")->capture_default_str()->check(CLI::Range(1, 100));
  app.add_option("--allowance", options.allowance, "added to every measured bound, as a share of it")->capture_default_str()->check(CLI::Range(0.0, 2.0));
  app.add_option("--joint", joint_names,
                 "test this joint alone (may be repeated); the others keep their tables")
      ->check(CLI::IsMember({"swing", "boom", "stick", "bucket"}));
  app.add_option("--columns", options.columns,
                 "speeds to test, in sevenths of the largest; others are covered by the next higher, or extrapolated by the square of the speed")
      ->check(CLI::Range(1, 7));
  app.add_option("--scenario", options.scenario, "site with the heaviest payload: a name or a TOML file")->capture_default_str();
  app.add_option("--scenario-empty", options.scenario_empty, "the same with an empty bucket")->capture_default_str();
  berm::config::output(app.add_option("--json", options.json, "write every entry with what was measured as one JSON object"));
  auto* picture = berm::config::output_or_none(app.add_option("--picture", options.picture, "where the picture goes (SVG; default: braking_table.svg or step_responses.svg); \"\" for none"));
  app.add_option("--plant-out", options.plant_out,
                 "folder in which the simulated machine leaves what was true (trace.csv, truth.json), for others to judge by; not read here");
  app.add_flag("--steps", steps,
               "instead of stops: identify the joint models that the planning app predicts with, from step responses (dead time, lags, gain, rates of each\n"
               "joint and direction, empty and loaded), and write them as [response]")
      ->excludes("--joint", "--columns", "--allowance");
  app.add_flag("--quiet", options.quiet, "no progress, only the table");
  if (const auto status = berm::config::parse_options(app, argc, argv)) return *status;
  if (picture->count() == 0) options.picture = steps ? "step_responses.svg" : "braking_table.svg";
  for (const auto& name : joint_names) options.joints.push_back(joints.at(name));
  for (auto* list : {&options.joints, &options.columns}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  try {
    steps ? berm::identify::identify_steps(options) : berm::identify::identify(options);
    return 0;
  } catch (const berm::run::ToldAlready&) {
    return 2;
  } catch (const std::exception& error) {
    berm::config::print_error("berm identify: {}\n", error.what());
    return 2;
  }
}
