// A run switch that was left on: the kernel's cycle does not begin by it, neither at its start nor after a reset.
#include <gtest/gtest.h>

#include "cycle_rig.hpp"

namespace berm::kernel::test {
namespace {

constexpr int kStartLimit = 400;  // cycles until the scanners have swept the ground under the implements

class CycleRestart : public ::testing::Test {
 protected:
  bool awaits_release() const { return (rig.state().panel & BERM_PANEL_RELEASE_AWAITED) != 0; }
  void stays_in_standby(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      rig.step();
      ASSERT_EQ(rig.state().kernel_state, BERM_STATE_STANDBY) << "after " << i << " cycles";
      ASSERT_FALSE(rig.machine.heartbeat().enable);
      ASSERT_TRUE(awaits_release());
    }
  }
  void runs_once_it_is_switched_off_and_on() {
    rig.machine.run_switch = false;
    rig.steps(10);
    EXPECT_EQ(rig.state().kernel_state, BERM_STATE_STANDBY);
    EXPECT_FALSE(awaits_release());
    rig.machine.run_switch = true;
    EXPECT_TRUE(rig.reach_state(BERM_STATE_RUN, 20));
    EXPECT_FALSE(awaits_release());
  }
  void stops(bool& by) {
    by = true;
    rig.steps(10);
    by = false;
    ASSERT_TRUE(rig.reach_state(BERM_STATE_STOPPED, 300));
    rig.steps(60);
  }
  void resets() {
    rig.machine.reset_key = true;
    ASSERT_TRUE(rig.reach_state(BERM_STATE_STANDBY, 60));
    rig.machine.reset_key = false;
  }
  CycleRig rig;
};

// verifies: SK-CY-3, SK-ST-6
TEST_F(CycleRestart, AtTheStart) {
  rig.machine.run_left_on = true;
  rig.app_talks = false;
  ASSERT_TRUE(rig.reach_state(BERM_STATE_STANDBY, 50));
  stays_in_standby(200);
  rig.app_talks = true;  // an app that was not heard yet had nothing to do with the switch
  stays_in_standby(kStartLimit);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_NONE) << "nothing else keeps it";
  runs_once_it_is_switched_off_and_on();
}

// verifies: SK-CY-3, SK-ST-6
TEST_F(CycleRestart, AfterAResetOfWhateverLatched) {
  ASSERT_TRUE(rig.reach_state(BERM_STATE_RUN, kStartLimit));
  rig.machine.run_left_on = true;
  for (bool* const by : {&rig.machine.operator_stop, &rig.machine.estop_pressed}) {
    stops(*by);
    resets();
    stays_in_standby(300);
    runs_once_it_is_switched_off_and_on();
  }
  rig.app_talks = false;
  rig.steps(120);
  ASSERT_EQ(rig.state().stop_reason, BERM_STOP_APP_SILENT);
  rig.app_talks = true;
  rig.steps(10);
  resets();
  stays_in_standby(300);
  runs_once_it_is_switched_off_and_on();
}

// verifies: SK-CY-3, SK-ST-6
TEST_F(CycleRestart, SwitchingOffBeforeTheResetIsNotEnough) {
  ASSERT_TRUE(rig.reach_state(BERM_STATE_RUN, kStartLimit));
  rig.machine.run_left_on = true;
  stops(rig.machine.operator_stop);
  rig.machine.run_switch = false;
  rig.steps(20);
  rig.machine.run_switch = true;
  rig.steps(20);
  resets();
  stays_in_standby(100);
}

// verifies: SK-CY-3, SK-CY-14, SK-ST-6
TEST_F(CycleRestart, APanelThatIsSilentIsNotOneThatIsOff) {
  ASSERT_TRUE(rig.reach_state(BERM_STATE_RUN, kStartLimit));
  rig.machine.run_left_on = true;
  stops(rig.machine.operator_stop);
  resets();
  stays_in_standby(10);
  rig.machine.operator_silent = true;
  ASSERT_TRUE(rig.reach_state(BERM_STATE_STOPPED, 60));
  rig.machine.operator_silent = false;
  rig.steps(20);
  resets();
  stays_in_standby(100);
  runs_once_it_is_switched_off_and_on();
}

// verifies: SK-ST-7, SK-CY-10
TEST_F(CycleRestart, WhatIsHeldOrPausedNeedsNoOther) {
  ASSERT_TRUE(rig.reach_state(BERM_STATE_RUN, kStartLimit));
  rig.machine.run_left_on = true;
  rig.app_talks = false;
  ASSERT_TRUE(rig.reach_state(BERM_STATE_STOPPED, 30));
  rig.app_talks = true;
  EXPECT_TRUE(rig.reach_state(BERM_STATE_RUN, 60)) << "held: REQUEST_HOLD";
  rig.machine.run_switch = false;
  ASSERT_TRUE(rig.reach_state(BERM_STATE_STANDBY, 60));
  EXPECT_FALSE(awaits_release());
  rig.machine.run_switch = true;
  EXPECT_TRUE(rig.reach_state(BERM_STATE_RUN, 60));
}

}  // namespace
}  // namespace berm::kernel::test
