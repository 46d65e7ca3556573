// Whether a face still gives good passes, by the last ones' shares of what they should have brought.
#include <gtest/gtest.h>

#include <initializer_list>

#include "app/bench_move.hpp"

namespace {

using berm::app::FaceYield;

FaceYield after(std::initializer_list<double> shares) {
  FaceYield yield;
  for (const double share : shares) yield.add(share);
  return yield;
}

TEST(FaceYield, IsPoorAfterFivePassesOfLessThanHalf) {
  EXPECT_FALSE(after({}).poor());
  EXPECT_FALSE(after({0.4, 0.4, 0.4, 0.4}).poor()) << "too few to tell";
  EXPECT_TRUE(after({0.4, 0.4, 0.4, 0.4, 0.4}).poor());
  EXPECT_FALSE(after({0.9, 0.9, 0.9, 0.4, 0.4}).poor()) << "not in the mean";
  EXPECT_TRUE(after({1.0, 0.45, 0.35, 0.3, 0.3}).poor()) << "in the mean, though one was good";
}

// After a move the first digs are trials: one that was good at last, or before it, shows that there is soil.
TEST(FaceYield, IsNotPoorWhileOneOfTheNewestTwoBroughtHalf) {
  EXPECT_FALSE(after({0.1, 0.1, 0.1, 0.1, 0.5}).poor());
  EXPECT_FALSE(after({0.1, 0.1, 0.1, 0.5, 0.1}).poor());
  EXPECT_TRUE(after({0.1, 0.1, 0.5, 0.1, 0.1}).poor());
}

TEST(FaceYield, ForgetsWhatIsLongerAgoThanFive) {
  EXPECT_TRUE(after({1.0, 1.0, 1.0, 0.3, 0.3, 0.3, 0.3, 0.3}).poor());
  EXPECT_FALSE(after({0.3, 0.3, 0.3, 0.3, 0.3, 1.0, 1.0, 1.0}).poor());
}

TEST(FaceYield, APassThatBroughtMoreThanItShouldCountsAsOne) {
  EXPECT_TRUE(after({1.9, 0.3, 0.3, 0.3, 0.3}).poor());
}

TEST(FaceYield, BeginsAnewWhenCleared) {
  FaceYield yield = after({0.1, 0.1, 0.1, 0.1, 0.1});
  ASSERT_TRUE(yield.poor());
  yield.clear();
  EXPECT_FALSE(yield.poor());
  for (int k = 0; k < 4; ++k) yield.add(0.1);
  EXPECT_FALSE(yield.poor());
}

}  // namespace
