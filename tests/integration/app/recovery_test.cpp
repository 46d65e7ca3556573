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
  o.angle = {radians(60.0), radians(30.0), radians(-90.0), radians(-100.0)};
  o.blocked_bearing = radians(75.0);
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
  Observation o = stopped(12.0, BERM_STOP_NONE);
  o.kernel_state = BERM_STATE_RUN;
  const auto advice = recovery.step(o, log);
  EXPECT_FALSE(advice.in_charge);
  EXPECT_TRUE(advice.resumed);
  EXPECT_TRUE(advice.moved);
  EXPECT_FALSE(recovery.step(o, log).resumed);
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
  Observation o = stopped(91.0, BERM_STOP_NONE);
  o.kernel_state = BERM_STATE_RUN;
  EXPECT_FALSE(recovery.step(o, log).operator_called);
  calls = 0;
  for (int k = 0; k < 4000; ++k) calls += recovery.step(stopped(100.0 + 0.01 * k, BERM_STOP_STALE_GROUND), log).operator_called;
  EXPECT_EQ(calls, 1) << "each stop has its own";
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
