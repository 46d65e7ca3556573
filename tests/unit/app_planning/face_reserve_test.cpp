// What a face still holds, by grounds of which that can be reckoned, and how far back the machine should go for a fresh one.
#include "planning/face_reserve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "app_bench/bench_machine.hpp"
#include "planning/cut_model.hpp"

namespace {

using namespace berm::app;

constexpr double width = 1.1, lowest = -2.0;

FaceReserve reserve(const SiteModel& site, const std::function<double(double, double)>& height) {
  TerrainMap map;
  for (double x = 0.0; x < 12.0; x += 0.05)
    for (double y = -8.0; y < 8.0; y += 0.05) map.insert(x, y, height(x, y), 1.0);
  DigGround ground(site);
  ground.observe(map);
  return face_reserve(site, ground, lowest, width);
}

double level(double, double) { return 0.0; }

// Ground that falls off to under every dig at this distance from the swing axis.
std::function<double(double, double)> falls_at(double crest) {
  return [crest](double x, double y) { return std::hypot(x, y) < crest ? 0.0 : -3.0; };
}

// Between the radii of a drag, the nearer ones 0.4 m farther in, and as far beside the site's bearings as digs are sought: 18 degrees.
double sector_m2(const SiteModel& site, double outer) {
  const double angle = site.dig_swing_left - site.dig_swing_right + 2.0 * radians(18.0), inner = site.dig_radius_end - 0.4;
  return 0.5 * angle * (outer * outer - inner * inner);
}

TEST(FaceReserve, IsWhatLiesOverTheFloorWithinReach) {
  const SiteModel site = berm::app_bench::bench();
  const double all = sector_m2(site, site.dig_radius_start);
  EXPECT_NEAR(reserve(site, level).volume, 2.0 * all, 0.1 * 2.0 * all);
  EXPECT_NEAR(reserve(site, [](double, double) { return -1.5; }).volume, 0.5 * all, 0.1 * 0.5 * all);
  EXPECT_NEAR(reserve(site, falls_at(6.4)).volume, 2.0 * sector_m2(site, 6.4), 0.1 * 2.0 * all);
}

TEST(FaceReserve, WhatLiesUnderTheFloorTakesNothingFromIt) {
  EXPECT_EQ(reserve(berm::app_bench::bench(), [](double, double) { return -3.0; }).volume, 0.0);
}

TEST(FaceReserve, IsInsideTheDigZoneOnly) {
  SiteModel site = berm::app_bench::bench();
  const double whole = reserve(site, level).volume;
  site.dig_zones[0].y_low = 0.0;
  EXPECT_NEAR(reserve(site, level).volume, 0.5 * whole, 0.05 * whole);
}

TEST(FaceReserve, TheCrestIsWhereTheGroundFallsOverTheSitesBearings) {
  const SiteModel site = berm::app_bench::bench();
  EXPECT_NEAR(reserve(site, falls_at(6.4)).crest, 6.4, 0.15);
  EXPECT_NEAR(reserve(site, [](double x, double y) { return std::hypot(x, y) < (y > 0.0 ? 6.8 : 5.8) ? 0.0 : -3.0; }).crest, 6.3, 0.2) << "the mean";
  EXPECT_NEAR(reserve(site, [](double x, double y) { return std::fabs(std::atan2(y, x)) < radians(21.0) && std::hypot(x, y) < 6.4 ? 0.0 : -3.0; }).crest, 6.4, 0.15)
      << "what is beside them does not count";
  EXPECT_NEAR(reserve(site, [](double x, double y) { return std::hypot(x, y) < 6.4 ? 0.0 : -0.4; }).crest, SurfaceProfile::last, 0.15) << "a step that is no face";
}

// The crest is to lie 0.9 m beyond where a drag ends.
TEST(BackDistance, BringsTheCrestALittleBeyondTheDragsEnd) {
  const SiteModel site = berm::app_bench::bench();
  const auto back = [&](double crest) { return back_distance(site, {10.0, crest}, 0.5, 6); };
  EXPECT_DOUBLE_EQ(back(site.dig_radius_end + 0.9 - 2.0), 2.0);
  EXPECT_DOUBLE_EQ(back(site.dig_radius_end + 0.9 - 1.3), 1.5) << "to the nearest step";
  EXPECT_DOUBLE_EQ(back(site.dig_radius_end + 0.9 - 1.2), 1.0);
}

TEST(BackDistance, IsOneStepAtLeastAndNoMoreThanCanBeSaid) {
  const SiteModel site = berm::app_bench::bench();
  EXPECT_DOUBLE_EQ(back_distance(site, {10.0, site.dig_radius_end + 2.0}, 0.5, 6), 0.5) << "nobody is called to move it nowhere, or ahead";
  EXPECT_DOUBLE_EQ(back_distance(site, {0.0, 0.0}, 0.5, 6), 3.0);
  EXPECT_DOUBLE_EQ(back_distance(site, {0.0, 0.0}, 0.25, 6), 1.5);
}

}  // namespace
