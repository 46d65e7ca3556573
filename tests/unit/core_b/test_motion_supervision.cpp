#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>

#include "contract/berm_contract.h"
#include "core/motion_supervision.h"
#include "reach_parameters.hpp"

namespace berm::core_test {
namespace {

constexpr std::int32_t kMin32 = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMax32 = std::numeric_limits<std::int32_t>::max();
constexpr int kJoint = 2;

// Errors 1000 urad and 2000 urad/s; column k: 100000 k urad/s, stops within (row + 1) (10000 k) + 2 urad and (row + 1) 100000 k us; state latency
// 20000 us; standstill 5000 urad/s.
berm_parameters supervised_parameters() {
  berm_parameters p = reach_parameters();
  p.standstill_urad_s = 5'000;
  for (auto& joint : p.brake_time_us)
    for (int row = 0; row < BERM_BRAKE_REACHES; ++row)
      for (int column = 0; column < BERM_BRAKE_SPEEDS; ++column) joint[row][column] = (row + 1) * column * 100'000;
  return p;
}

struct Reading {
  std::int64_t now_us = 1'000'000;
  std::int32_t angle_urad = 500'000, velocity_urad_s = 0, low_urad_s = 0, high_urad_s = 0, row = 1, joint = kJoint;
};

// Runs every case in both directions: what happens upward must happen downward to the mirrored joint.
class MotionSupervision : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override { sk_motion_begin(&state); }
  std::int32_t step(const Reading& r) {
    const bool down = GetParam();
    const sk_motion_reading reading = {r.now_us, r.joint, r.row, down ? -r.angle_urad : r.angle_urad, down ? -r.velocity_urad_s : r.velocity_urad_s,
                                       down ? -r.low_urad_s : r.high_urad_s};
    return sk_motion_step(&state, &parameters, reading, down ? -r.high_urad_s : r.low_urad_s);
  }
  // What the case returns from the state of now, which is kept.
  std::int32_t tried(const Reading& r) {
    const sk_motion_joint was = state;
    const std::int32_t result = step(r);
    state = was;
    return result;
  }
  const sk_motion_side& side() const { return GetParam() ? state.down : state.up; }

  berm_parameters parameters = supervised_parameters();
  sk_motion_joint state{};
};

INSTANTIATE_TEST_SUITE_P(BothDirections, MotionSupervision, testing::Bool(), [](const auto& direction) { return direction.param ? "down" : "up"; });

// verifies: SK-MS-1, SK-MS-8
TEST_P(MotionSupervision, TheFirstReadingIsTakenAsItIs) {
  EXPECT_EQ(step({1'000'000, 500'000, 650'000}), BERM_STOP_NONE);
  EXPECT_EQ(side().ceiling_urad_s, 656'000);
  EXPECT_EQ(tried({1'010'000, 500'000, 656'000}), BERM_STOP_NONE);
  EXPECT_EQ(tried({1'010'000, 500'000, 656'001}), BERM_STOP_UNCOMMANDED);
}

// verifies: SK-MS-1
TEST_P(MotionSupervision, AJointMayFollowACommandWithTwoErrors) {
  ASSERT_EQ(step({}), BERM_STOP_NONE);
  EXPECT_EQ(side().ceiling_urad_s, 6'000);  // at rest: 0 + 3 e
  EXPECT_EQ(tried({1'010'000, 500'000, 54'000, 0, 50'000}), BERM_STOP_NONE);
  EXPECT_EQ(tried({1'010'000, 500'000, 54'001, 0, 50'000}), BERM_STOP_UNCOMMANDED);
  EXPECT_EQ(tried({1'010'000, 500'000, 54'001, 50'000, 50'000}), BERM_STOP_UNCOMMANDED);
  EXPECT_EQ(tried({1'010'000, 500'000, -54'000, -50'000, 0}), BERM_STOP_NONE);
  EXPECT_EQ(tried({1'010'000, 500'000, -54'001, -50'000, 0}), BERM_STOP_UNCOMMANDED);
  // stalled is no fault
  EXPECT_EQ(tried({1'010'000, 500'000, 0, 50'000, 50'000}), BERM_STOP_NONE);
}

// verifies: SK-MS-1
TEST_P(MotionSupervision, AJointAtRestMayNotMoveWithoutACommand) {
  ASSERT_EQ(step({}), BERM_STOP_NONE);
  EXPECT_EQ(tried({1'010'000, 500'000, 6'000}), BERM_STOP_NONE);
  EXPECT_EQ(tried({1'010'000, 500'000, 6'001}), BERM_STOP_UNCOMMANDED);
  // a command the other way is none
  EXPECT_EQ(tried({1'010'000, 500'000, 6'001, -600'000, 0}), BERM_STOP_UNCOMMANDED);
  EXPECT_EQ(tried({1'010'000, 500'000, 6'001, -600'000, -600'000}), BERM_STOP_UNCOMMANDED);
}

// verifies: SK-MS-2
TEST_P(MotionSupervision, ASpeedThatWasLostDoesNotComeBack) {
  ASSERT_EQ(step({1'000'000, 500'000, 300'000, 300'000, 300'000}), BERM_STOP_NONE);
  ASSERT_EQ(step({1'010'000, 503'000, 280'000, 100'000, 300'000}), BERM_STOP_NONE);
  EXPECT_EQ(side().ceiling_urad_s, 304'000);  // a command of 300000 may still be in force
  ASSERT_EQ(step({1'020'000, 506'000, 250'000, 100'000, 100'000}), BERM_STOP_NONE);
  EXPECT_EQ(side().ceiling_urad_s, 256'000);
  EXPECT_EQ(tried({1'030'000, 508'000, 256'000, 100'000, 100'000}), BERM_STOP_NONE);
  EXPECT_EQ(tried({1'030'000, 508'000, 256'001, 100'000, 100'000}), BERM_STOP_UNCOMMANDED);
  ASSERT_EQ(step({1'030'000, 508'000, 90'000, 100'000, 100'000}), BERM_STOP_NONE);
  EXPECT_EQ(side().ceiling_urad_s, 104'000);  // not 96000: the command allows it
}

// verifies: SK-MS-3
TEST_P(MotionSupervision, BrakingEndsWithinTheTablesAngle) {
  ASSERT_EQ(step({1'000'000, 500'000, 98'000, -300'000, 0}), BERM_STOP_NONE);  // + e: column 1 of row 1
  EXPECT_EQ(side().limit_urad, 522'002);
  EXPECT_EQ(tried({1'010'000, 522'002, 90'000}), BERM_STOP_NONE);
  EXPECT_EQ(tried({1'010'000, 522'003, 90'000}), BERM_STOP_BRAKING);
  EXPECT_EQ(tried({1'010'000, 522'003, 0}), BERM_STOP_BRAKING);           // even if it stands there
  EXPECT_EQ(tried({1'010'000, 522'003, 90'000, 0, 1}), BERM_STOP_NONE);   // asked to move on; within the ceiling
  // one unit faster: on the chord to the next column
  sk_motion_begin(&state);
  ASSERT_EQ(step({1'000'000, 500'000, 98'001}), BERM_STOP_NONE);
  EXPECT_EQ(side().limit_urad, 522'003);
  // above the table within the error: its last column
  sk_motion_begin(&state);
  ASSERT_EQ(step({1'000'000, 500'000, 702'000}), BERM_STOP_NONE);
  EXPECT_EQ(side().limit_urad, 500'000 + 2'000 + 140'002);
}

// verifies: SK-MS-4
TEST_P(MotionSupervision, BrakingEndsWithinTheTablesTime) {
  ASSERT_EQ(step({1'000'000, 500'000, 98'000}), BERM_STOP_NONE);
  EXPECT_EQ(side().deadline_us, 1'220'000);
  EXPECT_EQ(tried({1'220'000, 500'000, 5'001}), BERM_STOP_NONE);
  EXPECT_EQ(tried({1'220'001, 500'000, 5'001}), BERM_STOP_BRAKING);
  EXPECT_EQ(tried({1'220'001, 500'000, 5'000}), BERM_STOP_NONE);
  parameters.standstill_urad_s = 1;  // less than two errors of the speed cannot be told from rest
  EXPECT_EQ(tried({1'220'001, 500'000, 4'000}), BERM_STOP_NONE);
  EXPECT_EQ(tried({1'220'001, 500'000, 4'001}), BERM_STOP_BRAKING);
}

// verifies: SK-MS-5
TEST_P(MotionSupervision, EveryReadingTightensTheBounds) {
  ASSERT_EQ(step({1'000'000, 500'000, 390'000}), BERM_STOP_NONE);  // a fifth of it with e, as row 1 has it
  EXPECT_EQ(side().limit_urad, 580'402);
  EXPECT_EQ(side().deadline_us, 1'820'000);
  ASSERT_EQ(step({1'100'000, 510'000, 190'000}), BERM_STOP_NONE);
  EXPECT_EQ(side().limit_urad, 550'402);
  EXPECT_EQ(side().deadline_us, 1'520'000);
  ASSERT_EQ(step({1'200'000, 545'000, 190'000}), BERM_STOP_NONE);  // later and farther: the earlier ones hold
  EXPECT_EQ(side().limit_urad, 550'402);
  EXPECT_EQ(side().deadline_us, 1'520'000);
  EXPECT_EQ(step({1'210'000, 550'403, 190'000}), BERM_STOP_BRAKING);
}

// verifies: SK-MS-6
TEST_P(MotionSupervision, AFartherReachBeginsAnewAndANearerDoesNot) {
  ASSERT_EQ(step({1'000'000, 500'000, 98'000, 0, 0, 1}), BERM_STOP_NONE);
  ASSERT_EQ(step({1'010'000, 501'000, 98'000, 0, 0, 0}), BERM_STOP_NONE);
  EXPECT_EQ(side().row, 1);
  EXPECT_EQ(side().limit_urad, 522'002);
  EXPECT_EQ(tried({1'020'000, 522'003, 98'000, 0, 0, 0}), BERM_STOP_BRAKING);
  ASSERT_EQ(step({1'020'000, 522'003, 98'000, 0, 0, 2}), BERM_STOP_NONE);
  EXPECT_EQ(side().row, 2);
  EXPECT_EQ(side().limit_urad, 522'003 + 2'000 + 30'002);
  EXPECT_EQ(side().deadline_us, 1'020'000 + 20'000 + 300'000);
}

// verifies: SK-MS-7
TEST_P(MotionSupervision, AFaultThatIsOverCanBeReset) {
  ASSERT_EQ(step({1'000'000, 500'000, 98'000}), BERM_STOP_NONE);
  ASSERT_EQ(step({1'010'000, 522'003, 98'000}), BERM_STOP_BRAKING);
  EXPECT_EQ(side().limit_urad, 522'003 + 22'002);
  EXPECT_EQ(step({1'020'000, 522'100, 0}), BERM_STOP_NONE);
  ASSERT_EQ(step({1'030'000, 522'100, 50'000}), BERM_STOP_UNCOMMANDED);
  EXPECT_EQ(step({1'040'000, 522'100, 50'000}), BERM_STOP_UNCOMMANDED) << "as long as it lasts";
  EXPECT_EQ(step({1'050'000, 522'100, 0}), BERM_STOP_NONE);
}

// verifies: SK-MS-9
TEST_P(MotionSupervision, RefusesWhatIsOutOfRangeAndChangesNothing) {
  ASSERT_EQ(step({1'000'000, 500'000, 98'000}), BERM_STOP_NONE);
  const auto refused = [&](const Reading& r) {
    const sk_motion_side up = state.up, down = state.down;
    const std::int32_t result = step(r);
    const auto same = [](const sk_motion_side& a, const sk_motion_side& b) {
      return a.limit_urad == b.limit_urad && a.deadline_us == b.deadline_us && a.ceiling_urad_s == b.ceiling_urad_s && a.row == b.row && a.bound == b.bound;
    };
    return result == BERM_STOP_INTERNAL && same(up, state.up) && same(down, state.down);
  };
  for (const std::int64_t now : {std::int64_t{-1}, std::int64_t{SK_MOTION_NOW_MAX_US} + 1, std::numeric_limits<std::int64_t>::min()}) EXPECT_TRUE(refused({now}));
  for (const std::int32_t bad : {-10'000'001, 10'000'001}) EXPECT_TRUE(refused({2'000'000, bad}));
  for (const std::int32_t bad : {-5'000'001, 5'000'001}) {
    EXPECT_TRUE(refused({2'000'000, 0, bad}));
    EXPECT_TRUE(refused({2'000'000, 0, 0, bad}));
    EXPECT_TRUE(refused({2'000'000, 0, 0, 0, bad}));
  }
  for (const std::int32_t bad : {kMin32, -1, 4, kMax32}) {
    EXPECT_TRUE(refused({2'000'000, 0, 0, 0, 0, bad}));
    EXPECT_TRUE(refused({2'000'000, 0, 0, 0, 0, 1, bad}));
  }
  const auto refused_with = [&](const std::function<void(berm_parameters&)>& change) {
    const berm_parameters was = parameters;
    change(parameters);
    const bool result = refused({2'000'000, 500'000, 1'000});
    parameters = was;
    return result;
  };
  for (const std::int32_t bad : {kMin32, -1, 5'000'001, kMax32}) EXPECT_TRUE(refused_with([&](auto& p) { p.standstill_urad_s = bad; }));
  for (const std::int32_t bad : {kMin32, -1, 1'000'001}) EXPECT_TRUE(refused_with([&](auto& p) { p.state_latency_us = bad; }));
  for (const std::int32_t bad : {kMin32, -1, 1'000'001}) EXPECT_TRUE(refused_with([&](auto& p) { p.velocity_error_urad_s[kJoint] = bad; }));
  // the entry that either direction needs: all columns, so that the refusal comes before anything changes
  for (const std::int32_t bad : {kMin32, -1, 100'000'001, kMax32}) {
    EXPECT_TRUE(refused_with([&](auto& p) { for (auto& entry : p.brake_angle_urad[kJoint][1]) entry = bad; }));
    EXPECT_TRUE(refused_with([&](auto& p) { for (auto& entry : p.brake_time_us[kJoint][1]) entry = bad; }));
  }
}

// verifies: SK-RB-2
TEST(BrakeTime, IsThatOfTheNextFasterColumn) {
  berm_parameters p = supervised_parameters();
  EXPECT_EQ(sk_brake_time(&p, 2, 1, kMin32), 0);
  EXPECT_EQ(sk_brake_time(&p, 2, 1, 0), 0);
  EXPECT_EQ(sk_brake_time(&p, 2, 1, 1), 200'000);
  EXPECT_EQ(sk_brake_time(&p, 2, 1, 100'000), 200'000);
  EXPECT_EQ(sk_brake_time(&p, 2, 1, 100'001), 400'000);
  EXPECT_EQ(sk_brake_time(&p, 3, 3, 700'000), 2'800'000);
  for (const std::int32_t speed : {700'001, kMax32}) EXPECT_EQ(sk_brake_time(&p, 2, 1, speed), -1);
  for (const std::int32_t bad : {kMin32, -1, 4, kMax32}) {
    EXPECT_EQ(sk_brake_time(&p, bad, 1, 0), -1);
    EXPECT_EQ(sk_brake_time(&p, 2, bad, 0), -1);
  }
  for (const std::int32_t bad : {kMin32, -1, 100'000'001, kMax32}) {
    p.brake_time_us[2][1][0] = bad;
    EXPECT_EQ(sk_brake_time(&p, 2, 1, 0), -1);
  }
  p.brake_time_us[2][1][0] = 100'000'000;
  EXPECT_EQ(sk_brake_time(&p, 2, 1, 0), 100'000'000);
  p.velocity_max_urad_s[2] = -1;
  EXPECT_EQ(sk_brake_time(&p, 2, 1, -5), -1);
}

}  // namespace
}  // namespace berm::core_test
