// When the operator is called while the kernel does not permit motion, and what he is told.
#include <gtest/gtest.h>

#include <vector>

#include "app/recovery.hpp"
#include "app/restart_call.hpp"
#include "app_bench/bench_machine.hpp"
#include "app_bench/events.hpp"
#include "recovery_observations.hpp"

namespace {

using namespace berm::app;
using namespace berm::app_bench;

// A run switch that was left on through a reset starts nothing: who waits for that waits for ever if he is not told.
TEST(RestartCall, TellsWhoLeftTheRunSwitchOnOnceEachTime) {
  RestartCall call;
  const Events events;
  const ProgressLog log(events.fd());
  const auto for_seconds = [&](double from, double to, bool awaited, bool on) {
    for (double t = from; t < to; t += 0.1) {
      Observation o = stopped(t, BERM_STOP_NONE);
      o.kernel_state = BERM_STATE_STANDBY;
      o.release_awaited = awaited;
      o.run_switch = on;
      call.step(o, log);
    }
    return events.named("operator_needed").size();
  };
  EXPECT_EQ(for_seconds(0.0, 60.0, true, false), 0u) << "nobody wants it to run";
  EXPECT_EQ(for_seconds(60.0, 62.0, true, true), 0u) << "he may have his hand at the switch";
  EXPECT_EQ(for_seconds(62.0, 200.0, true, true), 1u);
  EXPECT_EQ(for_seconds(200.0, 201.0, false, false), 1u);
  EXPECT_EQ(for_seconds(201.0, 300.0, false, true), 1u);
  EXPECT_EQ(for_seconds(300.0, 310.0, true, true), 2u) << "after another reset";
  EXPECT_EQ(events.named("operator_needed")[0].at("advice"), "look whether the machine may start, then switch run off and on again");
}

TEST(RecoveryCalls, CallsTheOperatorForABlockedSensorAtOnce) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  Observation o = stopped(0.0, BERM_STOP_SENSOR_BLOCKED);
  o.latched = true;
  const auto advice = recovery.step(o, log);
  EXPECT_TRUE(advice.operator_called);
  EXPECT_EQ(advice.velocity, Joints{});
}

// What was seen before a stop that latches is too old by the reset, and the plan would creep over it from stop to stop.
TEST(RecoveryCalls, LooksOnUntilTheResetUnlessTheMapIsVoidOrSomebodyIsAtTheSensors) {
  const auto looks = [](std::uint8_t reason) {
    Recovery recovery(berm::app_bench::zx200());
    const ProgressLog log(-1);
    int rescans = 0;
    for (double t = 0.0; t < 20.0; t += 0.1) {
      Observation o = stopped(t, reason);
      o.latched = true;
      const auto advice = recovery.step(o, log);
      EXPECT_EQ(advice.velocity, Joints{});
      rescans += advice.rescan;
    }
    return rescans;
  };
  for (const std::uint8_t reason : {BERM_STOP_OPERATOR, BERM_STOP_CLOCK, BERM_STOP_EMERGENCY}) EXPECT_EQ(looks(reason), 4) << int{reason};
  for (const std::uint8_t reason : {BERM_STOP_SENSOR_BLOCKED, BERM_STOP_SCANNER_SILENT, BERM_STOP_BASE_MOVED}) EXPECT_EQ(looks(reason), 0) << int{reason};
}

// A window that is half covered is judged blocked and well by turns: he is told of it once, by name, and of another that follows.
TEST(RecoveryCalls, TellsOfABlockedSensorOnceThoughItIsJudgedWellByTurns) {
  Recovery recovery(berm::app_bench::zx200());
  const Events events;
  const ProgressLog log(events.fd());
  const auto stands = [&](double from, double to, std::uint32_t eyes) {
    for (double t = from; t < to; t += 0.1) {
      Observation o = stopped(t, BERM_STOP_SENSOR_BLOCKED);
      o.kernel_state = t < 0.3 ? BERM_STATE_STOPPING : BERM_STATE_FAULT;
      o.latched = t >= 0.3;
      o.blocked_eyes = eyes;
      recovery.step(o, log);
    }
  };
  stands(0.0, 0.15, BERM_SIGHT_BLOCKED(4));
  stands(0.2, 0.95, 0);
  stands(1.0, 1.95, BERM_SIGHT_BLOCKED(4));
  stands(2.0, 4.0, 0);
  ASSERT_EQ(events.named("operator_needed").size(), 1U);
  EXPECT_EQ(events.named("operator_needed")[0].at("advice").get<std::string>().rfind("lidar 3: look", 0), 0U);
  stands(4.0, 8.0, BERM_SIGHT_BLOCKED(0));
  ASSERT_EQ(events.named("operator_needed").size(), 2U);
  EXPECT_EQ(events.named("operator_needed")[1].at("advice").get<std::string>().rfind("left scanner, lidar 3: look", 0), 0U);
}

// A reset that is followed by another trouble: he is told of that too.
TEST(RecoveryCalls, CallsAgainWhenTheGroundKeepsWhatWasReset) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  int calls = 0;
  double last = 0.0;
  for (double t = 0.0; t < 120.0; t += 0.1) {
    Observation o = stopped(t, t < 10.0 ? BERM_STOP_OPERATOR : BERM_STOP_UNKNOWN_GROUND);
    if (t >= 10.0) o.kernel_state = BERM_STATE_STANDBY;
    if (!recovery.step(o, log).operator_called) continue;
    ++calls;
    last = t;
  }
  EXPECT_EQ(calls, 2);
  EXPECT_NEAR(last, 40.0, 0.5) << "after looking and creeping did not help";
}

// Dust settles, and what keeps the machine then is something else: he waits for ever if he is told of the dust alone. But what dust showed or hid is
// given as long as any other to end by itself.
TEST(RecoveryCalls, CallsAgainWhenAnotherThingKeepsTheMachine) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  std::vector<double> calls;
  const auto for_seconds = [&](double from, double to, std::uint8_t reason, bool latched = false) {
    for (double t = from; t < to; t += 0.1) {
      Observation o = stopped(t, reason);
      o.latched = latched;
      o.held_by_dust = t < 50.0 || reason == BERM_STOP_DUST;
      if (recovery.step(o, log).operator_called) calls.push_back(t);
    }
  };
  for_seconds(0.0, 42.0, BERM_STOP_DUST);
  for_seconds(42.0, 95.0, BERM_STOP_INTRUDER);  // dust holds it for another 8 s
  for_seconds(95.0, 100.0, BERM_STOP_DUST);
  for_seconds(100.0, 110.0, BERM_STOP_SENSOR_BLOCKED, true);
  ASSERT_EQ(calls.size(), 3U) << "each once";
  EXPECT_NEAR(calls[0], 30.0, 0.2);
  EXPECT_NEAR(calls[1], 88.0, 0.2) << "38 s after the dust";
  EXPECT_NEAR(calls[2], 100.0, 0.2) << "it latches: at once";
}

// Somebody stood there for 29 s: what he left unseen is given as long as any other ground, before a person is told to clear it.
TEST(RecoveryCalls, GroundThatKeepsItAfterSomebodyHasItsOwnTime) {
  for (const std::uint8_t who : {BERM_STOP_INTRUDER, BERM_STOP_SEPARATION}) {
    Recovery recovery(berm::app_bench::zx200());
    const ProgressLog log(-1);
    std::vector<double> calls;
    for (double t = 0.0; t < 100.0; t += 0.1)
      if (recovery.step(stopped(t, t < 29.0 ? who : std::uint8_t{BERM_STOP_STALE_GROUND}), log).operator_called) calls.push_back(t);
    ASSERT_EQ(calls.size(), 1U);
    EXPECT_NEAR(calls[0], 59.0, 0.2);
  }
}

// Dust makes intruders of itself. A person who presses relearn for one has an empty map, which fills only when the dust has settled.
TEST(RecoveryCalls, InDustNobodyIsToldToSendSomebodyAwayOrToRelearn) {
  Recovery recovery(berm::app_bench::zx200());
  const berm::app_bench::Events events;
  const ProgressLog log(events.fd());
  for (double t = 0.0; t < 70.0; t += 0.1) {
    Observation o = stopped(t, t < 13.0 ? BERM_STOP_DUST : BERM_STOP_INTRUDER);
    o.held_by_dust = true;
    o.blocked_x = o.blocked_y = 3.0;
    recovery.step(o, log);
  }
  const auto calls = events.named("operator_needed");
  ASSERT_EQ(calls.size(), 1U);
  EXPECT_EQ(calls[0].at("reason"), "dust");
  EXPECT_FALSE(calls[0].contains("x_m"));
  EXPECT_EQ(calls[0].at("advice").get<std::string>().find("relearn"), std::string::npos);
}

// No dead end without a word.
TEST(RecoveryCalls, CallsTheOperatorWhenLookingAndCreepingDoNotHelp) {
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

}  // namespace
