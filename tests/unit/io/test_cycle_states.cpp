// The kernel's cycle against a miniature machine: start, stops, faults, reset.
#include <gtest/gtest.h>

#include <cmath>

#include "cycle_rig.hpp"

namespace berm::kernel::test {
namespace {

constexpr int kStartLimit = 400;  // cycles until the scanners have swept the ground under the implements

bool all_zero(const std::int32_t (&v)[4]) { return v[0] == 0 && v[1] == 0 && v[2] == 0 && v[3] == 0; }

class CycleStates : public ::testing::Test {
 protected:
  void run() { ASSERT_TRUE(rig.reach_state(BERM_STATE_RUN, kStartLimit)) << "reason " << int(rig.state().stop_reason); }
  CycleRig rig;
};

// verifies: SK-CY-1, SK-CY-2
TEST_F(CycleStates, WaitsInStandbyForTheFirstRequestThenRuns) {
  rig.app_talks = false;
  ASSERT_TRUE(rig.reach_state(BERM_STATE_STANDBY, 50));
  rig.steps(kStartLimit);
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_STANDBY);
  EXPECT_FALSE(rig.machine.heartbeat().enable);
  rig.app_talks = true;
  EXPECT_TRUE(rig.reach_state(BERM_STATE_RUN, 20));
  EXPECT_TRUE(rig.machine.heartbeat().enable);
  EXPECT_EQ(rig.state().stop_category, 255);
}

// verifies: SK-CY-2
TEST_F(CycleStates, DoesNotRunWithoutTheRunSwitch) {
  rig.machine.run_switch = false;
  EXPECT_FALSE(rig.reach_state(BERM_STATE_RUN, kStartLimit));
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_STANDBY);
}

// verifies: SK-CY-10, IF-CT-13
TEST_F(CycleStates, HoldsWithinFiftyMillisecondsOfSilenceAndLatchesWithinFiveHundred) {
  run();
  rig.wanted_urad_s[1] = 50000;
  rig.steps(10);
  ASSERT_GT(rig.state().commanded_urad_s[1], 0);
  rig.app_talks = false;
  rig.step();  // the last request came in this cycle or the one before
  rig.steps(5);
  EXPECT_TRUE(all_zero(rig.state().commanded_urad_s));
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_REQUEST_HOLD);
  EXPECT_EQ(rig.state().stop_category, 2);
  EXPECT_TRUE(rig.machine.heartbeat().enable);
  rig.steps(45);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_APP_SILENT);
  ASSERT_TRUE(rig.state().kernel_state == BERM_STATE_STOPPED);
  EXPECT_FALSE(rig.machine.heartbeat().enable);
  EXPECT_EQ(rig.state().stop_count[BERM_STOP_REQUEST_HOLD], 1U);
  EXPECT_EQ(rig.state().stop_count[BERM_STOP_APP_SILENT], 1U);
  rig.app_talks = true;
  rig.steps(100);
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_STOPPED) << "only the operator may release it";
  rig.machine.reset_key = true;
  EXPECT_TRUE(rig.reach_state(BERM_STATE_RUN, 50));
}

// verifies: SK-CY-10
TEST_F(CycleStates, AShortSilenceIsHeldAndResumesByItself) {
  run();
  rig.wanted_urad_s[1] = 50000;
  rig.steps(10);
  rig.app_talks = false;
  rig.steps(20);
  ASSERT_TRUE(all_zero(rig.state().commanded_urad_s));
  rig.app_talks = true;
  EXPECT_TRUE(rig.reach_state(BERM_STATE_RUN, 60));
}

// verifies: SK-CY-11
TEST_F(CycleStates, ADisconnectedAppIsASilentApp) {
  run();
  rig.in->app_connected = false;
  rig.steps(51);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_APP_SILENT);
}

// verifies: SK-CY-11, IF-CT-10 (the first sequence), IF-CT-24 (the next app's sequence)
TEST_F(CycleStates, ANewConnectionMayCountFromAnywhere) {
  run();
  rig.in->app_connections = 2;
  const std::int32_t still[4] = {};
  rig.app_talks = false;
  const berm_request request = berm::test::make_request(4000000000U, rig.state().time_us, still);
  std::memcpy(rig.in->request, &request, sizeof request);
  rig.step();
  EXPECT_EQ(rig.state().request_result, BERM_REQUEST_ACCEPTED);
  EXPECT_EQ(rig.state().request_sequence, 4000000000U);
}

// verifies: SK-CY-12
TEST_F(CycleStates, LostStateFramesAreAFault) {
  run();
  rig.wanted_urad_s[1] = 50000;
  rig.steps(10);
  rig.machine.joints_silent = true;
  rig.steps(6);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_STATE_FRAME);
  EXPECT_TRUE(all_zero(rig.state().commanded_urad_s));
  EXPECT_TRUE(rig.reach_state(BERM_STATE_FAULT, 300)) << "power goes when the machine must stand by its braking table";
  EXPECT_FALSE(rig.machine.heartbeat().enable);
  rig.machine.joints_silent = false;
  rig.steps(50);
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_FAULT);
  rig.machine.reset_key = true;
  EXPECT_TRUE(rig.reach_state(BERM_STATE_RUN, 60));
}

// verifies: SK-CY-13
TEST_F(CycleStates, EmergencyStopRemovesPowerInTheSameCycle) {
  run();
  rig.machine.estop_pressed = true;
  ASSERT_TRUE(rig.reach_state(BERM_STATE_STOPPING, 6) || rig.state().kernel_state == BERM_STATE_STOPPED);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_EMERGENCY);
  EXPECT_EQ(rig.state().stop_category, 0);
  EXPECT_FALSE(rig.machine.heartbeat().enable);
  rig.machine.estop_pressed = false;
  rig.steps(100);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_EMERGENCY) << "latched";
}

// verifies: SK-CY-14
TEST_F(CycleStates, OperatorStopAndSilentPanelLatch) {
  run();
  rig.machine.operator_stop = true;
  rig.steps(6);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_OPERATOR);
  CycleRig other;
  ASSERT_TRUE(other.reach_state(BERM_STATE_RUN, kStartLimit));
  other.machine.operator_silent = true;
  other.steps(30);
  EXPECT_EQ(other.state().stop_reason, BERM_STOP_OPERATOR);
}

// verifies: SK-CY-14
TEST_F(CycleStates, ASpotterMayBeAbsentButNotFallSilent) {
  rig.machine.spotter_present = true;
  run();
  EXPECT_NE(rig.state().panel & BERM_PANEL_TRUCK_PARKED, 0U);
  rig.machine.spotter_present = false;
  rig.steps(30);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_OPERATOR);
  EXPECT_EQ(rig.state().panel & BERM_PANEL_TRUCK_PARKED, 0U);
}

// verifies: SK-CY-15
TEST_F(CycleStates, AMachineErrorIsAFault) {
  run();
  rig.machine.system_error = true;
  rig.steps(6);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_MACHINE_FAULT);
}

// verifies: SK-CY-16
TEST_F(CycleStates, ASilentScannerIsAFault) {
  run();
  rig.machine.scanners_silent = true;
  rig.steps(22);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_SCANNER_SILENT);
}

// verifies: SK-CY-17
TEST_F(CycleStates, ALateCycleIsAFault) {
  run();
  rig.in->clock_fault = true;
  rig.step();
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_CLOCK);
  EXPECT_TRUE(all_zero(rig.state().commanded_urad_s));
}

// verifies: SK-MS-20, SK-MS-1
TEST_F(CycleStates, AJointThatMovesUntoldIsAFaultWithoutPower) {
  run();
  rig.steps(20);
  rig.machine.velocity_rad_s[1] = 0.05;  // less what it loses in a cycle: more than three of the speed's errors (0.3 deg/s each)
  rig.step();
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_FAULT);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_UNCOMMANDED);
  EXPECT_EQ(rig.state().stop_category, 0);
  EXPECT_FALSE(rig.machine.heartbeat().enable);
  EXPECT_EQ(rig.state().stop_count[BERM_STOP_UNCOMMANDED], 1U);
  rig.steps(60);
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_FAULT) << "latched";
  rig.machine.reset_key = true;
  EXPECT_TRUE(rig.reach_state(BERM_STATE_RUN, 60));
}

// verifies: SK-MS-20, SK-MS-3, SK-MS-7
TEST_F(CycleStates, AJointBeyondItsStopAngleIsAFaultWithoutPower) {
  run();
  rig.steps(20);
  rig.machine.angle_rad[1] += 0.03;  // the boom's column 1 of 0.67 degrees and twice its angle error, 0.17 degrees, less
  rig.step();
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_FAULT);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_BRAKING);
  EXPECT_EQ(rig.state().stop_category, 0);
  EXPECT_FALSE(rig.machine.heartbeat().enable);
  rig.steps(60);
  rig.machine.reset_key = true;
  EXPECT_TRUE(rig.reach_state(BERM_STATE_RUN, 60)) << "it stands: nothing is in the way of the reset";
}

// verifies: SK-MS-21
TEST_F(CycleStates, SupervisionBeginsWhenNoOlderCommandCanBeInForce) {
  rig.machine.velocity_rad_s[0] = 0.1;  // a kernel before this one was swinging
  rig.steps(5);
  rig.machine.velocity_rad_s[0] = 0.3;  // on a command of its own, at most 0.12 s old when the first reading came
  rig.steps(10);
  ASSERT_NE(rig.state().kernel_state, BERM_STATE_FAULT);
  rig.machine.velocity_rad_s[0] = 0.3;
  rig.step();
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_FAULT);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_UNCOMMANDED);
}

// verifies: SK-MS-22
TEST_F(CycleStates, AReadingIsJudgedOnce) {
  run();
  rig.wanted_urad_s[1] = 100000;
  rig.steps(60);
  ASSERT_GT(rig.machine.velocity_rad_s[1], 0.05);
  rig.wanted_urad_s[1] = 0;
  rig.steps(11);
  // The frames stop while the boom still falls back; the old speed is not held against the commands of now.
  rig.machine.joints_silent = true;
  rig.steps(4);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_NONE);
  rig.machine.joints_silent = false;
  rig.steps(50);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_NONE);
}

}  // namespace
}  // namespace berm::kernel::test
