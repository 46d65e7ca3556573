// How a bucket is poured while every joint keeps to a tenth of its speed.
#include <gtest/gtest.h>

#include "app/slow_pour.hpp"
#include "app_bench/bench_machine.hpp"

namespace {

using namespace berm::app;

// The swing turns by the angle at its share, the bucket opens at the same share of its own speed meanwhile.
TEST(SlowPour, WhatRunsOutOnTheWayBackGrowsWithTheWayAndWithTheBucketsSpeed) {
  MachineModel machine = berm::app_bench::zx200();
  EXPECT_EQ(share_run_out_over(machine, 0.0), 0.0);
  const double ten = share_run_out_over(machine, radians(10.0));
  EXPECT_NEAR(share_run_out_over(machine, radians(20.0)), 2.0 * ten, 1e-9);
  EXPECT_LT(ten, machine.joint[bucket].velocity_max / machine.joint[swing].velocity_max * 10.0 / 115.0) << "with something to spare";
  EXPECT_GT(ten, 0.05);
  machine.joint[bucket].velocity_max *= 2.0;
  EXPECT_NEAR(share_run_out_over(machine, radians(10.0)), 2.0 * ten, 1e-9);
  EXPECT_EQ(share_run_out_over(machine, radians(360.0)), 1.0);
}

// As seen in a shift's trace: the swing stands over the dump point, the arm has 11 degrees to go yet.
TEST(SlowPour, ALipThatStillComesOverTheBedIsWaitedForAndNothingElse) {
  const Joints goals{radians(104.0), radians(34.0), radians(-65.2), radians(-20.0)}, angle{radians(104.1), radians(37.2), radians(-76.7), radians(-124.0)};
  const Joints comes{0.0, radians(-2.5), radians(6.2), radians(6.2)};
  EXPECT_TRUE(lip_still_comes(1.0, goals, angle, comes));
  EXPECT_TRUE(lip_still_comes(0.17, goals, angle, comes));
  EXPECT_FALSE(lip_still_comes(0.0, goals, angle, comes)) << "it is over the bed";
  EXPECT_FALSE(lip_still_comes(1.0, goals, angle, {0.0, 0.0, 0.0, radians(6.2)})) << "nothing moves that would bring it there: no dead end";
  EXPECT_FALSE(lip_still_comes(1.0, goals, angle, {0.0, radians(2.5), radians(-6.2), 0.0})) << "it goes away";
  EXPECT_FALSE(lip_still_comes(1.0, goals, {goals[swing], goals[boom], goals[stick] - radians(1.0), 0.0}, comes)) << "it is there, beside the bed or not";
  EXPECT_TRUE(lip_still_comes(1.0, goals, {goals[swing] - radians(5.0), goals[boom], goals[stick], 0.0}, {radians(5.0), 0.0, 0.0, 0.0})) << "the swing brings it";
  // A truck on the right.
  EXPECT_TRUE(lip_still_comes(1.0, {-goals[swing], goals[boom], goals[stick], 0.0}, {radians(-99.0), goals[boom], goals[stick], 0.0}, {radians(-5.0), 0.0, 0.0, 0.0}));
}

}  // namespace
