// berm_app: the planning app. Trusted with nothing: it sees the kernel's state segment and writes motion requests.
#include <malloc.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <string>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/core.h>

#include "app/app_loop.hpp"
#include "app/machine_loader.hpp"
#include "app/recognition_thread.hpp"
#include "app/sandbox.hpp"
#include "config/command_line.hpp"

namespace {

volatile std::sig_atomic_t stop_requested = 0;  // set by a signal handler, which has no other way to say it

void on_signal(int) { stop_requested = 1; }

struct Options {
  std::string machine, site, truck_classes, scripts, socket;
  int trucks = 1;
  int tick_fd = -1;
  bool lockstep = false;
};

// Large blocks by themselves, given back when they are freed. Left to itself the allocator keeps each size that it has once seen freed among the small
// blocks, and the app grew by a step with a truck's sweep here and there, though what was in use did not.
void keep_memory_flat() {
  constexpr int large = 64 << 10;
  mallopt(M_MMAP_THRESHOLD, large);
  mallopt(M_TRIM_THRESHOLD, 2 * large);
}

std::array<double, berm::app::joints> in_degrees(const berm::app::Joints& angles) {
  std::array<double, berm::app::joints> out{};
  for (std::size_t j = 0; j < out.size(); ++j) out[j] = berm::app::degrees(angles[j]);
  return out;
}

int run(const Options& options) {
  using namespace berm::app;
  std::vector<int> keep;
  if (options.tick_fd >= 0) keep.push_back(options.tick_fd);
  close_all_but(keep);
  const MachineModel machine = machine_model(berm::config::load_machine_file(options.machine));
  const SiteModel site = site_model(berm::config::load_site_file(options.site));
  const ScriptSet scripts = read_scripts(options.scripts);
  const ProgressLog log(1);
  constexpr double lockstep_answer_s = 0.05;  // from a scanline to the answer that it brings: what is asked of it, and twice what it takes in the median
  const auto lockstep_cycles = static_cast<std::uint64_t>(options.lockstep ? std::ceil(lockstep_answer_s / machine.cycle) : 0.0);
  RecognitionThread finder(read_truck_ranges(options.truck_classes), lockstep_cycles);
  Sequencer sequencer(machine, site, options.trucks, scripts, finder, log);
  KernelLink link(options.socket);
  keep.push_back(link.socket_fd());
  close_all_but(keep);
  enter_sandbox(link.socket_fd(), options.tick_fd);
  log.event("connected", {{"trucks", options.trucks}, {"machine", options.machine}, {"site", options.site}});
  ScanIntake intake(machine);
  const LoopEnd end = run_loop(machine, link, intake, sequencer, log, options.tick_fd, stop_requested);
  const char* why = end == LoopEnd::stopped ? "signal" : end == LoopEnd::kernel_gone ? "kernel gone" : "tick peer gone";
  const SlowDown& slowed = sequencer.slow_down();
  log.event("exit", {{"why", why}, {"finished", sequencer.finished()}, {"slowed_s", slowed.seconds()}, {"slowed_spans", slowed.spans()},
                     {"least_share", slowed.least_share()}, {"guard_slowed_s", sequencer.guard_account().seconds()}, {"guard_unseen_s", sequencer.guard_account().unseen_seconds()},
                     {"least_spare_deg", degrees(sequencer.scan_wait().least_spare().value_or(0.0))}, {"overruns", sequencer.joint_watch().overruns()},
                     {"prediction_rms_deg", in_degrees(sequencer.joint_watch().prediction_rms())},
                     {"prediction_largest_deg", in_degrees(sequencer.joint_watch().prediction_largest())},
                     {"points_compared", intake.check().compared()}, {"points_disagreeing", intake.check().disagreeing()},
                     {"blocks_missed", intake.counts().blocks_missed}, {"blocks_refused", intake.counts().blocks_refused},
                     {"returns", intake.counts().returns}, {"flagged", intake.counts().flagged}, {"confirmed", intake.counts().confirmed}});
  return end == LoopEnd::stopped || sequencer.finished() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App cli{"The planning app: loads trucks by motion requests to the safety kernel. Progress as JSON lines on stdout.", "berm_app"};
  Options options;
  cli.add_option("--machine", options.machine, "machine file (TOML)")->required()->check(CLI::ExistingFile);
  cli.add_option("--site", options.site, "site file (TOML)")->required()->check(CLI::ExistingFile);
  cli.add_option("--truck-classes", options.truck_classes, "file of truck classes that are recognised (TOML)")->required()->check(CLI::ExistingFile);
  cli.add_option("--scripts", options.scripts, "folder of the scripts, pass.script and approach.script")->required()->check(CLI::ExistingDirectory);
  cli.add_option("--socket", options.socket, "the kernel's Unix socket")->required();
  cli.add_option("--trucks", options.trucks, "trucks to load")->check(CLI::Range(1, 1000));
  cli.add_option("--tick-fd", options.tick_fd, "inherited SOCK_SEQPACKET descriptor for the simulation's tick")->check(CLI::Range(3, 1 << 20));
  cli.add_flag("--lockstep", options.lockstep, "in simulation: time waits for the app");
  if (const auto status = berm::config::parse_options(cli, argc, argv)) return *status;
  struct sigaction action {};
  action.sa_handler = on_signal;  // no SA_RESTART: waiting calls return
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGINT, &action, nullptr);
  keep_memory_flat();
  int code = 1;
  try {
    code = run(options);
  } catch (const std::exception& e) {
    const std::string line = fmt::format("berm_app: {}\n", e.what());
    std::fputs(line.c_str(), stderr);
  }
  std::fflush(stderr);
  std::_Exit(code);  // the sandbox leaves nothing for exit handlers to do
}
