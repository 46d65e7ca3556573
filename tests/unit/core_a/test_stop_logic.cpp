// A day of work, told as a story; the whole of the state machine is enumerated in tests/exhaustive/core_a.
#include <gtest/gtest.h>

#include "core/stop_logic.h"

namespace {

class StopLogic : public testing::Test {
 protected:
  void SetUp() override {
    sk_stop_init(&s);
    in.inputs_ready = true;
    in.standstill = true;
    in.operator_run = true;
  }
  std::uint16_t step() {
    in.now_us += 10'000;
    sk_stop_step(&s, &in, &out);
    return s.code;
  }
  std::uint16_t step_switched_off() {
    in.operator_run = false;
    in.operator_run_off = true;
    const std::uint16_t code = step();
    in.operator_run = true;
    in.operator_run_off = false;
    return code;
  }
  void start() {
    ASSERT_EQ(step(), SK_STATE_STANDBY);
    ASSERT_EQ(step_switched_off(), SK_STATE_STANDBY);
    ASSERT_EQ(step(), SK_STATE_RUN);
    in.standstill = false;
  }
  sk_stop_state s{};
  sk_stop_input in{};
  sk_stop_output out{};
};

// verifies: SK-ST-4, SK-ST-5, SK-ST-1
TEST_F(StopLogic, Starts) {
  in.inputs_ready = false;
  EXPECT_EQ(step(), SK_STATE_INIT);
  in.inputs_ready = true;
  EXPECT_EQ(step(), SK_STATE_STANDBY);
  EXPECT_FALSE(out.motion_enabled);
  EXPECT_FALSE(out.heartbeat_enable);
  EXPECT_EQ(step_switched_off(), SK_STATE_STANDBY);
  EXPECT_EQ(step(), SK_STATE_RUN);
  EXPECT_TRUE(out.motion_enabled);
  EXPECT_TRUE(out.heartbeat_enable);
}

// verifies: SK-ST-5
TEST_F(StopLogic, DoesNotBeginInNoise) {
  ASSERT_EQ(step(), SK_STATE_STANDBY);
  ASSERT_EQ(step_switched_off(), SK_STATE_STANDBY);
  for (int cycle = 0; cycle < 250; ++cycle) {
    in.hold_reason = cycle % 29 == 0 ? BERM_STOP_UNKNOWN_GROUND : 0;
    ASSERT_EQ(step(), SK_STATE_STANDBY) << "cycle " << cycle;
  }
  in.hold_reason = BERM_STOP_UNKNOWN_GROUND;
  step();
  in.hold_reason = 0;
  for (int cycle = 1; cycle < 30; ++cycle) ASSERT_EQ(step(), SK_STATE_STANDBY) << "cycle " << cycle;
  EXPECT_EQ(step(), SK_STATE_RUN);
}

// verifies: SK-ST-5, SK-ST-13
TEST_F(StopLogic, ASwitchTurnedOffAndOnDoesNotCutTheWaitShort) {
  start();
  in.standstill = true;
  in.hold_reason = BERM_STOP_STALE_GROUND;
  step();
  ASSERT_EQ(step(), SK_STATE_STOPPED);
  in.hold_reason = 0;
  ASSERT_EQ(step_switched_off(), SK_STATE_STANDBY);
  for (int cycle = 2; cycle < 30; ++cycle) ASSERT_EQ(step(), SK_STATE_STANDBY) << "cycle " << cycle;
  EXPECT_EQ(step(), SK_STATE_RUN);
}

// verifies: SK-ST-10, SK-ST-11, SK-ST-13, SK-ST-32
TEST_F(StopLogic, AHoldResumesByItself) {
  start();
  in.hold_reason = BERM_STOP_COLLISION_PREDICTED;
  EXPECT_EQ(step(), SK_STATE_STOPPING);
  EXPECT_EQ(s.category, SK_CATEGORY_HELD);
  EXPECT_TRUE(out.heartbeat_enable);
  EXPECT_FALSE(out.motion_enabled);
  in.standstill = true;
  EXPECT_EQ(step(), SK_STATE_STOPPED);
  EXPECT_EQ(step(), SK_STATE_STOPPED);
  EXPECT_TRUE(out.heartbeat_enable);
  in.hold_reason = 0;
  const std::int64_t seen = in.now_us;
  while (in.now_us + 10'000 < seen + SK_RESUME_QUIET_US) ASSERT_EQ(step(), SK_STATE_STOPPED);
  EXPECT_EQ(s.reason, BERM_STOP_COLLISION_PREDICTED);
  EXPECT_EQ(step(), SK_STATE_RUN);
  EXPECT_EQ(s.reason, BERM_STOP_NONE);
}

// verifies: SK-ST-13
TEST_F(StopLogic, AHoldInNoiseIsOneStop) {
  start();
  in.standstill = true;
  int starts = 0;
  for (int cycle = 0; cycle < 250; ++cycle) {
    in.hold_reason = cycle % 5 < 2 ? BERM_STOP_UNKNOWN_GROUND : 0;
    const bool ran = s.code == SK_STATE_RUN;
    step();
    starts += !ran && s.code == SK_STATE_RUN;
  }
  EXPECT_EQ(starts, 0);
  in.hold_reason = 0;
  for (int cycle = 0; cycle < 30; ++cycle) step();
  EXPECT_EQ(s.code, SK_STATE_RUN);
}

// verifies: SK-ST-10, SK-ST-11, SK-ST-30
TEST_F(StopLogic, TheRunSwitchPauses) {
  start();
  in.operator_run = false;
  EXPECT_EQ(step(), SK_STATE_STOPPING);
  EXPECT_EQ(s.reason, BERM_STOP_NONE);
  EXPECT_TRUE(out.heartbeat_enable);
  in.operator_run = true;
  EXPECT_EQ(step(), SK_STATE_STOPPING) << "not before standstill";
  in.standstill = true;
  EXPECT_EQ(step(), SK_STATE_STANDBY);
  EXPECT_FALSE(s.latched);
  EXPECT_EQ(step(), SK_STATE_RUN);
}

// verifies: SK-ST-22
TEST_F(StopLogic, ALatchNeedsAFreshReset) {
  start();
  in.operator_reset = true;  // held down since before the stop
  in.latch_reason = BERM_STOP_OPERATOR;
  EXPECT_EQ(step(), SK_STATE_STOPPING);
  in.latch_reason = 0;
  in.standstill = true;
  for (int k = 0; k < 5; ++k) EXPECT_EQ(step(), SK_STATE_STOPPED);
  EXPECT_FALSE(out.heartbeat_enable);
  in.operator_reset = false;
  EXPECT_EQ(step(), SK_STATE_STOPPED);
  in.operator_reset = true;
  in.hold_reason = BERM_STOP_REQUEST_HOLD;
  EXPECT_EQ(step(), SK_STATE_STOPPED) << "a reason holds";
  in.hold_reason = 0;
  in.standstill = false;
  EXPECT_EQ(step(), SK_STATE_STOPPED) << "not at standstill";
  in.standstill = true;
  EXPECT_EQ(step(), SK_STATE_STANDBY);
  EXPECT_FALSE(out.motion_enabled);
}

// verifies: SK-ST-6
TEST_F(StopLogic, ARunSwitchThatWasLeftOnStartsNothing) {
  in.inputs_ready = false;
  EXPECT_EQ(step_switched_off(), SK_STATE_INIT);
  in.inputs_ready = true;
  EXPECT_EQ(step_switched_off(), SK_STATE_STANDBY) << "and that was still INIT";
  for (int k = 0; k < 5; ++k) EXPECT_EQ(step(), SK_STATE_STANDBY);
  in.operator_run = false;
  for (int k = 0; k < 5; ++k) EXPECT_EQ(step(), SK_STATE_STANDBY) << "not heard is not off";
  in.operator_run = true;
  EXPECT_EQ(step(), SK_STATE_STANDBY);
  in.hold_reason = BERM_STOP_UNKNOWN_GROUND;
  EXPECT_EQ(step_switched_off(), SK_STATE_STANDBY);
  EXPECT_EQ(step(), SK_STATE_STANDBY);
  in.hold_reason = 0;
  in.now_us += SK_RESUME_QUIET_US;
  EXPECT_EQ(step(), SK_STATE_RUN) << "what held meanwhile is another matter";
}

// verifies: SK-ST-6, SK-ST-22
TEST_F(StopLogic, AfterAResetItMustBeSwitchedOffAndOn) {
  const auto stop_and_reset = [this](std::uint8_t fault, std::uint8_t latch) {
    in.fault_reason = fault;
    in.latch_reason = latch;
    in.latch_category_0 = latch == BERM_STOP_EMERGENCY;
    step();
    in.fault_reason = in.latch_reason = 0;
    in.standstill = true;
    for (int k = 0; k < 2; ++k) step_switched_off();  // too early: what is latched is not reset yet
    in.operator_reset = true;
    EXPECT_EQ(step(), SK_STATE_STANDBY);
    in.operator_reset = false;
  };
  start();
  for (const auto& [fault, latch] : {std::pair{BERM_STOP_NONE, BERM_STOP_OPERATOR}, {BERM_STOP_NONE, BERM_STOP_EMERGENCY}, {BERM_STOP_SCANNER_SILENT, BERM_STOP_NONE}}) {
    stop_and_reset(static_cast<std::uint8_t>(fault), static_cast<std::uint8_t>(latch));
    for (int k = 0; k < 5; ++k) EXPECT_EQ(step(), SK_STATE_STANDBY) << latch;
    EXPECT_EQ(step_switched_off(), SK_STATE_STANDBY);
    EXPECT_EQ(step(), SK_STATE_RUN) << latch;
  }
  // In STANDBY a stop that latches takes the release back as well.
  in.operator_run = false;
  step();
  ASSERT_EQ(step(), SK_STATE_STANDBY);
  in.operator_run = true;
  stop_and_reset(BERM_STOP_NONE, BERM_STOP_EMERGENCY);
  EXPECT_EQ(step(), SK_STATE_STANDBY);
}

// verifies: SK-ST-7
TEST_F(StopLogic, APauseThatEndsOnTheWayNeedsNoOther) {
  start();
  in.inputs_ready = false;
  in.standstill = true;
  EXPECT_EQ(step(), SK_STATE_STOPPING);
  EXPECT_EQ(step(), SK_STATE_STANDBY);
  in.inputs_ready = true;
  EXPECT_EQ(step(), SK_STATE_RUN);
}

// verifies: SK-ST-14, SK-ST-20, SK-ST-31
TEST_F(StopLogic, WorseReasonsReplaceBetterOnes) {
  start();
  in.hold_reason = BERM_STOP_STALE_GROUND;
  step();
  in.hold_reason = BERM_STOP_DIG_FLOOR;
  step();
  EXPECT_EQ(s.reason, BERM_STOP_STALE_GROUND);
  in.latch_reason = BERM_STOP_APP_SILENT;
  step();
  EXPECT_EQ(s.reason, BERM_STOP_APP_SILENT);
  EXPECT_TRUE(out.heartbeat_enable);
  in.latch_reason = BERM_STOP_EMERGENCY;
  in.latch_category_0 = true;
  EXPECT_EQ(step(), SK_STATE_STOPPING);
  EXPECT_EQ(s.reason, BERM_STOP_APP_SILENT) << "the first of its rank";
  EXPECT_EQ(s.category, SK_CATEGORY_0);
  EXPECT_FALSE(out.heartbeat_enable);
  in.fault_reason = BERM_STOP_MACHINE_FAULT;
  EXPECT_EQ(step(), SK_STATE_FAULT);
  EXPECT_EQ(s.reason, BERM_STOP_MACHINE_FAULT);
}

// verifies: SK-ST-20
TEST_F(StopLogic, ACategory1FaultBrakesFirst) {
  start();
  in.fault_reason = BERM_STOP_SCANNER_SILENT;
  EXPECT_EQ(step(), SK_STATE_STOPPING);
  EXPECT_TRUE(out.heartbeat_enable);
  EXPECT_TRUE(s.latched);
  in.standstill = true;
  EXPECT_EQ(step(), SK_STATE_FAULT);
  EXPECT_FALSE(out.heartbeat_enable);
}

// verifies: SK-ST-12
TEST_F(StopLogic, AStopThatDoesNotEndIsAFault) {
  start();
  in.hold_reason = BERM_STOP_COLLISION_PREDICTED;
  ASSERT_EQ(step(), SK_STATE_STOPPING);
  const std::int64_t began = s.since_us;
  while (in.now_us - began < SK_STOPPING_LIMIT_US) ASSERT_EQ(step(), SK_STATE_STOPPING);
  EXPECT_EQ(step(), SK_STATE_FAULT);
  EXPECT_EQ(s.reason, BERM_STOP_BRAKING);
  EXPECT_EQ(s.category, SK_CATEGORY_0);
}

}  // namespace
