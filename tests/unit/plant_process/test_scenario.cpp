#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <set>
#include <sstream>

#include "plant/machine/kinematics.hpp"
#include "plant/machine/strict_table.hpp"
#include "plant/process/disturbances.hpp"
#include "plant/process/scenario.hpp"
#include "plant/process/scenario_world.hpp"
#include "scratch.hpp"

namespace berm::plant::testing {
namespace {

std::string text_of(const std::string& name) {
  std::ifstream in(std::string(BERM_SCENARIOS) + "/" + name);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

Scenario loaded(const test::Scratch& scratch, const std::string& text) { return load_scenario(scratch.write("scenario.toml", text), BERM_PLANT_PROFILES); }
Scenario loaded(const std::string& text) { return loaded({}, text); }

std::string refusal(const std::string& text) {
  const test::Scratch scratch;
  try {
    loaded(scratch, text);
  } catch (const ConfigError& error) {
    const std::string what = error.what(), file = scratch.path("scenario.toml: ");
    EXPECT_EQ(what.rfind(file, 0), 0u) << what;
    return what.substr(file.size());
  }
  return "accepted";
}

TEST(Scenario, ShippedScenariosLoadAndStartWithTheBucketOneMetreUp) {
  for (const char* name : {"bench.toml", "person.toml", "two_trucks.toml", "base_tilts.toml", "base_slips.toml", "base_shifts.toml", "dust.toml", "scanner_blocked.toml", "identify.toml", "identify_empty.toml", "person_behind.toml", "lidar_blocked.toml"}) {
    const Scenario s = load_scenario(std::string(BERM_SCENARIOS) + "/" + name, BERM_PLANT_PROFILES);
    EXPECT_EQ(s.name + ".toml", name);
    EXPECT_GE(bucket_underside(load_plant_profile(s.machine_file).shape, s.start), 1.0) << name;
  }
}

TEST(Scenario, BenchIsTheDocumentedSite) {
  const WorldConfig w = loaded(text_of("bench.toml")).world;
  EXPECT_EQ(w.terrain.crest_x, 6.0);
  EXPECT_EQ(w.terrain.crest_y, 3.6);
  EXPECT_EQ(w.terrain.lower_z, -2.2);
  ASSERT_EQ(w.trucks.size(), 1u);
  const TruckConfig& t = w.trucks[0];
  EXPECT_EQ(t.x, -0.70);
  EXPECT_EQ(t.y, 6.75);
  EXPECT_NEAR(t.yaw, std::numbers::pi, 1e-12);
  EXPECT_EQ(t.target_kg, 18000.0);
  EXPECT_NEAR(t.wall_top - t.height, -0.92, 1e-12);
  EXPECT_NEAR(w.soil.density_bank / w.soil.swell, 1340.0, 0.1);
  EXPECT_TRUE(w.movers.empty());
}

TEST(Soil, ShippedSoilsLoadUnderTheirNamesAndDiffer) {
  std::set<std::pair<double, double>> seen;
  for (const char* name : {"sandy_clay", "dry_sand", "sticky_clay", "frozen_crust"}) {
    const std::string file = std::string(BERM_SOILS) + "/" + name + ".toml";
    const SoilConfig soil = load_soil(file);
    StrictTable table = StrictTable::parse_file(file);
    EXPECT_EQ(table.text("name"), name);
    EXPECT_GE(soil.bank_slope, soil.repose) << name;
    EXPECT_TRUE(seen.insert({soil.repose, soil.resistance}).second) << name;
  }
  const SoilConfig bench = loaded(text_of("bench.toml")).world.soil, clay = load_soil(std::string(BERM_SOILS) + "/sandy_clay.toml");
  EXPECT_EQ(clay.density_bank, bench.density_bank);
  EXPECT_EQ(clay.repose, bench.repose);
  EXPECT_EQ(clay.bank_slope, bench.bank_slope);
  EXPECT_EQ(clay.resistance, bench.resistance);
}

// 45 degrees rise one on one, in the soil, in the rain and on a mound.
TEST(Soil, SlopesAreOfTheFilesAngles) {
  const test::Scratch scratch;
  const SoilConfig soil = load_soil(scratch.write("steep.toml", "schema = 1\nname = \"steep\"\n[soil]\ndensity_bank_kg_m3 = 1474.0\nswell = 1.1\nrepose_deg = 45.0\n"
                                                                "bank_slope_deg = 60.0\nresistance = 0.5\nstick_fraction = 0.0\n"));
  EXPECT_NEAR(soil.repose, 1.0, 1e-12);
  EXPECT_NEAR(soil.bank_slope, std::sqrt(3.0), 1e-12);
  const WorldConfig w = loaded(scratch, text_of("bench.toml") + "\n[[soil_change]]\nat_s = 9.0\nrepose_deg = 45.0\nbank_slope_deg = 60.0\nresistance = 0.5\nstick_fraction = 0.0\n"
                                            "\n[[terrain.mound]]\nfrom = [1.0, -9.0]\nto = [2.0, -9.0]\ntop = 1.0\nslope_deg = 45.0\n").world;
  ASSERT_EQ(w.soil_changes.size(), 1U);
  EXPECT_NEAR(w.soil_changes[0].repose, 1.0, 1e-12);
  EXPECT_NEAR(w.soil_changes[0].bank_slope, std::sqrt(3.0), 1e-12);
  ASSERT_FALSE(w.terrain.mounds.empty());
  EXPECT_NEAR(w.terrain.mounds.back().slope, 1.0, 1e-12);
}

TEST(Soil, WhatIsWrongIsNamed) {
  const test::Scratch scratch;
  const std::string path = scratch.write("mud.toml", "schema = 1\nname = \"mud\"\n[soil]\nswell = 1.1\n");
  try {
    load_soil(path);
    ADD_FAILURE() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_EQ(std::string(error.what()), path + ": soil.density_bank_kg_m3: is missing");
  }
}

// What app and kernel are told of the site is what the plant's site is.
TEST(Scenario, BenchAgreesWithTheSiteFile) {
  const WorldConfig w = loaded(text_of("bench.toml")).world;
  StrictTable site = StrictTable::parse_file(BERM_SITE_FILE);
  StrictTable zone = site.tables("dig_zone").at(0), truck = site.table("truck");
  ASSERT_EQ(w.dig_zones.size(), 1u);
  const DigZoneConfig& z = w.dig_zones[0];
  EXPECT_EQ((std::array<double, 2>{z.x_low, z.x_high}), zone.array<2>("x", -100, 100));
  EXPECT_EQ((std::array<double, 2>{z.y_low, z.y_high}), zone.array<2>("y", -100, 100));
  EXPECT_EQ(z.floor, zone.number("floor", -100, 100));
  const TruckConfig& t = w.trucks[0];
  EXPECT_EQ((std::array<double, 2>{t.x, t.y}), truck.array<2>("centre", -100, 100));
  EXPECT_NEAR(std::remainder(t.yaw - truck.number("yaw_deg", -180, 180) * std::numbers::pi / 180, std::numbers::pi), 0.0, 1e-9) << "either way round";
  EXPECT_EQ(t.target_kg, truck.number("target_kg", 0, 1e6));
}

TEST(Scenario, PersonWaitsForTheSwing) {
  const WorldConfig w = loaded(text_of("person.toml")).world;
  ASSERT_EQ(w.movers.size(), 1u);
  EXPECT_FALSE(w.movers[0].vehicle);
  EXPECT_EQ(w.movers[0].height, 1.8);
  ASSERT_TRUE(w.movers[0].start_swing_above.has_value());
  ASSERT_EQ(w.movers[0].waypoints.size(), 3u);
  EXPECT_EQ(w.movers[0].waypoints[1].wait_s, 35.0);
}

TEST(Scenario, EveryKindOfMistakeIsNamed) {
  const std::string good = text_of("bench.toml");
  EXPECT_EQ(refusal(replaced(good, "schema = 1", "schema = 1\ncolour = 3")), "colour: is not a known key");
  EXPECT_EQ(refusal(replaced(good, "swell = 1.10", "swell = 0.9")), "soil.swell: 0.9 is outside 1 .. 2");
  EXPECT_EQ(refusal(replaced(good, "crest_x = 6.0", "")), "terrain.crest_x: is missing");
  EXPECT_EQ(refusal(replaced(good, "toe_x = 7.5", "toe_x = 5.0")), "terrain.toe_x: must be beyond crest_x");
  EXPECT_EQ(refusal(replaced(good, "centre = [-0.70, 6.75]", "centre = [-0.70]")), "truck[0].centre: must be an array of 2 numbers");
  EXPECT_EQ(refusal(replaced(good, "cell = 0.1", "cell = 0.02\ncells = 1")), "terrain.cells: is not a known key");
  EXPECT_EQ(refusal(replaced(good, "samples_per_revolution = 400", "samples_per_revolution = 400.5")), "scanner.samples_per_revolution: must be a whole number");
  EXPECT_EQ(refusal(good + "\n[[lidar_fault]]\nlidar = 5\nkind = \"blocked\"\nat_s = 1\nfor_s = 1\n"), "lidar_fault[0].lidar: 5 is outside 1 .. 4");
  EXPECT_EQ(refusal(good + "\n[[lidar_fault]]\nlidar = 1\nkind = \"wet\"\nat_s = 1\nfor_s = 1\n"), "lidar_fault[0].kind: 'wet' is not one of blocked, silent, stalled");
  const std::string stalled = "\n[[lidar_fault]]\nlidar = 1\nkind = \"stalled\"\nat_s = 1\nfor_s = 1\n";
  EXPECT_EQ(refusal(good + stalled), "accepted");
  EXPECT_EQ(refusal(good + stalled + "sector_deg = [20, 30]\n"), "lidar_fault[0].sector_deg: is for a window that is blocked in part");
  const std::string fault = "\n[[scanner_fault]]\nscanner = 2\nkind = \"blocked\"\nat_s = 1\nfor_s = 1\n";
  EXPECT_EQ(refusal(good + fault), "accepted");
  EXPECT_EQ(refusal(good + replaced(fault, "blocked", "stalled")), "scanner_fault[0].kind: 'stalled' is not one of blocked, silent");
  EXPECT_EQ(refusal(good + replaced(fault, "= 2", "= 0")), "scanner_fault[0].scanner: 0 is outside 1 .. 2");
  EXPECT_EQ(refusal(good + fault + "mirror_deg = [30, 20]\n"), "scanner_fault[0].mirror_deg: low must be below high");
  EXPECT_EQ(refusal(good + replaced(fault, "blocked", "silent") + "mirror_deg = [20, 30]\n"), "scanner_fault[0].mirror_deg: is for a window that is blocked in part");
  EXPECT_EQ(refusal(good + "\n[[dust]]\nat_s = 1\nfor_s = 1\nprobability = 0.7\nlost = 0.4\n"), "dust[0].lost: above 1 together with probability");
  EXPECT_EQ(refusal(good + "\n[[panel]]\naction = \"jump\"\nat_s = 1\nfor_s = 1\n"), "panel[0].action: 'jump' is not one of stop, reset, relearn, emergency, pause");
  EXPECT_EQ(refusal(good + "\n[[person]]\nname = \"Anna B\"\n"), "person[0].name: may hold a-z, 0-9 and _ only: it becomes a column's name");
  EXPECT_EQ(refusal(good + "\n[[person]]\nname = \"truck_1\"\n"), "person[0].name: 'truck_1' is taken");
}

TEST(Scenario, BallastIsOptionalAndChecked) {
  const std::string good = text_of("bench.toml"), key = "bucket_deg = -100.0\n";
  EXPECT_EQ(loaded(good).world.ballast_kg, 0.0);
  EXPECT_EQ(loaded(replaced(good, key, key + "ballast_kg = 1800\n")).world.ballast_kg, 1800.0);
  EXPECT_EQ(refusal(replaced(good, key, key + "ballast_kg = -1\n")), "start.ballast_kg: -1 is outside 0 .. 50000");
  EXPECT_EQ(refusal(replaced(good, key, key + "ballast_kg = \"much\"\n")), "start.ballast_kg: must be a number");
  EXPECT_EQ(load_scenario(std::string(BERM_SCENARIOS) + "/identify.toml", BERM_PLANT_PROFILES).world.ballast_kg, 1800.0);
  EXPECT_EQ(load_scenario(std::string(BERM_SCENARIOS) + "/identify_empty.toml", BERM_PLANT_PROFILES).world.ballast_kg, 0.0);
}

TEST(Scenario, FaultsOfSensorsAndDustAreRead) {
  const WorldConfig plain = loaded(text_of("bench.toml")).world;
  EXPECT_TRUE(plain.scanner_faults.empty() && plain.dust.empty());
  const WorldConfig w = loaded(text_of("scanner_blocked.toml")).world;
  ASSERT_EQ(w.scanner_faults.size(), 1u);
  EXPECT_EQ(w.scanner_faults[0].sensor, 0u);
  EXPECT_FALSE(w.scanner_faults[0].silent);
  EXPECT_EQ(w.scanner_faults[0].at_s, 25.0);
  EXPECT_EQ(w.scanner_faults[0].for_s, 10.0);
  EXPECT_NEAR(w.scanner_faults[0].turn[0], 300 * config::radians(1.0), 1e-12);
  EXPECT_NEAR(w.scanner_faults[0].turn[1], 330 * config::radians(1.0), 1e-12);
  const WorldConfig l = loaded(replaced(text_of("lidar_blocked.toml"), "kind = \"blocked\"", "kind = \"stalled\"")).world;
  ASSERT_EQ(l.lidar_faults.size(), 1u);
  EXPECT_TRUE(l.lidar_faults[0].stalled && !l.lidar_faults[0].silent);
  const WorldConfig d = loaded(text_of("dust.toml")).world;
  ASSERT_EQ(d.dust.size(), 2u);
  EXPECT_EQ(d.dust[1].at_s, 45.0);
  EXPECT_EQ(d.dust[1].for_s, 12.0);
  EXPECT_EQ(d.dust[1].probability, 0.5);
  EXPECT_EQ(d.dust[1].lost, 0.02);
}

TEST(Scenario, WaveformsAndCloudsAreReadAndChecked) {
  const std::string good = text_of("bench.toml"), key = "window_percent = 98.0\n", share = key + "waveform_share = 0.25\n";
  const ScannerConfig plain = loaded(good).world.scanner;
  EXPECT_EQ(plain.waveform_share, 0.0);
  EXPECT_EQ(plain.ranging, Ranging::last_pulse);
  const std::string cloud = "\n[[cloud]]\ncentre = [-0.7, 6.8]\nz = [-2.2, 3]\nlength = 9\nwidth = 6\nyaw_deg = 90\nextinction = 0.5\nat_s = 2\nfor_s = 20\n";
  const std::string whole = replaced(good, key, share + "ranging = \"trailing_edge\"\nreflectivity = 0.4\n") + cloud;
  const WorldConfig w = loaded(whole).world;
  EXPECT_EQ(w.scanner.waveform_share, 0.25);
  EXPECT_EQ(w.scanner.ranging, Ranging::trailing_edge);
  EXPECT_EQ(w.scanner.reflectivity, 0.4);
  ASSERT_EQ(w.clouds.size(), 1u);
  EXPECT_EQ(w.clouds[0].y, 6.8);
  EXPECT_EQ(w.clouds[0].z_low, -2.2);
  EXPECT_EQ(w.clouds[0].length, 9.0);
  EXPECT_EQ(w.clouds[0].width, 6.0);
  EXPECT_NEAR(w.clouds[0].yaw, std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(w.clouds[0].extinction, 0.5);
  EXPECT_EQ(w.clouds[0].at_s, 2.0);
  EXPECT_EQ(w.clouds[0].for_s, 20.0);
  EXPECT_EQ(refusal(replaced(whole, "share = 0.25", "share = 1.5")), "scanner.waveform_share: 1.5 is outside 0 .. 1");
  EXPECT_EQ(refusal(replaced(whole, "trailing_edge", "first_pulse")), "scanner.ranging: 'first_pulse' is not one of last_pulse, trailing_edge");
  EXPECT_EQ(refusal(replaced(whole, "reflectivity = 0.4", "reflectivity = 0")), "scanner.reflectivity: 0 is outside 0.01 .. 1");
  EXPECT_EQ(refusal(replaced(whole, "extinction = 0.5", "extinction = 50")), "cloud[0].extinction: 50 is outside 0.001 .. 20");
  EXPECT_EQ(refusal(replaced(whole, "yaw_deg = 90\n", "")), "cloud[0].yaw_deg: is missing");
  EXPECT_EQ(refusal(replaced(good, key, key + "ranging = \"last_pulse\"\n")), "scanner.ranging: is for samples with a waveform: needs a waveform_share above 0");
  EXPECT_EQ(refusal(good + cloud), "cloud: is seen by samples with a waveform alone: needs a scanner.waveform_share above 0");
}

TEST(Scenario, MachineFaultsAreReadAndChecked) {
  const std::string good = text_of("bench.toml"), table = "\n[[machine_fault]]\n";
  EXPECT_TRUE(loaded(good).machine_fault.empty());
  const Scenario s = loaded(good + table + "kind = \"weak_brake\"\njoint = \"swing\"\nat_s = 2.5\nfactor = 0.5\n" + table +
                            "kind = \"stuck_valve\"\njoint = \"boom\"\nat_s = 3\n" + table + "kind = \"runaway\"\njoint = \"bucket\"\nat_s = 4\nfactor = -0.25\n" + table +
                            "kind = \"stuck_angle\"\njoint = \"stick\"\nat_s = 5\nfor_s = 2.5\n" + table + "kind = \"own_error\"\nat_s = 6\n");
  ASSERT_EQ(s.machine_fault.size(), 5u);
  EXPECT_EQ(s.machine_fault[4].kind, MachineFaultKind::own_error);
  EXPECT_FALSE(s.machine_fault[4].for_s.has_value()) << "for good";
  EXPECT_EQ(s.machine_fault[3].for_s, 2.5);
  EXPECT_EQ(s.machine_fault[3].kind, MachineFaultKind::stuck_angle);
  EXPECT_EQ(s.machine_fault[3].joint, 2u);
  EXPECT_EQ(s.machine_fault[0].kind, MachineFaultKind::weak_brake);
  EXPECT_EQ(s.machine_fault[0].joint, 0u);
  EXPECT_EQ(s.machine_fault[0].at_s, 2.5);
  EXPECT_EQ(s.machine_fault[0].factor, 0.5);
  EXPECT_EQ(s.machine_fault[1].kind, MachineFaultKind::stuck_valve);
  EXPECT_EQ(s.machine_fault[1].joint, 1u);
  EXPECT_EQ(s.machine_fault[2].kind, MachineFaultKind::runaway);
  EXPECT_EQ(s.machine_fault[2].joint, 3u);
  EXPECT_EQ(s.machine_fault[2].factor, -0.25);
  EXPECT_EQ(refusal(good + table + "kind = \"rust\"\njoint = \"boom\"\nat_s = 1\n"), "machine_fault[0].kind: 'rust' is not one of weak_brake, stuck_valve, runaway, stuck_angle, own_error");
  EXPECT_EQ(refusal(good + table + "kind = \"stuck_valve\"\njoint = \"track\"\nat_s = 1\n"), "machine_fault[0].joint: 'track' is not one of swing, boom, stick, bucket");
  EXPECT_EQ(refusal(good + table + "kind = \"weak_brake\"\njoint = \"boom\"\nat_s = 1\nfactor = 0\n"), "machine_fault[0].factor: 0 is outside 0.05 .. 1");
  EXPECT_EQ(refusal(good + table + "kind = \"runaway\"\njoint = \"boom\"\nat_s = 1\n"), "machine_fault[0].factor: is missing");
  EXPECT_EQ(refusal(good + table + "kind = \"stuck_valve\"\njoint = \"boom\"\nat_s = 1\nfactor = 0.5\n"), "machine_fault[0].factor: is not a known key");
  EXPECT_EQ(refusal(good + table + "kind = \"stuck_valve\"\njoint = \"boom\"\nat_s = 1\nfor_s = 0\n"), "machine_fault[0].for_s: 0 is outside 0.05 .. 36000");
  EXPECT_EQ(refusal(good + table + "kind = \"own_error\"\njoint = \"boom\"\nat_s = 1\n"), "machine_fault[0].joint: is not a known key");
}

TEST(Scenario, TellsWhenSomethingIsWrong) {
  EXPECT_TRUE(disturbances(loaded(text_of("bench.toml"))).empty());
  EXPECT_TRUE(disturbances(loaded(text_of("person.toml"))).empty()) << "people are in the trace";
  const auto dust = disturbances(loaded(text_of("dust.toml")));
  ASSERT_EQ(dust.size(), 2u);
  EXPECT_EQ(dust[1].what, "dust");
  EXPECT_EQ(dust[1].from_s, 45.0);
  EXPECT_EQ(dust[1].to_s.value(), 57.0);
  const std::string fault = "\n[[machine_fault]]\nkind = \"stuck_valve\"\njoint = \"boom\"\nat_s = 3\n";
  const std::string panel = "\n[[panel]]\naction = \"reset\"\nat_s = 1\nfor_s = 1\n[[panel]]\naction = \"stop\"\nat_s = 5\nfor_s = 2\n";
  const auto both = disturbances(loaded(text_of("bench.toml") + fault + panel));
  ASSERT_EQ(both.size(), 2u) << "a reset is no disturbance";
  EXPECT_EQ(both[0].what, "panel");
  EXPECT_EQ(both[0].to_s.value(), 7.0);
  EXPECT_EQ(both[1].what, "machine");
  EXPECT_FALSE(both[1].to_s.has_value());
  EXPECT_EQ(disturbances(loaded(text_of("bench.toml") + fault + "for_s = 4\n"))[0].to_s, 7.0) << "until it is repaired";
}

TEST(Scenario, MachineIsAProfilesNameOrAPathBesideTheScenario) {
  const std::string good = text_of("bench.toml");
  EXPECT_EQ(loaded(good).machine_file, std::string(BERM_PLANT_PROFILES) + "/zx200_plant.toml");
  const test::Scratch scratch;
  EXPECT_EQ(loaded(scratch, replaced(good, "\"zx200_plant\"", "\"../my.toml\"")).machine_file, scratch.path("../my.toml"));
}

TEST(Scenario, PanelFollowsItsScript) {
  const Scenario s = loaded(text_of("bench.toml") +
                            "\n[[panel]]\naction = \"stop\"\nat_s = 10\nfor_s = 0.5\n[[panel]]\naction = \"reset\"\nat_s = 12\nfor_s = 0.5\n"
                            "[[panel]]\naction = \"pause\"\nat_s = 11\nfor_s = 1\n[[panel]]\naction = \"emergency\"\nat_s = 20\nfor_s = 1\n");
  EXPECT_FALSE(panel_at(s, 0.49).run);
  EXPECT_TRUE(panel_at(s, 0.5).run);
  EXPECT_FALSE(panel_at(s, 9.99).stop);
  EXPECT_TRUE(panel_at(s, 10.0).stop);
  EXPECT_TRUE(panel_at(s, 10.49).stop);
  EXPECT_FALSE(panel_at(s, 10.5).stop);
  EXPECT_TRUE(panel_at(s, 10.5).run);
  EXPECT_FALSE(panel_at(s, 11.5).run);
  EXPECT_TRUE(panel_at(s, 12.2).reset);
  EXPECT_TRUE(panel_at(s, 20.5).emergency);
}

}  // namespace
}  // namespace berm::plant::testing
