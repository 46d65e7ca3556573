// An angle's sensor that stands still while its joint moves: the box would stay where the joint no longer is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cycle_rig.hpp"
#include "io/motion_watch.hpp"

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

// The swing as the watch is told of it, a reading each 10 ms; asked for its speed, and for nothing else.
class WatchedSwing {
 public:
  std::uint8_t read(double angle_rad, double velocity_rad_s, double asked_rad_s, std::int64_t late_us = 0) {
    query_.now_us += berm::test::kCycleUs;
    query_.late_us = late_us;
    query_.angle_urad[BERM_SWING] = static_cast<std::int32_t>(std::lround(angle_rad * 1e6));
    query_.velocity_urad_s[BERM_SWING] = static_cast<std::int32_t>(std::lround(velocity_rad_s * 1e6));
    query_.under_way_high_urad_s[BERM_SWING] = static_cast<std::int32_t>(std::lround(asked_rad_s * 1e6));
    return watch_.check(query_, sk_reach_box{}, query_.now_us, query_.now_us);
  }
  // At an even speed; the first reading is new, those after it come older and older, up to the age.
  std::uint8_t read_ageing(double age_s, std::int64_t late_us) {
    constexpr double speed = 0.5, ageing = 0.9;
    std::uint8_t fault = BERM_STOP_NONE;
    for (int k = 0; k < 100 && fault == BERM_STOP_NONE; ++k) fault = read(speed * (0.01 * k - std::min(age_s, ageing * 0.01 * k)), speed, speed, late_us);
    return fault;
  }

 private:
  const berm_parameters parameters_ = berm::test::demo_parameters();
  MotionWatch watch_{parameters_};
  MotionQuery query_{};
};

// verifies: SK-MS-12
TEST(MotionWatchAgreement, ReadingsMayBeAsOldAsTheStateLatencyAndWhatTheyAreOlder) {
  EXPECT_EQ(WatchedSwing().read_ageing(0.02, 0), BERM_STOP_NONE);
  EXPECT_EQ(WatchedSwing().read_ageing(0.12, 100'000), BERM_STOP_NONE);
  EXPECT_EQ(WatchedSwing().read_ageing(0.12, 0), BERM_STOP_STATE_FRAME);
}

// verifies: SK-MS-12, SK-MS-21
TEST(MotionWatchAgreement, IsJudgedFromTheSecondReadingOn) {
  WatchedSwing swing;
  EXPECT_EQ(swing.read(0.0, 0.0, 0.0), BERM_STOP_NONE);
  EXPECT_EQ(swing.read(0.1, 0.0, 0.0), BERM_STOP_STATE_FRAME);
}

// verifies: SK-MS-20
TEST(MotionWatchAgreement, WhatRemovesPowerComesFirst) {
  WatchedSwing swing;
  for (int k = 0; k < 100; ++k) ASSERT_EQ(swing.read(0.0, 0.0, 0.0), BERM_STOP_NONE);
  EXPECT_EQ(swing.read(0.1, 0.5, 0.0), BERM_STOP_UNCOMMANDED);
}

// verifies: SK-MS-15 (the figures of the 20 t machine, quiet readings)
TEST(JointAgreementFigures, OfTheShippedMachine) {
  const berm_parameters p = berm::test::demo_parameters();
  const auto found_after_us = [&p](int joint, double deg_s) {
    sk_agreement span;
    sk_agreement_begin(&span);
    const std::int32_t velocity = berm::test::urad(deg_s);
    std::int64_t t = 0;
    while (t <= SK_AGREE_SPAN_US && sk_agreement_step(&span, &p, {t, joint, 0, velocity, p.state_latency_us}) == BERM_STOP_NONE) t += berm::test::kCycleUs;
    return t;
  };
  EXPECT_LE(found_after_us(BERM_SWING, 1.4), SK_AGREE_SPAN_US);
  EXPECT_GT(found_after_us(BERM_SWING, 1.2), SK_AGREE_SPAN_US);
  EXPECT_LE(found_after_us(BERM_BUCKET, 3.6), SK_AGREE_SPAN_US);
  EXPECT_GT(found_after_us(BERM_BUCKET, 3.4), SK_AGREE_SPAN_US);
  EXPECT_LE(found_after_us(BERM_SWING, 50.0), 100'000);
  EXPECT_GE(found_after_us(BERM_SWING, 50.0), 80'000);
}

}  // namespace
}  // namespace berm::kernel::test
