// Compiling to integers: every field goes to the safe side, and stays within one step of what was meant.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <random>

#include "config/compile_parameters.hpp"
#include "edited_file.hpp"

namespace berm::config::test {
namespace {

constexpr double kStep = 1.0, kSlack = 2e-6;

void expect_up(double exact, std::int32_t got, const char* what) {
  EXPECT_GE(got, exact - kSlack) << what;
  EXPECT_LT(got, exact + kStep) << what;
}
void expect_down(double exact, std::int32_t got, const char* what) {
  EXPECT_LE(got, exact + kSlack) << what;
  EXPECT_GT(got, exact - kStep) << what;
}

struct Default {
  MachineFile machine = load_machine_file(machine_path());
  SiteFile site = load_site_file(site_path());
};

// verifies: IF-CF-4, IF-CF-9
TEST(Compile, HeadOfTheBlock) {
  const Default d;
  const berm_parameters p = compile_parameters(d.machine, d.site);
  EXPECT_EQ(p.magic, BERM_PARAMETERS_MAGIC);
  EXPECT_EQ(p.version, BERM_PARAMETERS_VERSION);
  EXPECT_EQ(p.size, static_cast<std::int32_t>(sizeof p));
  EXPECT_EQ(p.cell_mm, 300);
  EXPECT_EQ(p.crc32, parameters_crc(p));
  EXPECT_EQ(p.parts, 4);
  EXPECT_EQ(p.part[4].vertices, 0) << "unused entries are zero";
  EXPECT_EQ(p.dig_zones, 1);
}

// verifies: IF-CF-9
TEST(Compile, DecimalsThatAreWholeStayWhole) {
  const Default d;
  const berm_parameters p = compile_parameters(d.machine, d.site);
  EXPECT_EQ(p.boom_length_mm, 5648);
  EXPECT_EQ(p.margin_mm, 300);
  EXPECT_EQ(p.command_latency_us, 90000);
  EXPECT_EQ(p.cycle_us, 10000);
  EXPECT_EQ(p.request_hold_us, 50000);
  EXPECT_EQ(p.request_silent_us, 500000);
  EXPECT_EQ(p.acceleration_max_urad_s2[2], 3210000);
  EXPECT_EQ(p.brake_time_us[0][3][7], 4097000);
  EXPECT_EQ(p.dig_zone[0].floor_mm, -3400);
  EXPECT_EQ(p.dig_zone[0].ceiling_mm, 1100);
  EXPECT_EQ(p.dig_zone[0].x_low_mm, 3900);
}

void expect_joints_safe(const MachineFile& m, const berm_parameters& p) {
  for (std::size_t j = 0; j < kJoints; ++j) {
    const JointFile& joint = m.joint[j];
    expect_up(joint.low * 1e6, p.joint_low_urad[j], "joint_low");
    expect_down(joint.high * 1e6, p.joint_high_urad[j], "joint_high");
    expect_down(joint.velocity_max * 1e6, p.velocity_max_urad_s[j], "velocity_max");
    expect_up(joint.acceleration_max * 1e6, p.acceleration_max_urad_s2[j], "acceleration_max");
    expect_down(joint.creep_velocity * 1e6, p.creep_velocity_urad_s[j], "creep");
    expect_up(joint.angle_error * 1e6, p.angle_error_urad[j], "angle_error");
    expect_up(joint.velocity_error * 1e6, p.velocity_error_urad_s[j], "velocity_error");
    for (std::size_t r = 0; r < BERM_BRAKE_REACHES; ++r)
      for (std::size_t k = 0; k < BERM_BRAKE_SPEEDS; ++k) {
        expect_up(m.braking.angle[j][r][k] * 1e6, p.brake_angle_urad[j][r][k], "brake_angle");
        expect_up(m.braking.time[j][r][k] * 1e6, p.brake_time_us[j][r][k], "brake_time");
      }
  }
  for (std::size_t r = 0; r < BERM_BRAKE_REACHES; ++r) expect_down(m.braking.reach[r] * 1e3, p.brake_reach_mm[r], "brake_reach");
  expect_up(m.state_latency * 1e6, p.state_latency_us, "state_latency");
  expect_up(m.command_latency * 1e6, p.command_latency_us, "command_latency");
}

void expect_rules_safe(const KernelFile& k, const berm_parameters& p) {
  expect_up(k.cycle * 1e6, p.cycle_us, "cycle");
  expect_up(k.margin * 1e3, p.margin_mm, "margin");
  expect_down(k.fresh * 1e6, p.fresh_us, "fresh");
  expect_up(k.generation * 1e6, p.generation_us, "generation");
  expect_down(k.dig_swing_limit * 1e6, p.dig_swing_limit_urad_s, "dig_swing_limit");
  expect_down(k.scanner_silent * 1e6, p.scanner_silent_us, "scanner_silent");
  expect_up(k.spurious_range * 1e3, p.spurious_range_mm, "spurious_range");
  expect_down(k.range_min * 1e3, p.range_min_mm, "range_min");
  expect_up(k.range_max * 1e3, p.range_max_mm, "range_max");
  expect_down(k.self_margin * 1e3, p.self_margin_mm, "self_margin");
  expect_down(k.request_age * 1e6, p.request_age_us, "request_age");
  expect_down(k.request_hold * 1e6, p.request_hold_us, "request_hold");
  expect_down(k.request_silent * 1e6, p.request_silent_us, "request_silent");
  expect_down(k.state_frame_age * 1e6, p.state_frame_age_us, "state_frame_age");
  expect_down(k.machine_state_age * 1e6, p.machine_state_age_us, "machine_state_age");
  expect_down(k.operator_age * 1e6, p.operator_age_us, "operator_age");
  expect_down(k.standstill_speed * 1e6, p.standstill_urad_s, "standstill_speed");
  expect_up(k.standstill * 1e6, p.standstill_us, "standstill");
  expect_down(k.base_tilt * 1e6, p.base_tilt_urad, "base_tilt");
  expect_down(k.base_tilt_hard * 1e6, p.base_tilt_hard_urad, "base_tilt_hard");
  expect_down(k.base_azimuth * 1e6, p.base_azimuth_urad, "base_azimuth");
  expect_down(k.base_frame_age * 1e6, p.base_frame_age_us, "base_frame_age");
}

void expect_tail_safe(const TailFile& t, const berm_parameters& p) {
  EXPECT_EQ(p.tail_watched, t.watched ? 1 : 0);
  expect_up(t.radius * 1e3, p.tail_radius_mm, "tail radius");
  expect_up(t.half_width * 1e3, p.tail_half_width_mm, "tail half_width");
  expect_down(t.underside * 1e3, p.tail_low_mm, "tail underside");
  expect_up(t.top * 1e3, p.tail_high_mm, "tail top");
  expect_up(t.clearance * 1e3, p.tail_clearance_mm, "tail clearance");
  expect_down(t.fresh * 1e6, p.tail_fresh_us, "tail fresh");
}

void expect_workspace_safe(const WorkspaceFile& w, const SiteFile& site, const berm_parameters& p) {
  EXPECT_EQ(p.workspace_watched, w.watched ? 1 : 0);
  EXPECT_EQ(p.workspace_follows, w.follows ? 1 : 0);
  EXPECT_EQ(p.workspace_histogram, w.histogram ? 1 : 0);
  expect_up(w.radius * 1e3, p.workspace_radius_mm, "workspace radius");
  expect_down(w.rise * 1e3, p.workspace_rise_mm, "workspace rise");
  expect_down(w.neighbour * 1e3, p.workspace_neighbour_mm, "workspace neighbour");
  expect_up(w.slope * 1e3, p.workspace_slope_mm, "workspace slope");
  expect_down(w.wait * 1e6, p.workspace_wait_us, "workspace wait");
  expect_down(w.period * 1e6, p.workspace_period_us, "workspace period");
  expect_up(w.dwell * 1e6, p.workspace_dwell_us, "workspace dwell");
  expect_down(w.learn * 1e6, p.workspace_learn_us, "workspace learn");
  expect_down(w.learn_speed * 1e3, p.workspace_learn_speed_permille, "workspace learn_speed");
  EXPECT_EQ(p.workspace_foreign, w.foreign);
  EXPECT_EQ(p.workspace_separation, w.separation);
  expect_up(w.approach_speed * 1e3, p.workspace_approach_mm_s, "workspace approach_speed");
  expect_up(w.intrusion_distance * 1e3, p.workspace_intrusion_mm, "workspace intrusion_distance");
  expect_down(w.lidar_wait * 1e6, p.workspace_lidar_wait_us, "workspace lidar_wait");
  expect_down(w.lidar_period * 1e6, p.workspace_lidar_period_us, "workspace lidar_period");
  ASSERT_EQ(p.lanes, static_cast<std::int32_t>(site.truck_lane.size()));
  for (std::size_t i = 0; i < site.truck_lane.size(); ++i) {
    expect_up(site.truck_lane[i].x_low * 1e3, p.lane[i].x_low_mm, "lane x_low");
    expect_up(site.truck_lane[i].y_low * 1e3, p.lane[i].y_low_mm, "lane y_low");
    expect_down(site.truck_lane[i].x_high * 1e3, p.lane[i].x_high_mm, "lane x_high");
    expect_down(site.truck_lane[i].y_high * 1e3, p.lane[i].y_high_mm, "lane y_high");
  }
}

void expect_sight_safe(const SightFile& s, const berm_parameters& p) {
  expect_down(s.blind * 1e3, p.sight_blind_permille, "sight blind");
  expect_down(s.dust_slow * 1e3, p.dust_slow_permille, "sight dust_slow");
  expect_down(s.dust_stop * 1e3, p.dust_stop_permille, "sight dust_stop");
  expect_down(s.dust_speed * 1e3, p.dust_speed_permille, "sight dust_speed");
  expect_up(s.dust_dwell * 1e6, p.dust_dwell_us, "sight dust_dwell");
}

void expect_places_safe(const MachineFile& m, const SiteFile& site, const berm_parameters& p) {
  expect_down(m.own_body_radius * 1e3, p.own_body_radius_mm, "own_body_radius");
  for (std::size_t i = 0; i < m.part.size(); ++i) {
    expect_up(m.part[i].half_width * 1e3, p.part[i].half_width_mm, "half_width");
    for (std::size_t v = 0; v < m.part[i].outline.size(); ++v)
      for (std::size_t axis = 0; axis < 2; ++axis) EXPECT_NEAR(m.part[i].outline[v][axis] * 1e3, p.part[i].vertex_mm[v][axis], 1e-6);
  }
  for (std::size_t i = 0; i < m.scanner.size(); ++i) {
    expect_up(m.scanner[i].pan_low * 1e6, p.scanner[i].pan_low_urad, "pan_low");
    expect_down(m.scanner[i].pan_high * 1e6, p.scanner[i].pan_high_urad, "pan_high");
    expect_down(m.scanner[i].pan_rate_max * 1e6, p.scanner[i].pan_rate_max_urad_s, "pan_rate_max");
  }
  for (std::size_t i = 0; i < site.dig_zone.size(); ++i) {
    const DigZoneFile& zone = site.dig_zone[i];
    expect_up(zone.x_low * 1e3, p.dig_zone[i].x_low_mm, "zone x_low");
    expect_down(zone.x_high * 1e3, p.dig_zone[i].x_high_mm, "zone x_high");
    expect_up(zone.y_low * 1e3, p.dig_zone[i].y_low_mm, "zone y_low");
    expect_down(zone.y_high * 1e3, p.dig_zone[i].y_high_mm, "zone y_high");
    expect_up(zone.floor * 1e3, p.dig_zone[i].floor_mm, "zone floor");
    expect_down(zone.ceiling * 1e3, p.dig_zone[i].ceiling_mm, "zone ceiling");
  }
  expect_down(site.pass_over * 1e3, p.pass_over_mm, "pass_over");
  ASSERT_EQ(p.ground_zones, static_cast<std::int32_t>(site.ground_zone.size()));
  for (std::size_t i = 0; i < site.ground_zone.size(); ++i) {
    const GroundZoneFile& zone = site.ground_zone[i];
    expect_down(zone.x_low * 1e3, p.ground_zone[i].x_low_mm, "ground x_low");
    expect_up(zone.x_high * 1e3, p.ground_zone[i].x_high_mm, "ground x_high");
    expect_down(zone.y_low * 1e3, p.ground_zone[i].y_low_mm, "ground y_low");
    expect_up(zone.y_high * 1e3, p.ground_zone[i].y_high_mm, "ground y_high");
    expect_down(zone.pass_over * 1e3, p.ground_zone[i].pass_over_mm, "ground pass_over");
  }
  ASSERT_EQ(p.truck_zones, static_cast<std::int32_t>(site.truck_zone.size()));
  for (std::size_t i = 0; i < site.truck_zone.size(); ++i) {
    const TruckZoneFile& zone = site.truck_zone[i];
    expect_up(zone.x_low * 1e3, p.truck_zone[i].x_low_mm, "truck x_low");
    expect_down(zone.x_high * 1e3, p.truck_zone[i].x_high_mm, "truck x_high");
    expect_up(zone.y_low * 1e3, p.truck_zone[i].y_low_mm, "truck y_low");
    expect_down(zone.y_high * 1e3, p.truck_zone[i].y_high_mm, "truck y_high");
    expect_down(zone.ceiling * 1e3, p.truck_zone[i].ceiling_mm, "truck ceiling");
  }
}

// Scales every number by a little, so that hardly any is whole; the statement above is per field and independent of the product's helpers.
void disturb(MachineFile& m, SiteFile& site, std::mt19937_64& random) {
  std::uniform_real_distribution<double> factor(0.98, 1.0);
  const auto shake = [&](auto&... value) { ((value *= factor(random)), ...); };
  for (JointFile& j : m.joint) shake(j.low, j.high, j.velocity_max, j.acceleration_max, j.creep_velocity, j.angle_error, j.velocity_error);
  for (std::size_t j = 0; j < kJoints; ++j)
    for (std::size_t r = 0; r < BERM_BRAKE_REACHES; ++r)
      for (std::size_t k = 0; k < BERM_BRAKE_SPEEDS; ++k) shake(m.braking.angle[j][r][k], m.braking.time[j][r][k]);
  for (double& reach : m.braking.reach) shake(reach);
  shake(m.state_latency, m.command_latency, m.own_body_radius);
  for (PartFile& part : m.part) shake(part.half_width);
  for (ScannerFile& s : m.scanner) shake(s.pan_low, s.pan_high, s.pan_rate_max);
  KernelFile& k = m.kernel;
  shake(k.cycle, k.margin, k.fresh, k.generation, k.dig_swing_limit, k.scanner_silent, k.spurious_range, k.range_min, k.range_max, k.self_margin, k.request_age,
        k.request_hold, k.request_silent, k.state_frame_age, k.machine_state_age, k.operator_age, k.standstill_speed, k.standstill,
        k.base_tilt, k.base_tilt_hard, k.base_azimuth, k.base_frame_age);
  for (DigZoneFile& zone : site.dig_zone) shake(zone.x_low, zone.x_high, zone.y_low, zone.y_high, zone.floor, zone.ceiling);
  shake(m.tail.radius, m.tail.half_width, m.tail.underside, m.tail.top, m.tail.clearance, m.tail.fresh);
  m.tail.watched = random() % 2 == 0;
  shake(site.pass_over);
  for (GroundZoneFile& zone : site.ground_zone) shake(zone.x_low, zone.x_high, zone.y_low, zone.y_high, zone.pass_over);
  for (TruckZoneFile& zone : site.truck_zone) shake(zone.x_low, zone.x_high, zone.y_low, zone.y_high, zone.ceiling);
  WorkspaceFile& w = m.workspace;
  shake(w.radius, w.rise, w.neighbour, w.slope, w.wait, w.period, w.dwell, w.learn, w.lidar_wait, w.lidar_period, w.approach_speed, w.intrusion_distance);
  w.watched = random() % 2 == 0;
  w.follows = random() % 2 == 0;
  w.histogram = random() % 2 == 0;
  w.separation = static_cast<int>(random() % 3);
  SightFile& s = m.sight;
  shake(s.blind, s.dust_slow, s.dust_stop, s.dust_speed, s.dust_dwell);
  for (LaneFile& lane : site.truck_lane) shake(lane.x_low, lane.x_high, lane.y_low, lane.y_high);
}

// verifies: IF-CF-10, IF-CF-11, IF-CF-12, IF-CF-13
TEST(Compile, EveryFieldIsRoundedToTheSafeSide) {
  constexpr std::uint64_t kSeed = 7;
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 200; ++i) {
    Default d;
    if (i > 0) disturb(d.machine, d.site, random);
    const berm_parameters p = compile_parameters(d.machine, d.site);
    expect_joints_safe(d.machine, p);
    expect_rules_safe(d.machine.kernel, p);
    expect_places_safe(d.machine, d.site, p);
    expect_tail_safe(d.machine.tail, p);
    expect_workspace_safe(d.machine.workspace, d.site, p);
    expect_sight_safe(d.machine.sight, p);
    ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << kSeed << " draw " << i;
  }
}

// verifies: IF-CF-21 (none of it reaches the kernel)
TEST(Compile, WhatTheCylindersAreLikeIsNotInTheBlock) {
  Default d;
  const berm_parameters before = compile_parameters(d.machine, d.site);
  for (CylinderFile& c : d.machine.cylinder) std::swap(c.bottom, c.rod), c.bottom += 1.0;
  const berm_parameters after = compile_parameters(d.machine, d.site);
  EXPECT_EQ(std::memcmp(&after, &before, sizeof before), 0);
}

// So that a table measured anew reaches all files.
TEST(Compile, TheMachinesWithLidarsAreTheSameButForThemAndWhatTheyWatch) {
  const Default d;
  const berm_parameters plain = compile_parameters(d.machine, d.site);
  berm_parameters rear = compile_parameters(load_machine_file(BERM_CONFIG_FILES "/machines/zx200_rear.toml"), d.site);
  berm_parameters ring = compile_parameters(load_machine_file(BERM_CONFIG_FILES "/machines/zx200_ring.toml"), d.site);
  EXPECT_EQ(rear.tail_watched, 1);
  rear.tail_watched = plain.tail_watched;
  EXPECT_EQ(ring.workspace_watched, 1);
  EXPECT_EQ(ring.workspace_radius_mm, 15000);
  EXPECT_EQ(ring.workspace_learn_us, 45000000) << "a truck's rim is met by every other sweep of the panning scanners, and the machine has to swing to it, slowly";
  EXPECT_EQ(ring.workspace_histogram, 1);
  ring.workspace_watched = plain.workspace_watched;
  ring.workspace_histogram = plain.workspace_histogram;
  ring.workspace_learn_us = plain.workspace_learn_us;
  ring.workspace_radius_mm = plain.workspace_radius_mm;
  for (berm_parameters* with : {&rear, &ring}) {
    ASSERT_EQ(with->lidars, 2);
    with->lidars = plain.lidars;
    std::copy(std::begin(plain.lidar), std::end(plain.lidar), with->lidar);
    with->crc32 = plain.crc32;
    EXPECT_EQ(std::memcmp(with, &plain, sizeof plain), 0);
  }
}

}  // namespace
}  // namespace berm::config::test
