// verifies how deep digs are planned: all that the kernel checks of a slow drag stays over the dig zone's floor.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "app_bench/bench_machine.hpp"
#include "motion/arm_kinematics.hpp"
#include "motion/reach_preview.hpp"
#include "planning/dig_floor.hpp"
#include "planning/dig_point.hpp"
#include "planning/skyline.hpp"

namespace {

using namespace berm::app;

double zone_floor(const SiteModel& site) { return site.dig_zones.front().floor; }

// What would be checked of a bucket that stands there.
double box_floor(const MachineModel& machine, const Joints& pose) { return LowerEdge(machine, preview(machine, pose, {})).lowest(); }

TEST(DigFloor, WhereItIsLowestTheGuardLetsTheBucketTouchTheGround) {
  const MachineModel machine = berm::app_bench::zx200();
  const SiteModel site = berm::app_bench::bench();
  const DigFloor floor(machine, site);
  constexpr std::uint32_t seed = 20261127;
  std::mt19937 draw(seed);
  std::uniform_real_distribution<double> radius(5.0, 8.0), attitude(radians(-172.0), radians(-85.0));
  constexpr double spare = 0.3;  // m: what a drag needs beyond standing still, and the table's steps
  const Skyline skyline(machine, site, [&](double x, double y) { return in_dig_zone(site, x, y) ? 0.0 : -9.0; });  // soil everywhere about the bucket
  const auto held = [&](const Joints& standing) {
    const auto blocking = skyline.blocking(preview(machine, standing, {}));
    return blocking && blocking->of_ground();
  };
  int reached = 0, bound = 0, refused = 0;
  for (int i = 0; i < 500; ++i) {
    const double r = radius(draw), a = attitude(draw), z = floor.at(r, a);
    EXPECT_GE(z, site.dig_floor);
    const auto pose = pose_at(machine, {r, z, a});
    if (!pose) continue;
    ++reached;
    EXPECT_FALSE(held(*pose)) << "r " << r << " attitude " << degrees(a) << ", seed " << seed;
    EXPECT_GT(box_floor(machine, *pose), zone_floor(site) + Skyline::over_floor);
    const auto lower = pose_at(machine, {r, z - spare, a});
    refused += lower && z > site.dig_floor && held(*lower);
    bound += lower && z > site.dig_floor;
  }
  EXPECT_GT(reached, 200);
  EXPECT_GT(bound, 50);
  EXPECT_GE(refused, 8 * bound / 10) << "of " << bound << ": elsewhere soil is left that might be dug";
}

TEST(DigFloor, RisesAsTheBucketCurlsForItsShellLiesUnderTheTip) {
  SiteModel site = berm::app_bench::bench();
  site.dig_floor = -9.0;
  const DigFloor floor(berm::app_bench::zx200(), site);
  EXPECT_GT(floor.at(5.8, radians(-140.0)), floor.at(5.8, radians(-110.0)) + 0.05);
  EXPECT_GE(floor.at(5.8, radians(-180.0)), floor.at(5.8, radians(-140.0)));
  EXPECT_LT(floor.at(5.8, radians(-170.0)), zone_floor(site) + 1.1) << "so low the arm does not get to that attitude, and need not be so high for it";
  EXPECT_GT(floor.lowest(), zone_floor(site) + 0.3) << "the arm's angles are known to some degrees only";
  EXPECT_LT(floor.lowest(), zone_floor(site) + 0.75);
  EXPECT_LE(floor.lowest(), floor.at(7.0, radians(-92.0)));
}

TEST(DigFloor, TheSitesFloorOfTheDigsHoldsWhereItIsHigher) {
  SiteModel site = berm::app_bench::bench();
  site.dig_floor = -1.5;
  const DigFloor floor(berm::app_bench::zx200(), site);
  EXPECT_EQ(floor.lowest(), -1.5);
  EXPECT_EQ(floor.at(6.0, radians(-150.0)), -1.5);
}

// A drag along the floor that ended below what the kernel allows was stopped there with an empty bucket, again and again.
TEST(DigFloor, ADragAlongTheFloorIsOneThatTheGuardPermits) {
  const MachineModel machine = berm::app_bench::zx200();
  const SiteModel site = berm::app_bench::bench();
  TerrainMap map;  // dug out down to the floor but for the last of the face
  for (double x = 3.0; x < 12.0; x += 0.1)
    for (double y = -5.0; y < 5.0; y += 0.1) map.insert(x, y, x <= 5.4 ? 0.0 : x <= 6.0 ? -0.5 : -2.6, 1.0);
  DigGround ground(site);
  ground.observe(map);
  const DigPlan plan = plan_dig(machine, site, DigFloor(machine, site), ground, {1.1, 1.1, 1.0}, {0.0, site.dig_floor, 5.6});
  const auto path = DigPath::solve(machine, plan.drag);
  ASSERT_TRUE(path);
  for (double s = 0.0; s <= path->length(); s += 0.05)
    EXPECT_GT(box_floor(machine, path->at(s)), zone_floor(site) + Skyline::over_floor) << "after " << s << " of " << path->length() << " m";
}

// Where the face is small all of its soil is wanted, down to the floor of the digs; elsewhere a drag may end so far over it.
TEST(DigFloor, TheShippedSitesZonesAreDeepEnoughForTheirDigs) {
  struct Pair { const char *site, *machine; double over; };
  for (const Pair& pair : {Pair{"measured", "zx200", 0.0}, {"measured_shift", "zx200", 0.0}, {"bench", "zx200", 0.5}, {"bench_small", "zx200", 0.5}, {"shift", "zx200", 0.5},
                           {"two_benches", "zx200", 0.5}, {"bench_12t", "excavator_12t", 0.5}, {"bench_25t", "excavator_25t", 0.5}}) {
    const MachineModel machine = berm::app_bench::shipped_machine(pair.machine);
    const SiteModel site = berm::app_bench::shipped_site(pair.site);
    const double bearing = 0.5 * (site.dig_swing_left + site.dig_swing_right);
    TerrainMap map;  // flat, a little over the floor of the digs
    for (double r = 3.0; r < 11.0; r += 0.1)
      for (double across = -1.0; across <= 1.0; across += 0.1)
        map.insert(r * std::cos(bearing) - across * std::sin(bearing), r * std::sin(bearing) + across * std::cos(bearing), site.dig_floor + 0.05, 1.0);
    DigGround ground(site);
    ground.observe(map);
    const DigPlan plan = plan_dig(machine, site, DigFloor(machine, site), ground, {1.1, bucket_width(machine), 1.0}, {bearing, site.dig_floor, site.dig_radius_end});
    for (std::size_t i = 2; i + 2 < plan.drag.size(); ++i) {
      EXPECT_GE(plan.drag[i].z, site.dig_floor - 1e-9);
      EXPECT_LE(plan.drag[i].z, site.dig_floor + 0.051 + pair.over) << pair.site << " at r " << plan.drag[i].r;
    }
  }
}

}  // namespace
