// What the app does while the kernel does not permit motion.
#include <gtest/gtest.h>

#include "app/recovery.hpp"
#include "app_bench/bench_machine.hpp"

namespace {

using namespace berm::app;

Observation stopped(double time_s, std::uint8_t reason) {
  Observation o;
  o.time_s = time_s;
  o.kernel_state = BERM_STATE_STOPPED;
  o.stop_reason = reason;
  o.latched = reason == BERM_STOP_OPERATOR;
  o.angle = {radians(60.0), radians(30.0), radians(-90.0), radians(-100.0)};
  o.blocked_bearing = radians(75.0);
  return o;
}

Observation permitted(double time_s) {
  Observation o = stopped(time_s, BERM_STOP_NONE);
  o.kernel_state = BERM_STATE_RUN;
  return o;
}

TEST(Recovery, HoldsLooksAgainThenRetreatsAtCreepSpeed) {
  const MachineModel m = berm::app_bench::zx200();
  Recovery recovery(m);
  const ProgressLog log(-1);
  int rescans = 0;
  bool raised = false, swung_away = false;
  for (int k = 0; k < 1200; ++k) {
    const double t = 0.01 * k;
    const auto advice = recovery.step(stopped(t, BERM_STOP_COLLISION_PREDICTED), log);
    ASSERT_TRUE(advice.in_charge);
    rescans += advice.rescan;
    for (std::size_t j = 0; j < joints; ++j) {
      ASSERT_LE(std::fabs(advice.velocity[j]), m.joint[j].creep_velocity);
      if (t < 2.0) {
        ASSERT_EQ(advice.velocity[j], 0.0);
      }
    }
    raised = raised || advice.velocity[boom] > 0.0;
    swung_away = swung_away || advice.velocity[swing] < 0.0;
    ASSERT_LE(advice.velocity[swing], 0.0) << "toward what blocks";
  }
  EXPECT_EQ(rescans, 2);  // after 0.5 s, and again 6 s later
  EXPECT_TRUE(raised);
  EXPECT_TRUE(swung_away);
  auto advice = recovery.step(permitted(12.0), log);
  EXPECT_TRUE(advice.in_charge) << "a retreat that is permitted is used, not given up at once";
  EXPECT_LT(advice.velocity[bucket], 0.0);
  EXPECT_TRUE(recovery.step(permitted(12.9), log).in_charge);
  advice = recovery.step(permitted(13.1), log);
  EXPECT_FALSE(advice.in_charge);
  EXPECT_TRUE(advice.resumed);
  EXPECT_TRUE(advice.moved);
  EXPECT_FALSE(recovery.step(permitted(13.2), log).resumed);
}

// Standing is permitted, moving is not: no more than a few attempts, and in the end the operator.
TEST(Recovery, AttemptsThatFailAtOnceFollowAtGrowingPauses) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  int attempts = 0, calls = 0;
  bool stops = true;
  double moving_since = -1.0;
  for (int k = 0; k < 6000; ++k) {
    const double t = 0.01 * k;
    const auto advice = recovery.step(stops ? stopped(t, BERM_STOP_COLLISION_PREDICTED) : permitted(t), log);
    attempts += advice.resumed;
    calls += advice.operator_called;
    if (advice.resumed) moving_since = t;
    ASSERT_EQ(advice.velocity, Joints{}) << "nothing to retreat from where standing is permitted";
    if (!stops && !advice.in_charge && t - moving_since > 0.3) stops = true;  // the plan's motion is stopped after 0.3 s
    else if (stops && k % 30 == 29) stops = false;                           // to stand is permitted
  }
  EXPECT_GE(attempts, 8);
  EXPECT_LE(attempts, 25) << "three a second would be 180";
  EXPECT_EQ(calls, 1) << "short attempts do not put off the call";
}

// What may not be passed over is ground like any other: looked at again, crept away from.
TEST(Recovery, GoesRoundWhatMayNotBePassedOver) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  int rescans = 0, calls = 0;
  bool swung_away = false;
  for (int k = 0; k < 4000; ++k) {
    const auto advice = recovery.step(stopped(0.01 * k, BERM_STOP_OVERPASS), log);
    rescans += advice.rescan;
    calls += advice.operator_called;
    swung_away = swung_away || advice.velocity[swing] < 0.0;
    ASSERT_LE(advice.velocity[swing], 0.0) << "toward what blocks";
  }
  EXPECT_GE(rescans, 5);
  EXPECT_TRUE(swung_away);
  EXPECT_EQ(calls, 1);
}

TEST(Recovery, AfterGoodMotionAStopIsANewOne) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  for (int n = 0; n < 5; ++n) {
    const double t = 10.0 * n;
    recovery.step(stopped(t, BERM_STOP_STALE_GROUND), log);
    EXPECT_TRUE(recovery.step(permitted(t + 0.5), log).resumed) << "without a pause";
    EXPECT_FALSE(recovery.step(permitted(t + 9.9), log).in_charge);
  }
}

TEST(Recovery, WaitsForTheOperator) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  for (int k = 0; k < 3000; ++k) {
    const auto advice = recovery.step(stopped(0.01 * k, BERM_STOP_OPERATOR), log);
    ASSERT_TRUE(advice.in_charge);
    ASSERT_EQ(advice.operator_called, k == 0) << "at once, for nothing else can help; and once";
    for (const double v : advice.velocity) ASSERT_EQ(v, 0.0);
  }
}

// No dead end without a word.
TEST(Recovery, CallsTheOperatorWhenLookingAndCreepingDoNotHelp) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  int calls = 0;
  for (int k = 0; k < 9000; ++k) {
    const auto advice = recovery.step(stopped(0.01 * k, BERM_STOP_COLLISION_PREDICTED), log);
    calls += advice.operator_called;
    ASSERT_TRUE(calls == 0 || 0.01 * k > 29.9);
  }
  EXPECT_EQ(calls, 1);
  for (const double t : {90.0, 91.1, 95.0}) EXPECT_FALSE(recovery.step(permitted(t), log).operator_called);
  calls = 0;
  for (int k = 0; k < 4000; ++k) calls += recovery.step(stopped(100.0 + 0.01 * k, BERM_STOP_STALE_GROUND), log).operator_called;
  EXPECT_EQ(calls, 1) << "each trouble has its own";
}

TEST(Recovery, ComesBackIntoTheJointsRange) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  Observation o = stopped(0.0, BERM_STOP_JOINT_RANGE);
  o.angle[bucket] = radians(-135.0);
  Recovery::Advice advice;
  for (int k = 0; k < 300; ++k) {
    o.time_s = 0.01 * k;
    advice = recovery.step(o, log);
  }
  EXPECT_GT(advice.velocity[bucket], 0.0);
  EXPECT_EQ(advice.velocity[swing], 0.0);
}

}  // namespace
