// Joint agreement: an angle against its speed, in numbers small enough to follow by hand.
#include <gtest/gtest.h>

#include "contract/berm_contract.h"
#include "core/joint_agreement.h"
#include "reach_parameters.hpp"

namespace berm::core_test {
namespace {

constexpr int kJoint = 1;
constexpr std::int64_t kGap = 10'000;

class JointAgreement : public testing::Test {
 protected:
  JointAgreement() { sk_agreement_begin(&span); }
  std::int32_t read(std::int64_t us, std::int32_t angle, std::int32_t velocity, std::int32_t latency_us = 0) {
    return sk_agreement_step(&span, &p, {us, kJoint, angle, velocity, latency_us});
  }
  // Readings of a standing joint up to the time, this one left out.
  void stand_until(std::int64_t us, std::int32_t angle = 0) {
    for (std::int64_t t = 0; t < us; t += kGap) ASSERT_EQ(read(t, angle, 0), BERM_STOP_NONE) << t;
  }
  berm_parameters p = reach_parameters();
  sk_agreement span{};
};

// verifies: SK-MS-12
TEST_F(JointAgreement, TheAllowanceIsTwoErrorsOfTheAngleAndWhatErrorAndAccelerationLeaveOfTheSpeed) {
  // 10 ms at 0: 2 x 1000 urad, 10 ms x 2000 urad/s = 20 urad, 10 ms x (1 rad/s2 x 10 ms / 4 = 2500 urad/s, and half a urad/s of rounding) = 25.005 urad.
  read(0, 0, 0);
  EXPECT_EQ(read(kGap, 2045, 0), BERM_STOP_NONE);
  sk_agreement_begin(&span);
  read(0, 0, 0);
  EXPECT_EQ(read(kGap, 2046, 0), BERM_STOP_STATE_FRAME);
  sk_agreement_begin(&span);
  read(0, 0, 0);
  EXPECT_EQ(read(kGap, -2046, 0), BERM_STOP_STATE_FRAME);
}

// verifies: SK-MS-12
TEST_F(JointAgreement, TheWayIsThatOfTheMeanSpeedAndAChangeAllowsHalfOfItself) {
  // From 0 to 0.1 rad/s in 10 ms: 500 urad, and 500 more or less, besides the 2045.
  read(0, 0, 0);
  EXPECT_EQ(read(kGap, 500 + 500 + 2045, 100'000), BERM_STOP_NONE);
  sk_agreement_begin(&span);
  read(0, 0, 0);
  EXPECT_EQ(read(kGap, 500 + 500 + 2046, 100'000), BERM_STOP_STATE_FRAME);
}

// verifies: SK-MS-12
TEST_F(JointAgreement, TheReadingsAgesMayShiftTheSpeedsByTheirLatency) {
  // At an even 0.1 rad/s with 20 ms of latency: twice 20 ms x (0.1 + 0.1 + 2 x 0.002) = 8160 urad, and 10 ms x (20 ms x 1 rad/s2 / 4) = 50 urad.
  read(0, 0, 100'000, 20'000);
  EXPECT_EQ(read(kGap, 1000 + 2045 + 8160 + 50, 100'000, 20'000), BERM_STOP_NONE);
  sk_agreement_begin(&span);
  read(0, 0, 100'000, 20'000);
  EXPECT_EQ(read(kGap, 1000 + 2046 + 8160 + 50, 100'000, 20'000), BERM_STOP_STATE_FRAME);
}

// verifies: SK-MS-12
TEST_F(JointAgreement, SoMayTheChangesOfTheSpeed) {
  // Up to 0.1 rad/s and down again, 1000 urad: 2 x 1000, 20 ms x 2000 urad/s, half of the changes 2 x 500, 2 x 10 ms x (30 ms x 1 rad/s2 / 4), and twice
  // 20 ms x (0.1 + 0.1 + 2 x 0.002).
  const auto there_and_back = [this](std::int32_t angle) {
    sk_agreement_begin(&span);
    read(0, 0, 0, 20'000);
    read(kGap, 500, 100'000, 20'000);
    return read(2 * kGap, angle, 0, 20'000);
  };
  EXPECT_EQ(there_and_back(1000 + 2000 + 40 + 1000 + 150 + 8160), BERM_STOP_NONE);
  EXPECT_EQ(there_and_back(1001 + 2000 + 40 + 1000 + 150 + 8160), BERM_STOP_STATE_FRAME);
}

// verifies: SK-MS-12
TEST_F(JointAgreement, TheMostLatencyOfTheSpanHolds) {
  read(0, 0, 100'000, 20'000);
  EXPECT_EQ(read(kGap, 1000 + 2045 + 8160 + 50, 100'000, 0), BERM_STOP_NONE);
}

// verifies: SK-MS-12
TEST_F(JointAgreement, AnAngleThatStandsWhileTheSpeedGoesOnDisagrees) {
  std::int64_t t = 0;
  while (t < 2 * SK_AGREE_SPAN_US && read(t, 0, 100'000) == BERM_STOP_NONE) t += kGap;
  EXPECT_LE(t, 40'000);
  EXPECT_GE(t, 20'000);
}

// verifies: SK-MS-12
TEST_F(JointAgreement, ASpeedThatStandsWhileTheAngleGoesOnDisagrees) {
  std::int64_t t = 0;
  while (t < 2 * SK_AGREE_SPAN_US && read(t, static_cast<std::int32_t>(t / 10), 0) == BERM_STOP_NONE) t += kGap;
  EXPECT_LE(t, 40'000);
}

// verifies: SK-MS-12
TEST_F(JointAgreement, AJumpOfTheAngleDisagrees) {
  stand_until(200'000);
  EXPECT_EQ(read(200'000, 10'000, 0), BERM_STOP_STATE_FRAME);
}

// verifies: SK-MS-13
TEST_F(JointAgreement, ASpanEndsAndTheNextBeginsWithItsLastReading) {
  // Drifting by 4 mrad in each 0.5 s, where a span allows 2 mrad and 4.5 a second: no span sees the drift of two.
  for (std::int64_t t = 0; t <= 4 * SK_AGREE_SPAN_US; t += kGap) ASSERT_EQ(read(t, static_cast<std::int32_t>(t * 4'000 / SK_AGREE_SPAN_US), 0), BERM_STOP_NONE) << t;
  EXPECT_LT(span.last_us - span.since_us, SK_AGREE_SPAN_US);
  EXPECT_GT(span.since_us, 3 * SK_AGREE_SPAN_US);
}

// verifies: SK-MS-13
TEST_F(JointAgreement, AGapBeginsASpan) {
  read(0, 0, 0);
  EXPECT_EQ(read(SK_AGREE_GAP_MOST_US + 1, 1'000'000, 0), BERM_STOP_NONE);
  EXPECT_EQ(span.since_us, SK_AGREE_GAP_MOST_US + 1);
  EXPECT_EQ(read(2 * SK_AGREE_GAP_MOST_US + 1, 0, 0), BERM_STOP_STATE_FRAME);
  EXPECT_EQ(read(2 * SK_AGREE_GAP_MOST_US + 1, 500'000, 0), BERM_STOP_NONE) << "time that stands begins a span";
}

// verifies: SK-MS-13
TEST_F(JointAgreement, AfterADisagreementTheReadingIsTakenAsItIs) {
  stand_until(100'000);
  ASSERT_EQ(read(100'000, 50'000, 0), BERM_STOP_STATE_FRAME);
  EXPECT_EQ(read(110'000, 50'000, 0), BERM_STOP_NONE);
}

// verifies: SK-MS-9
TEST_F(JointAgreement, WhatIsOutOfRangeIsInternalAndChangesNothing) {
  stand_until(100'000);
  const sk_agreement before = span;
  const sk_agreement_reading good{100'000, kJoint, 0, 0, 0};
  const auto refused = [&](sk_agreement_reading r) {
    EXPECT_EQ(sk_agreement_step(&span, &p, r), BERM_STOP_INTERNAL);
    EXPECT_EQ(span.since_us, before.since_us);
    EXPECT_EQ(span.last_us, before.last_us);
  };
  sk_agreement_reading r = good;
  r.joint = SK_JOINTS;
  refused(r);
  r = good;
  r.angle_urad = SK_REACH_ANGLE_MAX_URAD + 1;
  refused(r);
  r = good;
  r.velocity_urad_s = -SK_REACH_SPEED_MAX_URAD_S - 1;
  refused(r);
  r = good;
  r.latency_us = -1;
  refused(r);
  r = good;
  r.now_us = -1;
  refused(r);
  p.angle_error_urad[kJoint] = -1;
  refused(good);
}

}  // namespace
}  // namespace berm::core_test
