// berm_plant: the simulated excavator and site, behind the machine's own CAN frames and the scanners' datagrams.
#include <signal.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "config/command_line.hpp"
#include "config/standard_error.hpp"
#include "plant/machine/kinematics.hpp"
#include "plant/machine/strict_table.hpp"
#include "plant/process/plant_run.hpp"
#include "plant/process/scenario_world.hpp"

namespace {

using namespace berm::plant;

constexpr int kBadInput = 2;
constexpr double kStartClearance = 0.2;  // m of the bucket above the bench

// The descriptor that becomes readable when the run is asked to end.
int stop_descriptor() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  signal(SIGPIPE, SIG_IGN);
  return signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
}

void check_start(const std::string& file, const Scenario& scenario, const PlantProfile& profile) {
  static constexpr std::array<const char*, 4> kKey{"swing_deg", "boom_deg", "stick_deg", "bucket_deg"};
  for (std::size_t j = 0; j < 4; ++j) {
    const JointConfig& joint = profile.dynamics.joint[j];
    if (scenario.start.angle[j] < joint.low || scenario.start.angle[j] > joint.high)
      throw ConfigError(file + ": start." + kKey[j] + ": is outside the joint's range");
  }
  if (scenario.world.ballast_kg > profile.shape.bucket_payload_max_kg)
    throw ConfigError(fmt::format("{}: start.ballast_kg: {} is above the bucket's payload_max_kg, {}", file,
                                  scenario.world.ballast_kg, profile.shape.bucket_payload_max_kg));
  if (bucket_underside(profile.shape, scenario.start) < kStartClearance) throw ConfigError(file + ": start: the bucket would be in the ground");
}

int run(int argc, char** argv) {
  std::string scenario_file, soil_file, profiles = BERM_PLANT_PROFILES;
  RunOptions options;
  bool lockstep = false, check_only = false;
  CLI::App app{"The simulated excavator and its site. Writes trace.csv, truth.json, terrain_start.csv and terrain_end.csv to the folder --out; "
               "prints events as JSON lines.",
               "berm_plant"};
  app.add_option("--scenario", scenario_file, "scenario file (TOML)")->required();
  app.add_option("--soil", soil_file, "soil file (TOML) that takes the place of the scenario's soil");
  app.add_option("--profiles", profiles, "folder of the machine profiles that scenarios name")->capture_default_str();
  app.add_option("--seed", options.seed, "seed of everything random")->capture_default_str();
  app.add_option("--trucks", options.trucks, "trucks to come, one after another")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--can", options.can_address, "can:INTERFACE or udp:GROUP:PORT")->required();
  app.add_option("--scan-port", options.scan_port, "UDP port on loopback that takes the scan packets")->required()->check(CLI::Range(1, 65535));
  app.add_option("--lidar-port", options.lidar_port, "UDP port on loopback of a lidar on the upper body; once for each that the profile has")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--silence", options.peers.silence_s, "seconds of wall clock after which a peer that says nothing is absent")->check(CLI::Range(1, 3600))->capture_default_str();
  app.add_option("--alone", options.alone_s, "seconds at standstill without kernel or app after which the run ends")->check(CLI::Range(1.0, 3600.0))->capture_default_str();
  app.add_option("--pause-kernel", options.pause_kernel_s, "FROM FOR: seconds of the run in which the kernel is held up, in lockstep: it begins no cycle")->check(CLI::Range(0.0, 36000.0));
  app.add_option("--trace-every", options.trace_every, "cycles from one row of trace.csv to the next")->check(CLI::Range(1, 6000))->capture_default_str();
  app.add_option("--out", options.out, "folder for the results, made when missing")->required();
  auto* step = app.add_flag("--lockstep", lockstep, "virtual time, in step with kernel and app (default)");
  app.add_flag("--realtime", options.realtime, "wall-clock time")->excludes(step);
  app.add_option("--tick-fd", options.peers.tick, "inherited SOCK_SEQPACKET descriptor with the app's ticks")->check(CLI::Range(0, 1 << 20));
  app.add_option("--kernel-fd", options.peers.kernel, "inherited read end of the kernel's lifeline pipe")->check(CLI::Range(0, 1 << 20));
  app.add_option("--journal-fd", options.peers.journal, "inherited SOCK_SEQPACKET descriptor with the cycles that the journal's writer has taken")
      ->check(CLI::Range(0, 1 << 20));
  app.add_flag("--check", check_only, "reads scenario, soil and profile, says what is wrong with them, and ends: nothing runs, nothing is written");
  if (const auto status = berm::config::parse_options(app, argc, argv)) return *status;
  options.stop_fd = stop_descriptor();
  try {
    Scenario scenario = load_scenario(scenario_file, profiles);
    if (!soil_file.empty()) scenario.world.soil = load_soil(soil_file);
    const PlantProfile profile = load_plant_profile(scenario.machine_file);
    check_start(scenario_file, scenario, profile);
    if (!check_only) PlantRun(scenario, profile, options).run();
  } catch (const ConfigError& error) {
    berm::config::print_error("{}\n", error.what());
    return kBadInput;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    berm::config::print_error("berm_plant: {}\n", error.what());
    return 1;
  }
}
