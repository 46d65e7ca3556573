// ./berm validate: the validation sweep of leger-1998 section 2.5, whole instead of partitioned.
#include <fmt/format.h>
#include <string.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "config/command_line.hpp"
#include "config/compile_parameters.hpp"
#include "config/json_text.hpp"
#include "config/standard_error.hpp"
#include "config/strict_table.hpp"
#include "config/whole_file.hpp"
#include "in_process/workers.hpp"
#include "run/interruption.hpp"
#include "run/parameter_file.hpp"
#include "validate/report.hpp"
#include "validate/trial_run.hpp"

namespace berm::validate {
namespace {

constexpr double loaded_kg = 1800.0;  // the heaviest that the machine file's prisms and braking table are made for

struct Options {
  int runs = 200, only = -1, jobs = 0;
  std::uint64_t seed = 1;
  std::string machine = "zx200", json, picture, trace;
};

Bench make_bench(const std::string& machine) {
  Bench bench;
  bench.machine = config::load_machine_file(run::find_machine(machine));
  config::SiteFile site = config::load_site_file(run::find_site("bench"));
  site.dig_zone.clear();
  site.pass_over = 20.0;  // no overpass rule: the boxes may be passed over, with the margin, and the oracle says how near that comes
  site.ground_zone.clear();
  bench.parameters = config::compile_parameters(bench.machine, site);
  bench.profile = plant::load_plant_profile(BERM_PLANT_PROFILES "/" + bench.machine.name + "_plant.toml");
  return bench;
}

// The signal that ended it before its time; 0 when none did.
int run_all(const Bench& bench, const Options& options, const SwingLimits& limits, Sweep& sweep) {
  const run::Interruption interruption;  // before the threads
  const auto begin = std::chrono::steady_clock::now();
  sweep.results.resize(static_cast<std::size_t>(options.runs));
  const bool progress = isatty(STDERR_FILENO) != 0;
  const auto do_one = [&](int run) {
    sweep.results[static_cast<std::size_t>(run)] = run_trial(bench, draw_trial(options.seed, run, bench.profile.shape, limits), {});
  };
  const int done = in_process::run_trials(options.runs, options.jobs, do_one, [&](int finished, int run) {
    const TrialResult& r = sweep.results[static_cast<std::size_t>(run)];
    if (r.outcome == Outcome::miss) config::print_error("MISS in run {}: {}\n", run, r.why);
    if (progress) config::print_error("\r{} of {} runs", finished, options.runs);
    else if (finished % 500 == 0) config::print_error("{} of {} runs\n", finished, options.runs);
  }, [&] { return interruption.asked(); });
  if (progress) config::print_error("\n");
  sweep.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  sweep.results.resize(static_cast<std::size_t>(done));
  return done < options.runs ? interruption.take() : 0;
}

void tell_one(const TrialResult& r) {
  const auto motion = [](const char* name, const Motion& m) {
    fmt::print("  {:<8} {}{}{}, {:.2f} s, {:.2f} m from the obstacle, {:.2f} m above ground\n", name, m.contact ? "CONTACT: " + m.touched : m.arrived ? "arrived" : "did not arrive", m.governed ? ", slowed" : "",
               m.stopped ? fmt::format(", stopped (reason {})", m.stop_reason) : "", m.seconds, m.closest_m, m.ground_gap_m);
  };
  fmt::print("run {}: {}\n", r.trial.run, describe(r.trial));
  motion("kernel", r.kernel);
  motion("nominal", r.nominal);
  fmt::print("  {}\n", r.outcome == Outcome::right ? "right" : r.outcome == Outcome::miss ? "MISS: " + r.why : "needless stop: " + r.why);
}

void run_one(const Bench& bench, const Options& options, const SwingLimits& limits, Sweep& sweep) {
  const auto begin = std::chrono::steady_clock::now();
  sweep.results.push_back(run_trial(bench, draw_trial(options.seed, options.only, bench.profile.shape, limits), options.trace));
  sweep.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  tell_one(sweep.results.front());
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app{"Thousands of swings past an obstacle of drawn size and place, judged by the oracle: misses, needless stops, time lost. Exit 0: no miss, and at most 0.5 % of needless stops.",
               "berm validate"};
  app.add_option("--runs", options.runs, "number of runs")->check(CLI::Range(1, 10000000))->capture_default_str();
  app.add_option("--seed", options.seed, "seed of every draw")->capture_default_str();
  app.add_option("--only", options.only, "this one run, in detail")->check(CLI::Range(0, 10000000));
  berm::config::output(app.add_option("--trace", options.trace, "with --only: CSV of the kernel's motion"));
  app.add_option("--machine", options.machine, "machine, name or file")->capture_default_str();
  app.add_option("--jobs", options.jobs, "threads (0: one a core)")->check(CLI::Range(0, 1024))->capture_default_str();
  berm::config::output(app.add_option("--json", options.json, "result for scripts"));
  berm::config::output(app.add_option("--picture", options.picture, "SVG of the obstacles by outcome"));
  if (const auto status = config::parse_options(app, argc, argv)) return *status;
  if (!options.trace.empty() && options.only < 0) {
    config::print_error("berm validate: --trace needs --only\n");
    return 2;
  }
  // Of runs that nobody counted any one may be repeated, as a failure's command does.
  if (const std::string wrong = config::not_below("--only", options.only, "--runs", options.runs); app.count("--runs") > 0 && !wrong.empty()) {
    config::print_error("berm validate: {} (see --help)\n", wrong);
    return 2;
  }
  config::expect_apart({{"--trace", options.trace}, {"--json", options.json}, {"--picture", options.picture}}, {{"--machine", run::find_machine(options.machine)}});
  const Bench bench = make_bench(options.machine);
  // Where nobody watches the ground round the tail it must be fenced, as the kernel says when it starts: the sweep keeps to that.
  const double fence = bench.machine.tail.watched ? 0.0 : bench.machine.own_body_radius + bench.machine.tail.clearance;
  const SwingLimits limits{bench.machine.joint[0].velocity_max, loaded_kg, bench.machine.own_body_radius, fence};
  Sweep sweep;
  sweep.seed = options.seed;
  sweep.machine = options.machine;
  sweep.asked = options.only >= 0 ? 1 : options.runs;
  int signal = 0;
  if (options.only >= 0) {
    run_one(bench, options, limits, sweep);
  } else {
    signal = run_all(bench, options, limits, sweep);
    if (signal != 0) config::print_error("berm validate: interrupted ({}) after {} of {} runs\n", strsignal(signal), sweep.results.size(), options.runs);
    if (sweep.results.empty()) return 1;
    fmt::print("{}", summary_text(sweep));
  }
  const auto result = flat_json(sweep);
  if (!options.json.empty()) config::write_whole_file(options.json, config::json_text(result, 1));
  if (!options.picture.empty()) write_picture(options.picture, sweep);
  const bool held = signal == 0 && result["misses"] == 0 && result["needless_stops"].get<double>() <= 0.005 * sweep.asked;
  return held ? 0 : 1;
}

}  // namespace
}  // namespace berm::validate

int main(int argc, char** argv) {
  try {
    return berm::validate::run(argc, argv);
  } catch (const std::exception& error) {
    berm::config::print_error("berm validate: {}\n", error.what());
    return 2;
  }
}
