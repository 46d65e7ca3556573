// verifies the shape that digs are to leave: what counts where, and that benches, drags and the face's reserve keep to it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app_bench/bench_machine.hpp"
#include "planning/cut_model.hpp"
#include "planning/dig_regions.hpp"
#include "planning/face_reserve.hpp"
#include "planning/goal_shape.hpp"

namespace {

using namespace berm::app;

constexpr double width = 1.1;
const DigNeeds needs{0.8, width, 1.0};

SiteModel site_with(std::vector<GoalPart> goal) {
  SiteModel site = berm::app_bench::bench();
  site.goal = std::move(goal);
  return site;
}

// A face that falls from 6 m on, all round.
DigGround face(const SiteModel& site) {
  TerrainMap map;
  for (double x = 0.0; x < 12.0; x += 0.05)
    for (double y = -8.0; y < 8.0; y += 0.05) map.insert(x, y, std::clamp(-1.5 * (std::hypot(x, y) - 6.0), -2.65, 0.0), 1.0);
  DigGround ground(site);
  ground.observe(map);
  return ground;
}

TEST(GoalShape, OfSeveralPartsTheLaterOneCountsAndAPartMaySlope) {
  const SiteModel site = site_with({{4.0, -2.0, 9.0, 2.0, -1.0}, {6.0, -2.0, 8.0, 2.0, -2.0, 0.1, -0.2}});
  EXPECT_EQ(goal_part_height(site, 5.0, 1.0), -1.0);
  EXPECT_NEAR(goal_part_height(site, 7.0, 0.0), -2.0, 1e-12);
  EXPECT_NEAR(goal_part_height(site, 8.0, 1.0), -2.0 + 0.1 - 0.2, 1e-12);
  EXPECT_TRUE(std::isinf(goal_part_height(site, 9.5, 0.0)));
}

TEST(GoalShape, AlongABearingTheHighestOverTheBucketsWidthCounts) {
  const MachineModel machine = berm::app_bench::zx200();
  const SiteModel site = site_with({{4.0, 0.4, 9.0, 3.0, -1.0}});
  EXPECT_EQ(GoalProfile(machine, site, 0.0, width).at(6.0), -1.0) << "its edge is 0.15 m inside the bucket's";
  EXPECT_TRUE(std::isinf(GoalProfile(machine, site, 0.0, 0.7).at(6.0)));
  EXPECT_TRUE(std::isinf(GoalProfile(machine, berm::app_bench::bench(), 0.0, width).at(6.0)));
  EXPECT_EQ(GoalProfile(machine, site, 0.0, width).lowest(5.6, 7.4, -2.65), -1.0);
  EXPECT_EQ(GoalProfile(machine, site, 0.0, width).lowest(5.6, 9.5, -2.65), -2.65);
}

// The curled bucket's shell lies under its tip.
TEST(GoalShape, NoDragBringsTheShellUnderIt) {
  const MachineModel machine = berm::app_bench::zx200();
  SiteModel site = site_with({{4.0, -3.0, 6.7, 3.0, -0.8}, {6.7, -3.0, 10.0, 3.0, -1.3}});
  const DigFloor floor(machine, site);
  const DigGround ground = face(site);
  const BucketShell shell(machine);
  double cut = 0.0, nearest = 9.0;
  for (const double start : {7.4, 7.0}) {
    site.dig_radius_start = start;
    const DigPlan plan = plan_dig(machine, site, floor, ground, {2.0, width, 1.0}, {0.0, -2.65, 5.6});
    const auto path = DigPath::solve(machine, plan.drag);
    ASSERT_TRUE(path);
    cut += plan.volume;
    for (double s = 0.0; s <= path->length(); s += 0.05) {
      const ArmPoints arm = forward(machine, path->at(s));
      for (const auto& [along, across] : shell.points()) {
        const double r = arm.bucket_pin.r + along * std::cos(arm.bucket_attitude) - across * std::sin(arm.bucket_attitude);
        const double over = arm.bucket_pin.z + along * std::sin(arm.bucket_attitude) + across * std::cos(arm.bucket_attitude) - goal_part_height(site, r, 0.0);
        nearest = std::min(nearest, over);
      }
    }
  }
  EXPECT_GT(cut, 0.3) << "nothing is cut: the test shows nothing";
  EXPECT_GT(nearest, -0.06) << "but for the step, over which a path goes in straight lines";
  EXPECT_LT(nearest, 0.1);
}

TEST(GoalShape, AColumnIsDugBenchByBenchDownToItsGoal) {
  SiteModel site = site_with({{4.0, -5.0, 11.0, -0.6, -1.0}});  // on the right
  site.bench_height = 1.4;  // of 2.65 m
  const MachineModel machine = berm::app_bench::zx200();
  const DigFloor floor(machine, site);
  int right = 0, left = 0;
  for (const DigRegion& region : dig_regions(machine, site, floor, needs)) {
    const bool of_goal = region.bounds.bearing < radians(-11.0);
    EXPECT_FALSE(of_goal && region.bench > 1) << "under the goal";
    right += of_goal && region.bench == 1 && std::fabs(region.bounds.floor + 1.0) < 1e-9;
    left += region.bounds.bearing > radians(5.0) && region.bench == 2 && std::fabs(region.bounds.floor + 2.65) < 1e-9;
  }
  EXPECT_GE(right, 1);
  EXPECT_GE(left, 1);
}

TEST(GoalShape, WhatLiesUnderItIsNoReserve) {
  const SiteModel bare = berm::app_bench::bench(), half = site_with({{0.0, 0.0, 12.0, 8.0, 0.0}});
  const DigGround ground = face(bare);
  const double all = face_reserve(bare, ground, -2.65, width).volume;
  ASSERT_GT(all, 2.0);
  EXPECT_NEAR(face_reserve(half, ground, -2.65, width).volume, 0.5 * all, 0.06 * all);
}

}  // namespace
