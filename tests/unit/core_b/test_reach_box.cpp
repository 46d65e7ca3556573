#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "reach_parameters.hpp"

namespace berm::core_test {
namespace {

constexpr std::int32_t kMin32 = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMax32 = std::numeric_limits<std::int32_t>::max();

struct Measured {
  std::int32_t joint = 2, row = 1, angle_urad = 500'000, velocity_urad_s = 0, mode = SK_REACH_ANY, low_urad_s = 0, high_urad_s = 0;
};

class ReachBox : public testing::Test {
 protected:
  bool reach(const Measured& m) {
    box = untouched_box();
    return sk_reach_joint(&parameters, m.joint, m.row, m.angle_urad, m.velocity_urad_s, m.mode, m.low_urad_s, m.high_urad_s, &box);
  }
  bool refused(const Measured& m) { return !reach(m) && same(box, untouched_box()); }
  bool refused_with(const std::function<void(berm_parameters&)>& change) {
    const berm_parameters was = parameters;
    change(parameters);
    const bool result = refused({});
    parameters = was;
    return result;
  }
  void expect_box(std::int32_t low_urad, std::int32_t high_urad, std::int32_t speed_urad_s) const {
    EXPECT_EQ(box.low_urad[2], low_urad);
    EXPECT_EQ(box.high_urad[2], high_urad);
    EXPECT_EQ(box.speed_urad_s[2], speed_urad_s);
  }

  berm_parameters parameters = reach_parameters();
  sk_reach_box box{};
};

// verifies: SK-RB-1
TEST_F(ReachBox, RowIsTheFirstThatReachesFarEnough) {
  EXPECT_EQ(sk_brake_row(&parameters, kMin32), 0);
  EXPECT_EQ(sk_brake_row(&parameters, 3'000), 0);
  EXPECT_EQ(sk_brake_row(&parameters, 3'001), 1);
  EXPECT_EQ(sk_brake_row(&parameters, 9'000), 2);
  EXPECT_EQ(sk_brake_row(&parameters, 12'000), 3);
  EXPECT_EQ(sk_brake_row(&parameters, 12'001), -1);
  EXPECT_EQ(sk_brake_row(&parameters, kMax32), -1);
}

// verifies: SK-RB-2
TEST_F(ReachBox, BrakeAngleIsOnTheChordToTheNextFasterColumn) {
  EXPECT_EQ(sk_brake_angle(&parameters, 2, 1, kMin32), 2);
  EXPECT_EQ(sk_brake_angle(&parameters, 2, 1, 0), 2);
  EXPECT_EQ(sk_brake_angle(&parameters, 2, 1, 1), 3);  // 0.2 rounded up
  EXPECT_EQ(sk_brake_angle(&parameters, 2, 1, 50'000), 10'002);
  EXPECT_EQ(sk_brake_angle(&parameters, 2, 1, 100'000), 20'002);
  EXPECT_EQ(sk_brake_angle(&parameters, 2, 1, 100'001), 20'003);
  EXPECT_EQ(sk_brake_angle(&parameters, 2, 1, 199'999), 40'002);
  EXPECT_EQ(sk_brake_angle(&parameters, 3, 3, 700'000), 280'003);
  EXPECT_EQ(sk_brake_angle(&parameters, 3, 3, 700'001), -1);
  EXPECT_EQ(sk_brake_angle(&parameters, 3, 3, kMax32), -1);
  parameters.velocity_max_urad_s[0] = 100;  // column 1 holds up to 14, not 14.28
  EXPECT_EQ(sk_brake_angle(&parameters, 0, 0, 14), 10'000);
  EXPECT_EQ(sk_brake_angle(&parameters, 0, 0, 15), 10'715);  // one of the 14 up to 28
}

// verifies: SK-RB-2
TEST_F(ReachBox, BrakeAngleRefusesWhatIsOutOfRange) {
  for (const std::int32_t outside : {kMin32, -1, 4, kMax32}) {
    EXPECT_EQ(sk_brake_angle(&parameters, outside, 1, 10), -1);
    EXPECT_EQ(sk_brake_angle(&parameters, 2, outside, 10), -1);
  }
  for (const std::int32_t below : {kMin32, -2, -1}) {
    parameters.brake_angle_urad[2][1][1] = below;
    EXPECT_EQ(sk_brake_angle(&parameters, 2, 1, 10), -1);
  }
  parameters.brake_angle_urad[2][1][1] = 100'000'001;
  EXPECT_EQ(sk_brake_angle(&parameters, 2, 1, 10), -1);
  parameters.brake_angle_urad[2][1][1] = 100'000'000;
  EXPECT_EQ(sk_brake_angle(&parameters, 2, 1, 100'000), 100'000'000);
  parameters.brake_angle_urad[2][1][0] = 5;
  parameters.brake_angle_urad[2][1][1] = 4;  // falls
  EXPECT_EQ(sk_brake_angle(&parameters, 2, 1, 10), -1);
  parameters.velocity_max_urad_s[2] = -1;
  EXPECT_EQ(sk_brake_angle(&parameters, 2, 1, -5), -1);
}

// Standing: s = 2000, 102000 urad/s after 0.1 s, 10200 - 100000^2 / 2e6 = 5200 on the way, then a fifth of that speed, as row 1 has it, and its 2 at rest.
// verifies: SK-RB-4, SK-RB-8, SK-RB-10
TEST_F(ReachBox, StandingAnyCommand) {
  ASSERT_TRUE(reach({}));
  expect_box(500'000 - 1'000 - 5'200 - 20'402, 500'000 + 1'000 + 5'200 + 20'402, 102'000);
}

// At 0.65 rad/s upward: s = 652000, capped at 700000: 70000 - 48000^2 / 2e6 = 68848. Downward s = -648000 is still upward after 0.1 s.
// verifies: SK-RB-4, SK-RB-7, SK-RB-8
TEST_F(ReachBox, MovingFastAnyCommand) {
  ASSERT_TRUE(reach({2, 1, 500'000, 650'000}));
  expect_box(500'000 - 1'000, 500'000 + 1'000 + 68'848 + 140'002, 700'000);
  ASSERT_TRUE(reach({2, 1, 500'000, -650'000}));
  expect_box(500'000 - 1'000 - 68'848 - 140'002, 500'000 + 1'000, 700'000);
}

// At 0.05 rad/s upward: downward s = -48000, 52000 after 0.1 s, 5200 - 100000^2 / 2e6 = 200.
// verifies: SK-RB-4
TEST_F(ReachBox, TurningRoundAnyCommand) {
  ASSERT_TRUE(reach({2, 1, 500'000, 50'000}));
  expect_box(500'000 - 1'000 - 200 - 10'402, 500'000 + 1'000 + 10'200 + 30'402, 152'000);
  // at 0.06 the way back is longer than the way on: only the braking is left
  ASSERT_TRUE(reach({2, 1, 500'000, 60'000}));
  expect_box(500'000 - 1'000 - 8'402, 500'000 + 1'000 + 11'200 + 32'402, 162'000);
}

// verifies: SK-RB-4
TEST_F(ReachBox, MeasuredAboveTheLargestWithinTheErrorCountsAsTheLargest) {
  ASSERT_TRUE(reach({2, 1, 500'000, 702'000}));
  expect_box(500'000 - 1'000, 500'000 + 1'000 + 70'000 + 140'002, 702'000 - 2'000);
}

// verifies: SK-RB-5, SK-RB-8
TEST_F(ReachBox, StandingUnderCommands) {
  // c = 30000 + 2000 upward: 3200 - 30000^2 / 2e6 = 2750; c = 10000 + 2000 downward: 1200 - 10000^2 / 2e6 = 1150
  ASSERT_TRUE(reach({2, 1, 500'000, 0, SK_REACH_COMMANDED, -10'000, 30'000}));
  expect_box(500'000 - 1'000 - 1'150 - 2'402, 500'000 + 1'000 + 2'750 + 6'402, 32'000);
  // all commands upward: downward only s + error = 4000 is left
  ASSERT_TRUE(reach({2, 1, 500'000, 0, SK_REACH_COMMANDED, 10'000, 30'000}));
  expect_box(500'000 - 1'000 - 398 - 802, 500'000 + 1'000 + 2'750 + 6'402, 32'000);
}

// verifies: SK-RB-5, SK-RB-7
TEST_F(ReachBox, MovingUnderCommands) {
  // faster than the commands: c = s + error; downward the joint has no reason to turn: c = -5000 + 2000 < 0
  ASSERT_TRUE(reach({2, 1, 500'000, 8'000, SK_REACH_COMMANDED, 5'000, 6'000}));
  expect_box(500'000 - 1'000, 500'000 + 1'000 + 1'198 + 2'402, 12'000);
  // commands beyond the joint's largest speed: capped there
  ASSERT_TRUE(reach({2, 1, 500'000, 650'000, SK_REACH_COMMANDED, 650'000, 5'000'000}));
  expect_box(500'000 - 1'000, 500'000 + 1'000 + 68'848 + 140'002, 700'000);
}

// verifies: SK-RB-6
TEST_F(ReachBox, EveryTermIsRoundedOutward) {
  parameters.state_latency_us = 1;
  parameters.cycle_us = 0;
  parameters.command_latency_us = 0;
  parameters.velocity_error_urad_s[2] = 1;
  // s = 1, one more after a microsecond, 2e-6 urad of way counts as 1
  ASSERT_TRUE(reach({}));
  expect_box(500'000 - 1'000 - 1 - 3, 500'000 + 1'000 + 1 + 3, 2);
  // from rest at 1 urad/s2 for 1.5 s: 1.125 urad. Speed 1.5 counts as 2, 3 urad; the ramp to 1.5 saves 1.125, counted as 1^2 / 2 = 0
  parameters.state_latency_us = 1'000'000;
  parameters.command_latency_us = 500'000;
  parameters.acceleration_max_urad_s2[2] = 1;
  parameters.velocity_error_urad_s[2] = 0;
  ASSERT_TRUE(reach({}));
  expect_box(500'000 - 1'000 - 3 - 3, 500'000 + 1'000 + 3 + 3, 2);
}

// verifies: SK-RB-3
TEST_F(ReachBox, OtherJointsAreNotTouched) {
  for (int joint = 0; joint < SK_JOINTS; ++joint) {
    ASSERT_TRUE(reach({joint, 0, 0, 0}));
    sk_reach_box expected = untouched_box();
    expected.low_urad[joint] = -1'000 - 5'200 - 10'200 - joint;
    expected.high_urad[joint] = 1'000 + 5'200 + 10'200 + joint;
    expected.speed_urad_s[joint] = 102'000;
    EXPECT_TRUE(same(box, expected)) << joint;
  }
}

// verifies: SK-RB-3
TEST_F(ReachBox, RefusesMeasurementsOutOfRange) {
  for (const std::int32_t outside : {kMin32, -1, 4, kMax32}) {
    EXPECT_TRUE(refused({outside}));
    EXPECT_TRUE(refused({2, outside}));
  }
  for (const std::int32_t angle : {kMin32, -10'000'001, 10'000'001, kMax32}) EXPECT_TRUE(refused({2, 1, angle})) << angle;
  for (const std::int32_t angle : {-10'000'000, 10'000'000}) EXPECT_TRUE(reach({2, 1, angle})) << angle;
  for (const std::int32_t velocity : {kMin32, -702'001, 702'001, kMax32}) EXPECT_TRUE(refused({2, 1, 0, velocity})) << velocity;
  for (const std::int32_t velocity : {-702'000, 702'000}) EXPECT_TRUE(reach({2, 1, 0, velocity})) << velocity;
  parameters.velocity_max_urad_s[2] = 5'000'000;
  for (const std::int32_t velocity : {-5'000'001, 5'000'001}) EXPECT_TRUE(refused({2, 1, 0, velocity})) << velocity;
  for (const std::int32_t velocity : {-5'000'000, 5'000'000}) EXPECT_TRUE(reach({2, 1, 0, velocity})) << velocity;
}

// verifies: SK-RB-3
TEST_F(ReachBox, RefusesCommandsOutOfRange) {
  for (const std::int32_t mode : {kMin32, -1, 2, kMax32}) EXPECT_TRUE(refused({2, 1, 0, 0, mode, 0, 0})) << mode;
  EXPECT_TRUE(refused({2, 1, 0, 0, SK_REACH_COMMANDED, 1, 0}));
  EXPECT_TRUE(refused({2, 1, 0, 0, SK_REACH_COMMANDED, -5'000'001, 0}));
  EXPECT_TRUE(refused({2, 1, 0, 0, SK_REACH_COMMANDED, 0, 5'000'001}));
  EXPECT_TRUE(refused({2, 1, 0, 0, SK_REACH_COMMANDED, kMin32, kMax32}));
  EXPECT_TRUE(reach({2, 1, 0, 0, SK_REACH_COMMANDED, -5'000'000, 5'000'000}));
  ASSERT_TRUE(reach({}));
  const sk_reach_box any = box;
  ASSERT_TRUE(reach({2, 1, 500'000, 0, SK_REACH_ANY, kMax32, kMin32}));  // not read
  EXPECT_TRUE(same(box, any));
}

// verifies: SK-RB-3
TEST_F(ReachBox, RefusesParametersOutOfRange) {
  for (const std::int32_t bad : {kMin32, -1, 1'000'001, kMax32}) {
    EXPECT_TRUE(refused_with([&](berm_parameters& p) { p.state_latency_us = bad; })) << bad;
    EXPECT_TRUE(refused_with([&](berm_parameters& p) { p.cycle_us = bad; })) << bad;
    EXPECT_TRUE(refused_with([&](berm_parameters& p) { p.command_latency_us = bad; })) << bad;
    EXPECT_TRUE(refused_with([&](berm_parameters& p) { p.angle_error_urad[2] = bad; })) << bad;
    EXPECT_TRUE(refused_with([&](berm_parameters& p) { p.velocity_error_urad_s[2] = bad; })) << bad;
  }
  for (const std::int32_t bad : {kMin32, -1, 5'000'001, kMax32}) {
    EXPECT_TRUE(refused_with([&](berm_parameters& p) { p.velocity_max_urad_s[2] = bad; })) << bad;
  }
  for (const std::int32_t bad : {kMin32, -1, 0, 100'000'001, kMax32}) {
    EXPECT_TRUE(refused_with([&](berm_parameters& p) { p.acceleration_max_urad_s2[2] = bad; })) << bad;
  }
  for (const std::int32_t bad : {kMin32, -1, 100'000'001, kMax32}) {
    EXPECT_TRUE(refused_with([&](berm_parameters& p) { p.brake_angle_urad[2][1][2] = bad; })) << bad;
  }
}

// Nothing overflows at the ends of every range.
// verifies: SK-RB-3, SK-RB-4
TEST_F(ReachBox, LargestValues) {
  parameters.state_latency_us = parameters.cycle_us = parameters.command_latency_us = 1'000'000;
  parameters.velocity_max_urad_s[2] = 5'000'000;
  parameters.acceleration_max_urad_s2[2] = 100'000'000;
  parameters.angle_error_urad[2] = parameters.velocity_error_urad_s[2] = 1'000'000;
  parameters.brake_angle_urad[2][1][7] = 100'000'000;
  // 15 rad less the ramp of 4 rad/s at 100 rad/s2 (80 mrad)
  ASSERT_TRUE(reach({2, 1, 10'000'000, 0}));
  expect_box(-(100'000'000 + 14'920'000 + 1'000'000 - 10'000'000), 10'000'000 + 1'000'000 + 14'920'000 + 100'000'000, 5'000'000);
  ASSERT_TRUE(reach({2, 1, -10'000'000, -5'000'000}));
  // from 4 rad/s upward to 5 downward: 15 rad less 9 rad/s squared over 200 rad/s2
  expect_box(-10'000'000 - 1'000'000 - 15'000'000 - 100'000'000, -10'000'000 + 1'000'000 + 15'000'000 - 405'000 + 100'000'000, 5'000'000);
}

// verifies: SK-RB-7, SK-RB-9
TEST_F(ReachBox, AJointThatCannotMoveNeedsNoTable) {
  parameters.velocity_max_urad_s[2] = 0;
  ASSERT_TRUE(reach({2, -1, 500'000, 0}));
  expect_box(500'000 - 1'000, 500'000 + 1'000, 0);
  parameters.velocity_max_urad_s[2] = 700'000;
  EXPECT_TRUE(refused({2, -1, 500'000, 0}));
}

}  // namespace
}  // namespace berm::core_test
