// berm watch: intruders against the Workspace Monitor.
#include <fmt/format.h>
#include <string.h>
#include <unistd.h>

#include <chrono>
#include <exception>
#include <filesystem>

#include "config/json_text.hpp"
#include "config/machine_file.hpp"
#include "config/output_file.hpp"
#include "config/standard_error.hpp"
#include "config/whole_file.hpp"
#include "run/interruption.hpp"
#include "run/out_folder.hpp"
#include "run/parameter_file.hpp"
#include "run/scenario_names.hpp"
#include "watch/intrusion_campaign.hpp"
#include "watch/options.hpp"
#include "watch/quiet_hours.hpp"
#include "watch/scenario_watch.hpp"

namespace berm::watch {
namespace {

constexpr std::size_t told_every = 50;  // intrusions; what is over by then is written, too

// A pipe or a device takes the result once, at the end.
bool can_be_written_again(const std::string& path) {
  return !path.empty() && (std::filesystem::is_regular_file(path) || !std::filesystem::exists(path));
}

int watch_intrusions(const Options& options) {
  Campaign campaign;
  int signal = 0;
  campaign.machine = options.machine.empty() ? drawn_machine : options.machine;
  campaign.seed = options.seed;
  campaign.when = options.while_learning ? When::learning : When::learned;
  campaign.asked = options.only >= 0 ? 1 : options.intrusions;
  const Bench bench = make_bench(campaign.machine, options.histogram, BERM_PLANT_PROFILES);
  campaign.histogram = bench.machine.workspace.histogram;
  const auto draw = [&](int run) { return draw_intrusion(options.seed, run, bench.intrusion_site, campaign.when); };
  if (options.only >= 0) {
    campaign.results.push_back(run_intrusion(bench, draw(options.only), options.trace));
    fmt::print("{}", detail_text(campaign.results.front()));
  } else {
    const run::Interruption interruption;  // before the processes, which a terminal's signal meets as well
    const auto begin = std::chrono::steady_clock::now();
    const bool progress = isatty(STDERR_FILENO) != 0;
    const auto seconds = [begin] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
    run_campaign(bench, options.intrusions, options.jobs, campaign, [&](const IntrusionResult& r) {
      const std::size_t finished = campaign.results.size();
      if (r.failed()) config::print_error("{}FAILED: {}\n", progress ? "\r" : "", command_of(campaign, r));
      if (progress) config::print_error("\r{} of {} intrusions", finished, options.intrusions);
      if (finished % told_every != 0) return;
      if (!progress) config::print_error("{} of {} intrusions\n", finished, options.intrusions);
      campaign.wall_seconds = seconds();
      if (can_be_written_again(options.json)) config::write_whole_file(options.json, config::json_text(flat_json(campaign), 1));
    }, [&] { return interruption.asked(); });
    if (progress) config::print_error("\n");
    campaign.wall_seconds = seconds();
    const bool whole = campaign.results.size() == static_cast<std::size_t>(campaign.asked);
    if (!whole) signal = interruption.take();
    if (signal != 0) config::print_error("berm watch: interrupted ({}) after {} of {} intrusions\n", strsignal(signal), campaign.results.size(), campaign.asked);
    if (campaign.results.empty()) return 1;
    fmt::print("{}", summary_text(campaign));
  }
  const auto result = flat_json(campaign);
  if (!options.json.empty()) config::write_whole_file(options.json, config::json_text(result, 1));
  return signal == 0 && result["unsafe"] == 0 && result["undetected"] == 0 ? 0 : 1;
}

// No result goes over a file that makes it, or over another.
void keep_apart(const Options& o) {
  std::vector<config::NamedFile> read, written = run::run_files(o.out);
  if (!o.scenario.empty()) read = run::files_of_scenario(run::find_scenario(o.scenario));
  if (!o.machine.empty()) read.push_back({"--machine", run::find_machine(o.machine)});
  written.insert(written.end(), {{"--json", o.json}, {"--picture", o.picture}, {"--trace", o.trace}});
  config::expect_apart(written, read);
}

int watch_one_scenario(const Options& o) {
  const ScenarioResult result = watch_scenario({o.scenario, o.machine, o.out, o.picture, BERM_PLANT_PROFILES, o.histogram, o.seed, o.trucks, o.max_time_s});
  fmt::print("{}", summary_text(result));
  if (!o.json.empty()) config::write_whole_file(o.json, config::json_text(flat_json(result), 1));
  return result.held() ? 0 : 1;
}

int watch_quietly(const Options& o) {
  const auto so_far = [&](const QuietResult& result) {
    if (can_be_written_again(o.json)) config::write_whole_file(o.json, config::json_text(flat_json(result), 1));
  };
  const std::string machine = o.machine.empty() ? drawn_machine : o.machine;
  const bool histogram = o.histogram || config::load_machine_file(run::find_machine(machine)).workspace.histogram;
  const QuietResult result = watch_quiet_hours({o.quiet_hours, o.seed, machine, histogram, BERM_PLANT_PROFILES, o.jobs}, so_far);
  fmt::print("{}", summary_text(result));
  if (!o.json.empty()) config::write_whole_file(o.json, config::json_text(flat_json(result), 1));
  return result.false_alarms() == 0 && result.contacts() == 0 ? 0 : 1;
}

int run(int argc, char** argv) {
  Options options;
  if (const auto status = read_options(argc, argv, options)) return *status;
  keep_apart(options);
  if (options.intrusions > 0) return watch_intrusions(options);
  return options.scenario.empty() ? watch_quietly(options) : watch_one_scenario(options);
}

}  // namespace
}  // namespace berm::watch

int main(int argc, char** argv) {
  try {
    return berm::watch::run(argc, argv);
  } catch (const berm::run::ToldAlready&) {
    return 2;
  } catch (const std::exception& error) {
    berm::config::print_error("berm watch: {}\n", error.what());
    return 2;
  }
}
