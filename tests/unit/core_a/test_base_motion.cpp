// Base motion: exact limits, the majority's count, wrap-around, ages, the reference.
#include <gtest/gtest.h>

#include <limits>

#include "core/base_motion.h"
#include "valid_parameters.hpp"

namespace berm::core_test {
namespace {

constexpr std::int32_t kPi = 3141593;

class BaseMotion : public ::testing::Test {
 protected:
  BaseMotion() { sk_base_init(&base); }
  void learn(std::int32_t roll, std::int32_t pitch, std::int32_t track) {
    sk_base_attitude(&base, &p, roll, pitch, 0);
    sk_base_azimuth(&base, &p, track, 0);
    ASSERT_TRUE(sk_base_learn(&base, &p, 0));
  }
  void tilt(std::int32_t roll, std::int32_t pitch, int frames) {
    for (int i = 0; i < frames; ++i) sk_base_attitude(&base, &p, roll, pitch, 0);
  }
  void turn(std::int32_t track, int frames) {
    for (int i = 0; i < frames; ++i) sk_base_azimuth(&base, &p, track, 0);
  }
  const berm_parameters p = valid_parameters();
  sk_base_state base;
};

// verifies: SK-BM-2
TEST_F(BaseMotion, ATiltAtTheLimitIsNoneAndOneBeyondIsFoundAfterFifteenFrames) {
  for (const int sign : {-1, 1}) {
    for (const bool pitch : {false, true}) {
      sk_base_init(&base);
      learn(1000, -2000, 0);
      const auto at = [&](std::int32_t by, int frames) { tilt(1000 + (pitch ? 0 : sign * by), -2000 + (pitch ? sign * by : 0), frames); };
      at(p.base_tilt_urad, 100);
      EXPECT_FALSE(base.moved);
      at(p.base_tilt_urad + 1, SK_BASE_TILT_FRAMES - 1);
      EXPECT_FALSE(base.moved);
      at(p.base_tilt_urad + 1, 1);
      EXPECT_TRUE(base.moved);
    }
  }
}

// verifies: SK-BM-3
TEST_F(BaseMotion, OneFrameBeyondTheHardLimitIsEnough) {
  learn(0, 0, 0);
  tilt(p.base_tilt_hard_urad, 0, 1);
  tilt(0, -p.base_tilt_hard_urad, 1);
  EXPECT_FALSE(base.moved);
  tilt(0, -p.base_tilt_hard_urad - 1, 1);
  EXPECT_TRUE(base.moved);
}

// verifies: SK-BM-2
TEST_F(BaseMotion, ARockingBaseHasNotMovedUnlessMostFramesLieBeyond) {
  learn(0, 0, 0);
  for (int i = 0; i < 1000; ++i) tilt(i % 2 == 0 ? p.base_tilt_urad + 1 : 0, 0, 1);
  EXPECT_FALSE(base.moved) << "half of the frames";
  int frames = 0;
  for (; frames < 1000 && !base.moved; ++frames) tilt(frames % 3 != 0 ? p.base_tilt_urad + 1 : 0, 0, 1);
  EXPECT_LE(frames, 3 * SK_BASE_TILT_FRAMES + 3) << "two thirds of the frames";
}

// verifies: SK-BM-4
TEST_F(BaseMotion, TheTracksAzimuthIsComparedTheShorterWayRound) {
  learn(0, 0, kPi - 100);
  turn(-kPi + p.base_azimuth_urad - 100, 20);  // just within, across the seam
  EXPECT_FALSE(base.moved);
  turn(-kPi + p.base_azimuth_urad - 90, SK_BASE_TURN_FRAMES - 1);
  EXPECT_FALSE(base.moved);
  turn(-kPi + p.base_azimuth_urad - 90, 1);
  EXPECT_TRUE(base.moved);
}

// verifies: SK-BM-4
TEST(BaseApart, AgreesWithAPlainStatementAtEveryCorner) {
  const std::int32_t corner[] = {std::numeric_limits<std::int32_t>::min(), -SK_TURN_URAD, -kPi, -1, 0, 1, kPi, SK_TURN_URAD - 1, SK_TURN_URAD, std::numeric_limits<std::int32_t>::max()};
  for (const std::int64_t a : corner)
    for (const std::int64_t b : corner) {
      std::int64_t apart = a > b ? a - b : b - a;
      while (apart >= SK_TURN_URAD) apart -= SK_TURN_URAD;
      if (SK_TURN_URAD - apart < apart) apart = SK_TURN_URAD - apart;
      EXPECT_EQ(sk_base_apart(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)), apart) << a << " and " << b;
    }
}

// verifies: SK-BM-5
TEST_F(BaseMotion, MovedStaysUntilAReferenceIsTakenAnew) {
  learn(0, 0, 0);
  tilt(p.base_tilt_hard_urad + 1, 0, 1);
  tilt(0, 0, 1000);
  turn(0, 100);
  EXPECT_TRUE(base.moved);
  ASSERT_TRUE(sk_base_learn(&base, &p, 0));
  EXPECT_FALSE(base.moved);
}

// verifies: SK-BM-1, SK-BM-6
TEST_F(BaseMotion, AReferenceNeedsBothMessagesNoOlderThanTheLimit) {
  EXPECT_FALSE(sk_base_learn(&base, &p, 0));
  sk_base_attitude(&base, &p, 5, 6, 1000);
  EXPECT_FALSE(sk_base_learn(&base, &p, 1000));
  sk_base_azimuth(&base, &p, 7, 2000);
  EXPECT_FALSE(sk_base_learn(&base, &p, 1999)) << "from the future";
  EXPECT_FALSE(sk_base_learn(&base, &p, 1000 + p.base_frame_age_us + 1));
  EXPECT_FALSE(base.learned);
  EXPECT_TRUE(sk_base_fresh(&base, &p, 1000 + p.base_frame_age_us));
  ASSERT_TRUE(sk_base_learn(&base, &p, 1000 + p.base_frame_age_us));
  EXPECT_EQ(base.learned_roll_urad, 5);
  EXPECT_EQ(base.learned_pitch_urad, 6);
  EXPECT_EQ(base.learned_track_urad, 7);
  sk_base_azimuth(&base, &p, 7, 1000 + p.base_frame_age_us);
  EXPECT_FALSE(sk_base_fresh(&base, &p, 1000 + p.base_frame_age_us + 1)) << "attitude alone is old";
}

// verifies: SK-BM-1
TEST_F(BaseMotion, NothingHasMovedBeforeThereIsAReference) {
  tilt(kPi, kPi, 100);
  turn(kPi, 100);
  EXPECT_FALSE(base.moved);
}

// verifies: SK-BM-24, SK-BM-5
TEST_F(BaseMotion, WhatTheTerrainShowsMovesABaseThatHasAReferenceUntilItIsLearnedAnew) {
  sk_base_slipped(&base);
  EXPECT_FALSE(base.moved) << "no reference yet: nothing has moved";
  learn(0, 0, 0);
  const sk_base_state before = base;
  sk_base_slipped(&base);
  EXPECT_TRUE(base.moved);
  EXPECT_EQ(base.tilt_frames, before.tilt_frames);
  tilt(0, 0, 100);
  EXPECT_TRUE(base.moved);
  learn(0, 0, 0);
  EXPECT_FALSE(base.moved);
}

}  // namespace
}  // namespace berm::core_test
