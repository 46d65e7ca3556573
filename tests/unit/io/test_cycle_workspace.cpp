// The Workspace Monitor in the kernel's cycle: what comes into the region stops the machine, and when it has left the machine goes on; trucks' lanes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "cycle_rig.hpp"

namespace berm::kernel::test {
namespace {

constexpr double kPersonM = 1.75;
constexpr int kSweepCycles = 500;  // there and back of the miniature machine's scanners

class CycleWorkspace : public testing::Test {
 protected:
  CycleWorkspace() {
    parameters = berm::test::demo_parameters();
    parameters.workspace_watched = 1;
    parameters.truck_zones = parameters.lanes = 0;
  }
  // RUN, its surroundings swept twice.
  void run() {
    rig = std::make_unique<CycleRig>(parameters);
    ASSERT_TRUE(rig->reach_state(BERM_STATE_RUN, 1500)) << why();
    rig->steps(2 * kSweepCycles);
    ASSERT_EQ(state().kernel_state, BERM_STATE_RUN) << why();
    ASSERT_EQ(state().stop_count[BERM_STOP_INTRUDER], 0U);
  }
  // A wall stands for whatever rises: it does so along a line across the scanners' view.
  void rises(double height_m, double y_m = 11.1) { rig->machine.wall = {y_m, height_m}; }
  int cycles_until(int kernel_state, int limit) {
    for (int n = 1; n <= limit; ++n) {
      rig->step();
      if (state().kernel_state == kernel_state) return n;
    }
    return -1;
  }
  // One sweep, an update to see that it has passed, and one to merge.
  int detection_limit() const { return kSweepCycles + 3 * parameters.workspace_period_us / 10000 + parameters.workspace_wait_us / 10000; }
  const berm_state& state() const { return rig->state(); }
  std::string why() const { return "reason " + std::to_string(state().stop_reason) + " at " + std::to_string(state().blocked_x_mm) + " " + std::to_string(state().blocked_y_mm); }

  berm_parameters parameters{};
  std::unique_ptr<CycleRig> rig;
};

// verifies: SK-WM-50
TEST_F(CycleWorkspace, UnwatchedNothingStopsAndTheStateSaysSo) {
  parameters.workspace_watched = 0;
  run();
  EXPECT_EQ(state().unwatched & BERM_UNWATCHED_WORKSPACE, BERM_UNWATCHED_WORKSPACE);
  rises(kPersonM);
  EXPECT_EQ(cycles_until(BERM_STATE_STOPPED, 2 * detection_limit()), -1) << why();
}

// verifies: SK-WM-50, SK-WM-51
TEST_F(CycleWorkspace, WhatRisesHoldsTheMachineUntilItHasLeft) {
  run();
  EXPECT_EQ(state().unwatched & BERM_UNWATCHED_WORKSPACE, 0U);
  rises(kPersonM);
  ASSERT_GT(cycles_until(BERM_STATE_STOPPED, detection_limit()), 0) << why();
  EXPECT_EQ(state().stop_reason, BERM_STOP_INTRUDER);
  EXPECT_EQ(state().stop_category, 2);
  EXPECT_EQ(state().stop_count[BERM_STOP_INTRUDER], 0U) << "nothing moved, nothing was stopped";
  EXPECT_NEAR(state().blocked_y_mm, 11100, 450);
  EXPECT_GT(state().blocked_height_mm, parameters.workspace_rise_mm);
  EXPECT_LE(state().blocked_height_mm, 1850);
  EXPECT_EQ(state().blocked_link, static_cast<std::uint32_t>(BERM_JOINTS));
  rig->wanted_urad_s[1] = 50000;
  const double boom = rig->machine.angle_rad[1];
  rig->steps(3 * kSweepCycles);
  EXPECT_EQ(state().stop_reason, BERM_STOP_INTRUDER) << "who stays is not forgotten";
  EXPECT_EQ(rig->machine.angle_rad[1], boom) << "nor crept past";
  rig->wanted_urad_s[1] = 0;
  rises(0.0);
  const int cleared = cycles_until(BERM_STATE_RUN, 2 * detection_limit() + parameters.workspace_dwell_us / 10000);
  EXPECT_GE(cleared, parameters.workspace_dwell_us / 10000) << "not before the dwell: " << why();
}

// verifies: SK-WM-51
TEST_F(CycleWorkspace, AMovingMachineIsStopped) {
  run();
  rig->wanted_urad_s[3] = 100000;
  rig->steps(20);
  ASSERT_GT(rig->machine.velocity_rad_s[3], 0.05);
  rises(kPersonM);
  int waited = 0;
  while (state().stop_reason != BERM_STOP_INTRUDER && waited++ < detection_limit()) {
    if (waited % 60 == 0) rig->wanted_urad_s[3] = -rig->wanted_urad_s[3];
    rig->step();
  }
  ASSERT_EQ(state().stop_reason, BERM_STOP_INTRUDER);
  EXPECT_EQ(state().stop_count[BERM_STOP_INTRUDER], 1U);
  rig->steps(60);
  EXPECT_LT(std::fabs(rig->machine.velocity_rad_s[3]), 1e-3);
}

// verifies: SK-WM-40, SK-WM-51
TEST_F(CycleWorkspace, WhatIsFarOrLowIsNoIntruder) {
  run();
  rises(0.9 * parameters.workspace_rise_mm * 1e-3);
  EXPECT_EQ(cycles_until(BERM_STATE_STOPPED, 2 * detection_limit()), -1) << why();
  rises(0.0);
  rig->steps(2 * kSweepCycles);
  rises(kPersonM, 12.6);
  EXPECT_EQ(cycles_until(BERM_STATE_STOPPED, 2 * detection_limit()), -1) << why();
}

// verifies: SK-WM-53
TEST_F(CycleWorkspace, ALaneIsWatchedWhileATruckIsParkedThereAndLearnedWithIt) {
  parameters.lanes = 1;
  parameters.lane[0] = {-15000, 10000, 15000, 13000};
  run();
  rises(kPersonM);  // the truck comes
  EXPECT_EQ(cycles_until(BERM_STATE_STOPPED, 2 * detection_limit()), -1) << why();
  rig->machine.spotter_present = true;
  EXPECT_EQ(cycles_until(BERM_STATE_STOPPED, 2 * detection_limit()), -1) << "the truck itself: " << why();
  rises(kPersonM + 1.0);
  EXPECT_GT(cycles_until(BERM_STATE_STOPPED, detection_limit()), 0) << "somebody beside it";
  EXPECT_EQ(state().stop_reason, BERM_STOP_INTRUDER);
  rig->machine.truck_leaving = true;
  EXPECT_GT(cycles_until(BERM_STATE_RUN, 2 + parameters.workspace_dwell_us / 10000 + detection_limit()), 0) << "the lane is the trucks': " << why();
  rises(0.0);
  EXPECT_EQ(cycles_until(BERM_STATE_STOPPED, 2 * detection_limit()), -1) << why();
}

// verifies: SK-WM-54
TEST_F(CycleWorkspace, RelearningTakesWhatStandsThereForGround) {
  run();
  rises(kPersonM);
  ASSERT_GT(cycles_until(BERM_STATE_STOPPED, detection_limit()), 0) << why();
  rig->machine.relearn_key = true;
  rig->steps(30);
  rig->machine.relearn_key = false;
  EXPECT_GT(cycles_until(BERM_STATE_RUN, 2 * kSweepCycles), 0) << why();
  EXPECT_EQ(cycles_until(BERM_STATE_STOPPED, 2 * detection_limit()), -1) << why();
}

// verifies: SK-WM-52, SK-WM-54
TEST_F(CycleWorkspace, WhileTheBaseHasMovedNothingIsFed) {
  run();
  rig->steps(3);
  EXPECT_GT(rig->cycle->workspace().monitor().modified, 0);
  rig->machine.roll_urad = 30000;
  for (int n = 0; n < 100 && state().stop_reason != BERM_STOP_BASE_MOVED; ++n) rig->step();
  ASSERT_EQ(state().stop_reason, BERM_STOP_BASE_MOVED) << why();
  for (int n = 0; n < 50; ++n) {
    rig->step();
    ASSERT_EQ(rig->cycle->workspace().monitor().modified, 0);
  }
}

}  // namespace
}  // namespace berm::kernel::test
