#include "watch/options.hpp"

#include "config/command_line.hpp"
#include "config/standard_error.hpp"

namespace berm::watch {

namespace {

// What does not go together, as one line; empty when all does.
std::string refusal(const Options& o) {
  const int modes = (o.scenario.empty() ? 0 : 1) + (o.intrusions > 0 ? 1 : 0) + (o.quiet_hours > 0.0 ? 1 : 0);
  if (modes != 1) return "give exactly one of --scenario, --intrusions, --quiet-hours";
  if (o.only >= 0 && o.intrusions == 0) return "--only: goes with --intrusions alone";
  if (o.while_learning && o.intrusions == 0) return "--while-learning: goes with --intrusions alone";
  if (const std::string beyond = config::not_below("--only", o.only, "--intrusions", o.intrusions); !beyond.empty()) return beyond;
  if (!o.trace.empty() && o.only < 0) return "--trace: needs --only";
  if (!o.picture.empty() && o.scenario.empty()) return "--picture: goes with --scenario alone";
  if (!o.out.empty() && o.scenario.empty()) return "--out: goes with --scenario alone";
  if (o.max_time_s && o.scenario.empty()) return "--max-time: goes with --scenario alone";
  if (o.trucks != 1 && o.scenario.empty()) return "--trucks: goes with --scenario alone";
  return {};
}

}  // namespace

std::optional<int> read_options(int argc, char** argv, Options& o) {
  CLI::App app{
      "Measures the Workspace Monitor: people and vehicles that enter the safety region must stop the machine. A simulation, judged by the plant's "
      "truth.\n"
      "Exit status 0: nobody was touched, in danger (--intrusions) or undetected, and no alarm was false (--scenario, --quiet-hours); 1: that is not "
      "so; 2: bad input.",
      "berm watch"};
  app.add_option("--scenario", o.scenario,
                 "runs a scenario (a name or a TOML file) with its workspace watched and reports on each person and vehicle in it");
  app.add_option("--intrusions", o.intrusions, "this many drawn intrusions, each a trial of its own")->check(CLI::Range(1, 1000000));
  app.add_option("--quiet-hours", o.quiet_hours, "loads trucks with nobody there for so many simulated hours, and counts the alarms")
      ->check(CLI::Range(0.01, 1000.0));
  app.add_option("--trucks", o.trucks, "with --scenario: trucks to load")->check(CLI::Range(1, 100))->capture_default_str();
  app.add_option("--max-time", o.max_time_s, "with --scenario: the run ends then at the latest, simulated seconds, instead of when the scenario says")
      ->check(CLI::Range(1.0, 36000.0));
  app.add_option("--seed", o.seed, "seed of every draw")->capture_default_str();
  app.add_option("--only", o.only, "with --intrusions: this one trial, in detail")->check(CLI::Range(0, 10000000));
  app.add_flag("--while-learning", o.while_learning, "with --intrusions: somebody appears while the kernel still learns the ground's heights");
  app.add_option("--machine", o.machine, "machine, name or file; its workspace is watched whatever it says (without: the scenario's, or zx200_ring)");
  app.add_flag("--histogram", o.histogram, "the kernel compares with histograms of heights (workspace.histogram), whatever the machine says");
  app.add_option("--jobs", o.jobs, "trials or runs at a time (0: one a core)")->check(CLI::Range(0, 256))->capture_default_str();
  berm::config::output(app.add_option("--json", o.json, "result for scripts"));
  berm::config::output(app.add_option("--picture", o.picture, "with --scenario: SVG of the monitor's maps at the first alarm, or at the end"));
  app.add_option("--out", o.out, "with --scenario: folder for trace.csv, truth.json, journal.mcap, site.svg and result.json; those of an earlier run there are removed first");
  berm::config::output(app.add_option("--trace", o.trace, "with --only: CSV of the trial"));
  if (const auto status = config::parse_options(app, argc, argv)) return status;
  const std::string wrong = refusal(o);
  if (wrong.empty()) return std::nullopt;
  config::print_error("berm watch: {} (see --help)\n", wrong);
  return 2;
}

}  // namespace berm::watch
