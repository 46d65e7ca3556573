#include "geometry/joint_history.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace berm::kernel::test {
namespace {

bool push(JointHistory& history, int64_t time_us, int32_t swing, int32_t boom = 0, int32_t stick = 0, int32_t bucket = 0) {
  const int32_t urad[4] = {swing, boom, stick, bucket};
  return history.push(time_us, urad);
}

} // namespace

// verifies: SK-GE-20
TEST(JointHistory, InterpolatesLinearly) {
  JointHistory history;
  ASSERT_TRUE(push(history, 1000, 0, 100000, -200000, 0));
  ASSERT_TRUE(push(history, 11000, 50000, 200000, -100000, 1000000));
  ASSERT_TRUE(push(history, 21000, 50000, 0, 0, 0));
  const auto at = history.at(3500);
  EXPECT_TRUE(at.inside);
  EXPECT_NEAR(at.angles.swing, 0.0125, 1e-12);
  EXPECT_NEAR(at.angles.boom, 0.125, 1e-12);
  EXPECT_NEAR(at.angles.stick, -0.175, 1e-12);
  EXPECT_NEAR(at.angles.bucket, 0.25, 1e-12);
  EXPECT_NEAR(history.at(16000).angles.bucket, 0.5, 1e-12);
  EXPECT_NEAR(history.at(11000).angles.boom, 0.2, 1e-12);
}

// verifies: SK-GE-21
TEST(JointHistory, ClampsAndSaysSoOutsideItsTime) {
  JointHistory history;
  EXPECT_FALSE(history.at(5).inside);
  ASSERT_TRUE(push(history, 1000, 1000000));
  ASSERT_TRUE(push(history, 2000, 2000000));
  EXPECT_FALSE(history.at(999).inside);
  EXPECT_DOUBLE_EQ(history.at(999).angles.swing, 1.0);
  EXPECT_FALSE(history.at(2001).inside);
  EXPECT_DOUBLE_EQ(history.at(2001).angles.swing, 2.0);
  EXPECT_TRUE(history.at(1000).inside);
  EXPECT_TRUE(history.at(2000).inside);
  history.clear();
  EXPECT_FALSE(history.at(1500).inside);
}

// verifies: SK-GE-21
TEST(JointHistory, RefusesTimeThatDoesNotAdvance) {
  JointHistory history;
  ASSERT_TRUE(push(history, 1000, 1000000));
  EXPECT_FALSE(push(history, 1000, 2000000));
  EXPECT_FALSE(push(history, 999, 2000000));
  EXPECT_EQ(history.size(), 1);
  EXPECT_DOUBLE_EQ(history.at(1000).angles.swing, 1.0);
}

// verifies: SK-GE-20
// verifies: SK-GE-21
TEST(JointHistory, KeepsTheNewestStatesAndForgetsOlder) {
  JointHistory history;
  constexpr int pushed = 3 * JointHistory::capacity + 5;
  for (int i = 0; i < pushed; ++i) ASSERT_TRUE(push(history, 1000 * i, 1000 * i));
  EXPECT_EQ(history.size(), JointHistory::capacity);
  const int oldest = pushed - JointHistory::capacity;
  EXPECT_TRUE(history.at(1000 * oldest).inside);
  EXPECT_FALSE(history.at(1000 * oldest - 1).inside);
  for (int i = oldest; i + 1 < pushed; ++i) {
    const auto at = history.at(1000 * i + 250);
    ASSERT_TRUE(at.inside);
    ASSERT_NEAR(at.angles.swing, (1000 * i + 250) * 1e-6, 1e-12);
  }
}

// An encoder that wraps at half a turn must not sweep the scan through the whole circle.
// verifies: SK-GE-20
TEST(JointHistory, InterpolatesTheSwingTheShortWayRound) {
  JointHistory history;
  ASSERT_TRUE(push(history, 0, 3131593));
  ASSERT_TRUE(push(history, 1000, -3131592)); // 0.02 rad on, across the half turn
  const double swing = history.at(500).angles.swing;
  EXPECT_NEAR(std::cos(swing), -1.0, 1e-9);
  EXPECT_NEAR(std::sin(swing), 0.0, 1e-5);
}

} // namespace berm::kernel::test
