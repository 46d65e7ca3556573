// verifies the coarse dig planner: regions, their order, and why one is left.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app_bench/bench_machine.hpp"
#include "planning/dig_regions.hpp"

namespace {

using namespace berm::app;

const DigNeeds needs{1.1, 1.1, 1.0};

// The bench as a scanner over the cab sees it: the face beyond the crest stays hidden.
TerrainMap seen_bench() {
  TerrainMap map;
  for (double x = 3.0; x < 12.0; x += 0.1)
    for (double y = -5.0; y < 5.0; y += 0.1)
      if (x <= 6.0 || x >= 9.1) map.insert(x, y, x <= 6.0 ? 0.0 : -2.2, 1.0);
  return map;
}

void dig_out(TerrainMap& map, double bearing, double z) {
  const double c = std::cos(bearing), s = std::sin(bearing);
  for (double r = 4.6; r < 8.2; r += 0.1)
    for (double across = -0.9; across < 0.9; across += 0.1) map.insert(r * c - across * s, r * s + across * c, z, 50.0);
}

DigFloor floor_of(const SiteModel& site) { return {berm::app_bench::zx200(), site}; }

RegionDig next(const SiteModel& site, const TerrainMap& map, const DigRegion& last) {
  DigGround ground(site);
  ground.observe(map);
  return next_dig(berm::app_bench::zx200(), site, floor_of(site), ground, needs, last);
}

TEST(DigRegions, GoFromLeftToRightAndFromTheTopDown) {
  SiteModel site = berm::app_bench::bench();
  site.bench_height = 1.4;  // of 2.65 m
  const auto regions = dig_regions(berm::app_bench::zx200(), site, floor_of(site), needs);
  ASSERT_GE(regions.size(), 10u);
  EXPECT_EQ(regions[0].bench, 1);
  EXPECT_EQ(regions[0].bounds.bearing, site.dig_swing_left);
  EXPECT_NEAR(regions[0].bounds.floor, -2.65 / 2, 1e-9);
  for (std::size_t k = 1; k < 5; ++k) EXPECT_LT(regions[k].bounds.bearing, regions[k - 1].bounds.bearing);
  EXPECT_EQ(regions[5].bench, 2) << "the lower bench after all columns of the upper one";
  EXPECT_NEAR(regions[5].bounds.floor, -2.65, 1e-9);
  for (std::size_t k = 1; k < regions.size(); ++k) EXPECT_GE(regions[k].reach, regions[k - 1].reach);
}

TEST(DigRegions, ABenchIsNoHigherThanTheSiteWantsAndNoneLowerThanItsFloor) {
  SiteModel site = berm::app_bench::bench();
  for (const double height : {0.5, 0.9, 2.65, 9.0}) {
    site.bench_height = height;
    site.dig_floor = -2.0;
    double upper = 0.0;
    for (const DigRegion& region : dig_regions(berm::app_bench::zx200(), site, floor_of(site), needs)) {
      if (region.column == 4) {
        EXPECT_LE(region.bench == 1 ? -region.bounds.floor : upper - region.bounds.floor, height + 1e-9);
        upper = region.bounds.floor;
      }
      EXPECT_GE(region.bounds.floor, -2.0 - 1e-9);
    }
  }
}

TEST(DigRegions, TheUpperBenchIsDugFirstAndLeftWhenItYieldsTooLittle) {
  SiteModel site = berm::app_bench::bench();
  site.bench_height = 1.4;
  TerrainMap map = seen_bench();
  const DigNeeds little{0.4, 1.1, 1.0};
  const auto planned = [&](const TerrainMap& seen) {
    DigGround ground(site);
    ground.observe(seen);
    return next_dig(berm::app_bench::zx200(), site, floor_of(site), ground, little, {});
  };
  const RegionDig first = planned(map);
  EXPECT_EQ(first.region.bench, 1);
  EXPECT_EQ(first.left, 0);
  for (const DigWaypoint& w : first.plan.drag) EXPECT_GE(w.z, -2.65 / 2 - 1e-9);
  for (double b = site.dig_swing_right - 0.1; b < site.dig_swing_left + 0.1; b += 0.05) dig_out(map, b, -2.0);
  const RegionDig then = planned(map);
  EXPECT_EQ(then.region.bench, 2);
  EXPECT_EQ(then.left, 5) << "all columns of the bench over it";
}

TEST(DigRegions, AColumnThatIsDugOutIsPassedOver) {
  const SiteModel site = berm::app_bench::bench();
  TerrainMap map = seen_bench();
  const RegionDig first = next(site, map, {});
  EXPECT_EQ(first.region.reach, RegionReach::site);
  EXPECT_NEAR(first.plan.volume, needs.volume, 0.06);
  dig_out(map, first.region.bounds.bearing, -2.6);
  const RegionDig then = next(site, map, {});
  EXPECT_GT(std::fabs(then.region.bounds.bearing - first.region.bounds.bearing), radians(5.0));
  EXPECT_GT(then.left, 0);
}

// From the bed's far end back to a near dig, and the other way round.
TEST(DigRegions, AFarDumpIsFollowedByANearDig) {
  const SiteModel site = berm::app_bench::bench();
  DigGround ground(site);
  ground.observe(seen_bench());
  const auto bearing_after = [&](double dump_beyond) {
    DigNeeds after = needs;
    after.dump_beyond = dump_beyond;
    return next_dig(berm::app_bench::zx200(), site, floor_of(site), ground, after, {}).region.bounds.bearing;
  };
  EXPECT_NEAR(bearing_after(radians(10.0)), site.dig_swing_left, 1e-9);
  EXPECT_NEAR(bearing_after(radians(-10.0)), site.dig_swing_right, 1e-9);
}

TEST(DigRegions, WhatIsBesideIsDugWhenTheSitesBearingsAreDugOut) {
  const SiteModel site = berm::app_bench::bench();
  TerrainMap map = seen_bench();
  for (double b = site.dig_swing_right - 0.05; b < site.dig_swing_left + 0.05; b += 0.05) dig_out(map, b, -2.6);
  const RegionDig dig = next(site, map, {});
  EXPECT_NE(dig.region.reach, RegionReach::site);
  EXPECT_TRUE(dig.region.bounds.bearing > site.dig_swing_left || dig.region.bounds.bearing < site.dig_swing_right);
}

}  // namespace
