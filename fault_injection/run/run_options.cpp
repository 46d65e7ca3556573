#include "run/run_options.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "config/command_line.hpp"
#include "config/standard_error.hpp"

namespace berm::run {

namespace {

constexpr double kLongestKernelPause_s = 0.5;  // what is sent in it the kernel's first cycle afterwards takes in whole

std::optional<double> time_of(const std::string& text) {
  char* end = nullptr;
  const double seconds = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(seconds) || seconds < 0.0) return std::nullopt;
  return seconds;
}

ProcessFault parse_fault(const std::string& text) {
  const auto at = text.find('@');
  const std::string kind = text.substr(0, at);
  ProcessFault fault{};
  if (kind == "kill-app") fault.kind = FaultKind::kill_app;
  else if (kind == "stop-app") fault.kind = FaultKind::stop_app;
  else if (kind == "pause-app") fault.kind = FaultKind::pause_app;
  else if (kind == "kill-kernel") fault.kind = FaultKind::kill_kernel;
  else if (kind == "pause-kernel") fault.kind = FaultKind::pause_kernel;
  else if (kind == "kill-journal") fault.kind = FaultKind::kill_journal;
  else throw CLI::ValidationError("--fault", "unknown fault '" + kind + "': kill-app, stop-app, kill-kernel or kill-journal, then @SECONDS, or pause-app or pause-kernel, then @SECONDS+SECONDS");
  const bool pauses = fault.kind == FaultKind::pause_app || fault.kind == FaultKind::pause_kernel;
  const std::string seconds = at == std::string::npos ? "" : text.substr(at + 1);
  const auto plus = pauses ? seconds.find('+') : std::string::npos;
  const auto at_s = time_of(seconds.substr(0, plus));
  const auto for_s = pauses && plus != std::string::npos ? time_of(seconds.substr(plus + 1)) : std::nullopt;
  if (!at_s || (pauses && !for_s))
    throw CLI::ValidationError("--fault", "'" + text + (pauses ? "' wants a time and how long: e.g. " + kind + (fault.kind == FaultKind::pause_app ? "@12.5+4" : "@12.5+0.1") : "' wants a time: e.g. kill-app@12.5"));
  if (fault.kind == FaultKind::pause_kernel && !(*for_s > 0.0 && *for_s <= kLongestKernelPause_s))
    throw CLI::ValidationError("--fault", fmt::format("'{}': a kernel is held up for more than 0 and at most {} s", text, kLongestKernelPause_s));
  fault.at_s = *at_s;
  fault.for_s = for_s.value_or(0.0);
  return fault;
}

}  // namespace

std::optional<int> read_options(int argc, char** argv, RunOptions& options) {
  std::string fault;
  CLI::App app{"Starts plant (simulated machine and site), safety kernel and planning app as three processes and loads trucks.\n"
               "Exit status 0: every truck was loaded to at least 95 % of its target, nothing was touched, the kernel saw no fault.\n"
               "SIGINT or SIGTERM ends the run with the summary of what ran until then.",
               "berm load"};
  app.add_option("--scenario", options.scenario, "a name (bench, person, ...) or a TOML file")->capture_default_str();
  app.add_option("--scripts", options.scripts, "folder of other scripts than the app's own (pass.script, approach.script)");
  app.add_option("--soil", options.soil, "another soil than the scenario's: sandy_clay, dry_sand, sticky_clay, frozen_crust, or a TOML file");
  app.add_option("--trucks", options.trucks, "trucks to load")->capture_default_str()->check(CLI::Range(1, 1000));
  app.add_option("--seed", options.seed, "seed of every random draw")->capture_default_str();
  app.add_flag("--realtime", options.realtime, "run on the wall clock instead of as fast as the computer allows");
  berm::config::output(app.add_option("--json", options.json, "write the result as one flat JSON object"));
  app.add_option("--out", options.out, "folder for trace.csv, truth.json, journal.mcap, app.jsonl, site.svg and result.json; those of an earlier run there are removed first");
  app.add_option("--fault", fault, "a process fault in the run: kill-app@S, stop-app@S, kill-kernel@S or kill-journal@S, S in simulated seconds; then status 0 means that the machine stood still in time, untouched (kill-journal: that nothing came of it). pause-app@S+T: an app that does nothing for T seconds and then goes on; pause-kernel@S+T: a kernel that does, T up to 0.5; status as without a fault");
  app.add_flag("--quiet", options.quiet, "no progress, only the summary");
  if (const auto status = config::parse_options(app, argc, argv)) return status;
  options.report_when_interrupted = true;
  if (!fault.empty()) {
    try {
      options.fault = parse_fault(fault);
    } catch (const CLI::Error& error) {
      config::print_error("berm load: {}\n", error.what());
      return 2;
    }
  }
  return std::nullopt;
}

}  // namespace berm::run
