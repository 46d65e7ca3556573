// What the reach box holds of time: the machine's silence limit, joint readings that did not come, and a cycle that did not begin when it should.
#include <gtest/gtest.h>

#include "core/reach_box.h"
#include "cycle_rig.hpp"

namespace berm::kernel::test {
namespace {

constexpr int kStartLimit = 400, kJoint = 1;  // the boom
constexpr std::int32_t kUp = 50000;
constexpr std::int64_t kCycle = berm::test::kCycleUs;
constexpr std::int32_t kObeyed = BERM_CAN_SILENCE_US + BERM_CAN_SEND_LATE_US;

class CycleLate : public testing::Test {
 protected:
  // The boom rises evenly, as it has been told for longer than commands are under way.
  void SetUp() override {
    ASSERT_TRUE(rig.reach_state(BERM_STATE_RUN, kStartLimit));
    rig.wanted_urad_s[kJoint] = kUp;
    rig.steps(60);
    ASSERT_EQ(rig.state().commanded_urad_s[kJoint], kUp);
  }
  // Whether the published box is, with some row of the table, that of readings so much older than the state latency and of a machine that obeys for so long.
  bool holds(std::int64_t late_us, std::int32_t obeyed_us, std::int32_t up = kUp) const {
    berm_parameters p = rig.parameters;
    p.state_latency_us += static_cast<std::int32_t>(late_us);
    p.cycle_us = obeyed_us;
    const berm_state& s = rig.state();
    for (std::int32_t row = 0; row < BERM_BRAKE_REACHES; ++row) {
      sk_reach_box box{};
      if (!sk_reach_joint(&p, kJoint, row, s.joint_angle_urad[kJoint], s.joint_velocity_urad_s[kJoint], SK_REACH_COMMANDED, 0, up, &box)) continue;
      if (box.high_urad[kJoint] == s.reach_high_urad[kJoint] && box.low_urad[kJoint] == s.reach_low_urad[kJoint]) return true;
    }
    return false;
  }
  CycleRig rig;
};

// verifies: SK-CY-28
TEST_F(CycleLate, TheBoxHoldsAMachineThatHearsNoMoreThanThisCycle) {
  EXPECT_TRUE(holds(0, kObeyed));
  EXPECT_FALSE(holds(0, static_cast<std::int32_t>(kCycle)));
  EXPECT_FALSE(holds(0, BERM_CAN_SILENCE_US)) << "the command may be sent late";
}

// verifies: SK-CY-29
TEST_F(CycleLate, TheBoxGrowsWithEveryReadingThatDoesNotCome) {
  rig.machine.joints_silent = true;
  for (int lost = 1; lost <= 4; ++lost) {
    const std::int32_t before = rig.state().reach_high_urad[kJoint];
    rig.step();
    ASSERT_EQ(rig.state().kernel_state, BERM_STATE_RUN) << lost;
    EXPECT_TRUE(holds(lost * kCycle, kObeyed)) << lost;
    EXPECT_GE(rig.state().reach_high_urad[kJoint] - before, static_cast<std::int32_t>(kUp * kCycle / 1000000)) << lost;
  }
  rig.machine.joints_silent = false;
  rig.step();
  EXPECT_TRUE(holds(0, kObeyed)) << "the next that comes is as good as any";
}

// verifies: SK-CY-29
TEST_F(CycleLate, WhatWaitedForALateCycleIsOlder) {
  rig.gather();
  rig.gather();
  rig.step();
  ASSERT_EQ(rig.state().kernel_state, BERM_STATE_RUN);
  EXPECT_TRUE(holds(2 * kCycle, kObeyed)) << "the frames may have come when the cycle before had just begun";
  rig.step();
  EXPECT_TRUE(holds(0, kObeyed));
}

// A command that was in force when the last reading was taken may be what it moves by since.
// verifies: SK-CY-21
TEST_F(CycleLate, CommandsAreUnderWayFromWhenTheReadingWasTaken) {
  const auto window = static_cast<int>((std::int64_t{rig.parameters.command_latency_us} + rig.parameters.state_latency_us + rig.parameters.cycle_us) / kCycle);
  rig.wanted_urad_s[kJoint] = 0;
  rig.steps(window);
  ASSERT_TRUE(holds(0, kObeyed, kUp));
  rig.machine.joints_silent = true;
  rig.steps(3);
  EXPECT_TRUE(holds(3 * kCycle, kObeyed, kUp));
  EXPECT_FALSE(holds(3 * kCycle, kObeyed, 0));
  rig.machine.joints_silent = false;
  rig.step();
  EXPECT_TRUE(holds(0, kObeyed, 0));
}

}  // namespace
}  // namespace berm::kernel::test
