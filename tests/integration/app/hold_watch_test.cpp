// When the guard is taken to hold a motion back.
#include <gtest/gtest.h>

#include "app/hold_watch.hpp"

namespace berm::app {
namespace {

class HoldWatching : public testing::Test {
protected:
  // So long, with a cut in one cycle of every so many, and the swing moving on at this speed.
  void go(double seconds, int one_in, double swing_rad_s = 0.0) {
    for (double t = 0.0; t < seconds - 1e-9; t += cycle, ++cycles_) {
      time_s_ += cycle;
      angle_[swing] += swing_rad_s * cycle;
      watch_.step(time_s_, angle_, one_in > 0 && cycles_ % one_in == 0);
    }
  }

  static constexpr double cycle = 0.01;
  double time_s_ = 0.0;
  int cycles_ = 0;
  Joints angle_{};
  HoldWatch watch_;
};

TEST_F(HoldWatching, BeginsWithTheFirstCut) {
  go(5.0, 0);
  EXPECT_EQ(watch_.seconds(), 0.0);
  go(2.0, 1);
  EXPECT_NEAR(watch_.seconds(), 2.0, 0.02);
}

TEST_F(HoldWatching, GoesOnWhileItTremblesInAndOutOfTheMargins) {
  go(3.0, 7);
  EXPECT_NEAR(watch_.seconds(), 3.0, 0.02);
  for (int k = 0; k < 10; ++k) {
    go(0.1, 7, radians(3.0));
    go(0.1, 7, radians(-3.0));
  }
  EXPECT_NEAR(watch_.seconds(), 5.0, 0.02);
}

TEST_F(HoldWatching, EndsWithWhatIsNoLongerCut) {
  go(3.0, 1);
  go(HoldWatch::gap - 0.1, 0);
  EXPECT_GT(watch_.seconds(), 3.0);
  go(0.2, 0);
  EXPECT_EQ(watch_.seconds(), 0.0);
}

TEST_F(HoldWatching, EndsWithWhatGetsSomewhere) {
  go(3.0, 1);
  go(1.0, 1, radians(2.0));
  EXPECT_LT(watch_.seconds(), 0.6);
  go(60.0, 1, radians(5.0));
  EXPECT_LT(watch_.seconds(), 0.3) << "slowed, not held";
}

// Else what creeps on by leave of the kernel would stand again after each degree.
TEST_F(HoldWatching, OnceGivenUpItEndsWithTheCutsAlone) {
  go(HoldWatch::patience - 0.1, 1);
  EXPECT_FALSE(watch_.given_up());
  go(0.2, 1);
  EXPECT_TRUE(watch_.given_up());
  go(5.0, 1, radians(2.0));
  EXPECT_TRUE(watch_.given_up());
  go(HoldWatch::gap + 0.1, 0, radians(2.0));
  EXPECT_FALSE(watch_.given_up());
}

}  // namespace
}  // namespace berm::app
