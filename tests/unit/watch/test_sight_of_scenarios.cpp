// What the shipped scenarios' sensors send without a fault or dust, the machine swinging and the scanners panning over all of their range:
// nothing of it may count as a blocked window, or as dust.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <set>

#include "config/compile_parameters.hpp"
#include "config/machine_file.hpp"
#include "config/site_file.hpp"
#include "io/sight_watch.hpp"
#include "plant/machine/plant_profile.hpp"
#include "plant/process/measured_ground.hpp"
#include "plant/process/scenario.hpp"
#include "plant/world/spinning_lidar.hpp"
#include "run/scenario_names.hpp"

namespace berm::watch {
namespace {

constexpr double kStep = 0.01;

// To and fro between low and high, once in period.
double sweep(double t, double period, double low, double high) {
  const double f = t / period - std::floor(t / period);
  return low + (high - low) * (f < 0.5 ? 2 * f : 2 - 2 * f);
}

void expect_sight(const std::string& path, double seconds) {
  plant::Scenario scenario = plant::load_scenario(path, BERM_PLANT_PROFILES);
  scenario.world.dust.clear();
  scenario.world.scanner_faults.clear();
  scenario.world.lidar_faults.clear();
  const plant::ImplementShape shape = plant::load_plant_profile(scenario.machine_file).shape;
  const run::ScenarioNames names = run::scenario_names(path);
  const std::string config = BERM_CONFIG_FILES;
  const berm_parameters parameters = config::compile_parameters(config::load_machine_file(config + "/machines/" + names.machine + ".toml"),
                                                                config::load_site_file(config + "/sites/" + names.site + ".toml"));
  const auto watch = std::make_unique<kernel::SightWatch>(parameters);
  plant::World world(scenario.world, shape, 1, 1);
  plant::JointState before = scenario.start;
  plant::PanState pan_before;
  int rays = 0;
  for (int k = 1; k * kStep < seconds; ++k) {
    const double t = k * kStep;
    plant::JointState now = before;
    now.angle[0] = sweep(t, 20.0, -3.1, 3.1);
    plant::PanState pan;
    for (std::size_t s = 0; s < 2; ++s) {
      const berm_scanner_mount& mount = parameters.scanner[s];
      pan.angle[s] = sweep(t, 3.7, mount.pan_low_urad * 1e-6, mount.pan_high_urad * 1e-6);
    }
    if (k == 1) before = now, pan_before = pan;
    world.step(t, kStep, now, before);
    std::vector<berm_scan_packet> packets;
    world.scan(t, kStep, before, now, pan_before, pan, packets);
    std::vector<plant::LidarPacket> lidar_packets;
    world.scan_lidars(t, kStep, before, now, lidar_packets);
    const auto now_us = static_cast<std::int64_t>(k) * 10'000;
    for (const berm_scan_packet& p : packets) watch->take(p, now.angle[0], now_us);
    for (const plant::LidarPacket& p : lidar_packets) watch->take(p.lidar, p.bytes.data(), now.angle[0], now_us);
    watch->step(now_us);
    ASSERT_FALSE(watch->blocked()) << path << " at " << t << " s: eyes " << watch->blocked_eyes() << ", swing " << now.angle[0] << ", left pan "
                                   << pan.angle[0];
    ASSERT_EQ(watch->dust(), SK_DUST_NONE) << path << " at " << t << " s: " << watch->dust_permille();
    for (int e = 0; e < kernel::SightWatch::kEyes; ++e)
      for (const sk_strip& s : watch->eye(e).strip) rays += s.expected;
    before = now;
    pan_before = pan;
  }
  EXPECT_GT(rays, 1000) << path << ": nothing was judged";
}

// verifies: SK-SI-15, IF-CF-20 (of the shipped files: dustless ground stays below dust_slow)
TEST(SightOfScenarios, NoNoiseOfTheShippedScenariosBlocksASensorOrIsDust) {
  int seen = 0;
  std::set<std::string> plants;
  for (const auto& entry : std::filesystem::directory_iterator(BERM_SCENARIOS)) {
    if (entry.path().extension() != ".toml") continue;
    if (entry.path().stem().string().starts_with("measured") && !std::filesystem::exists(plant::recording_path("site_terrain/terrain_xyz.pcd"))) {
      std::cout << "SKIPPED: " << entry.path() << ": its recording is not there (BERM_REAL_DATA)\n";
      continue;
    }
    ++seen;
    // All of the swing, once with each machine; elsewhere a part, for time.
    const bool first = plants.insert(plant::load_scenario(entry.path(), BERM_PLANT_PROFILES).machine_file).second;
    expect_sight(entry.path(), first ? 10.5 : 2.0);
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GE(seen, 14);
  EXPECT_EQ(plants.size(), 5u);
}

}  // namespace
}  // namespace berm::watch
