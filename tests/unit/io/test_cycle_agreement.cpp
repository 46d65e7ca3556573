// An angle's sensor that stands still while its joint moves: the box would stay where the joint no longer is.
#include <gtest/gtest.h>

#include <cmath>

#include "cycle_rig.hpp"

namespace berm::kernel::test {
namespace {

constexpr int kStartLimit = 1500;

// Moves the joint, sticks its angle, and returns the cycles until the machine no longer runs.
int cycles_until_stopped(CycleRig& rig, int joint, std::int32_t velocity, int most) {
  rig.wanted_urad_s[joint] = velocity;
  rig.steps(60);
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_RUN);
  EXPECT_EQ(rig.state().commanded_urad_s[joint], velocity);
  rig.machine.angle_sticks[joint] = true;
  int cycles = 0;
  while (cycles < most && rig.state().kernel_state == BERM_STATE_RUN) {
    rig.step();
    ++cycles;
  }
  return cycles;
}

class CycleAgreement : public testing::TestWithParam<int> {};

// verifies: SK-MS-12, SK-MS-20
TEST_P(CycleAgreement, AnAngleThatStandsWhileItsJointMovesIsABadStateFrame) {
  CycleRig rig;
  ASSERT_TRUE(rig.reach_state(BERM_STATE_RUN, kStartLimit));
  const int joint = GetParam();
  const std::int32_t velocity = joint == BERM_BOOM ? -150'000 : joint == BERM_SWING ? 200'000 : -200'000;
  const int cycles = cycles_until_stopped(rig, joint, velocity, 100);
  EXPECT_LE(cycles, 30);
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_STOPPING) << "category 1";
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_STATE_FRAME);
  EXPECT_EQ(rig.state().commanded_urad_s[joint], 0);
  rig.steps(200);
  EXPECT_NEAR(rig.machine.velocity_rad_s[joint], 0.0, 1e-9) << "it stands";
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_FAULT) << "latched, without power";
}

INSTANTIATE_TEST_SUITE_P(Joints, CycleAgreement, testing::Values(BERM_SWING, BERM_BOOM, BERM_STICK, BERM_BUCKET));

// verifies: SK-MS-14
TEST(CycleAgreementSound, ALostFrameNowAndThenIsNoDisagreement) {
  CycleRig rig;
  ASSERT_TRUE(rig.reach_state(BERM_STATE_RUN, kStartLimit));
  for (int k = 0; k < 600; ++k) {
    rig.wanted_urad_s[BERM_BOOM] = k / 75 % 2 == 0 ? 150'000 : -150'000;
    rig.machine.joints_silent = k % 7 == 3 || k % 11 == 5;
    rig.step();
    ASSERT_NE(rig.state().stop_reason, BERM_STOP_STATE_FRAME) << k;
  }
}

}  // namespace
}  // namespace berm::kernel::test
