// berm soak: a whole shift.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <memory>

#include "config/command_line.hpp"
#include "config/json_text.hpp"
#include "config/standard_error.hpp"
#include "config/whole_file.hpp"
#include "run/kernel_session.hpp"
#include "run/load_run.hpp"
#include "run/out_folder.hpp"
#include "run/parameter_file.hpp"
#include "soak/drawn_shift.hpp"
#include "soak/shift_report.hpp"

namespace {

constexpr double kProgressEvery_s = 300.0;
constexpr int kSilence_s = 120;               // a computer that is busy otherwise must not end a shift
constexpr int kTraceEvery = 10;  // cycles: 288 000 rows in eight hours

int run(int argc, char** argv) {
  double hours = 8.0, memory_growth_most = berm::soak::kMemoryGrowthMost;
  std::string json, out;
  std::uint64_t seed = 1;
  bool journal = false, picture = false;
  CLI::App app{"A whole shift in lockstep: trucks, people, dust and soil as the seed draws them, and an operator who moves the machine back along the bench\n"
               "and resets it after stops. Ends with a report. Exit status 0: the shift came to its end with no contact, never a quarter of an hour without a pass,\n"
               "and of an hour or more: memory that does not grow faster than --memory-growth.\n"
               "SIGINT or SIGTERM ends it with the report of what ran until then.",
               "berm soak"};
  app.add_option("--hours", hours, "of simulated time")->capture_default_str()->check(CLI::Range(0.01, 10.0));
  app.add_option("--memory-growth", memory_growth_most, "KiB an hour by which the resident memory of kernel and app together may grow; judged of a shift of an hour or more")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 1e6));
  app.add_option("--seed", seed, "seed of every random draw")->capture_default_str();
  berm::config::output(app.add_option("--json", json, "write the report as one flat JSON object"));
  app.add_option("--out", out, "folder for scenario.toml (what was drawn), trace.csv (a row each 0.1 s), truth.json, app.jsonl and result.json; those of an earlier run there are removed first");
  app.add_flag("--picture", picture, "site.svg as well; needs --out");
  app.add_flag("--journal", journal, "the kernel's journal as well; it grows by some 14 gigabytes an hour");
  if (const auto status = berm::config::parse_options(app, argc, argv)) return *status;
  if (picture && out.empty()) {
    berm::config::print_error("berm soak: --picture: needs --out\n");
    return 2;
  }
  auto written = berm::run::run_files(out);
  if (!out.empty()) written.push_back({"--out's scenario.toml", out + "/scenario.toml"});
  written.push_back({"--json", json});
  berm::config::expect_apart(written, {});
  berm::run::RunFolder own;
  const bool kept = !out.empty();
  if (!kept) out = own.file("shift");
  const auto held = std::make_shared<const berm::run::OutFolder>(out);
  const std::string scenario = out + "/scenario.toml";
  if (kept && !berm::soak::may_be_overwritten(scenario))
    throw std::runtime_error(fmt::format("--out: {}: was not drawn by berm soak, and would be overwritten", scenario));
  const berm::soak::DrawnShift drawn = berm::soak::draw_shift(hours, seed);
  berm::config::write_whole_file(scenario, berm::soak::scenario_text(drawn));
  berm::run::RunOptions options;
  options.scenario = scenario;
  options.trucks = berm::soak::trucks_enough(hours);
  options.seed = seed;
  options.out = out;
  options.out_held = held;
  options.quiet = true;
  options.report_when_interrupted = true;
  options.journal = journal;
  options.picture = picture;
  options.silence_s = kSilence_s;
  options.trace_every = kTraceEvery;
  options.progress_every_s = kProgressEvery_s;
  // A scenario that goes with this run's own folder can be run by nobody; the same draw can.
  fmt::print("seed {}, {:.2f} h; run again: {}\n", seed, hours,
             kept ? fmt::format("./berm load --scenario {} --seed {} --trucks {}", scenario, seed, options.trucks) : fmt::format("./berm soak --hours {} --seed {}", hours, seed));
  std::fflush(stdout);
  const auto report = berm::soak::shift_json(berm::run::load_trucks(options), hours, drawn, memory_growth_most);
  fmt::print("{}", berm::soak::shift_text(report));
  if (!json.empty()) berm::config::write_whole_file(json, berm::config::json_text(report, 2));
  const auto reasons = berm::soak::shortcomings(report);
  for (const auto& reason : reasons) berm::config::print_error("berm soak: {}\n", reason);
  return reasons.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const berm::run::ToldAlready&) {
    return 2;
  } catch (const std::exception& error) {
    berm::config::print_error("berm soak: {}\n", error.what());
    return 2;
  }
}
