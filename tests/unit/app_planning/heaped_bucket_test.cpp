#include <gtest/gtest.h>

#include "planning/heaped_bucket.hpp"

namespace {

using berm::app::HeapedBucket;

constexpr double nominal_kg = 1600.0, goal_kg = 1500.0, impulse = 200e3;

TEST(HeapedBucket, LearnsThatALightSoilFillsItWithLess) {
  HeapedBucket bucket(nominal_kg);
  EXPECT_EQ(bucket.kg(), nominal_kg);
  bucket.learn(goal_kg, 1240.0, impulse);  // it lost some on its way up
  bucket.learn(goal_kg, 1297.0, 1.2 * impulse);
  bucket.learn(goal_kg, 1290.0, 1.3 * impulse);
  EXPECT_EQ(bucket.kg(), nominal_kg) << "the three are not alike";
  bucket.learn(goal_kg, 1300.0, 1.4 * impulse);
  EXPECT_EQ(bucket.kg(), 1300.0);
}

TEST(HeapedBucket, MoreForceThatBringsMoreIsNoFullBucket) {
  HeapedBucket bucket(nominal_kg);
  for (const double more : {1.0, 1.1, 1.2, 1.3}) bucket.learn(goal_kg, 1000.0 * more, more * impulse);
  EXPECT_EQ(bucket.kg(), nominal_kg);
}

TEST(HeapedBucket, AsMuchForAsMuchForceIsNoFullBucket) {
  HeapedBucket bucket(nominal_kg);
  for (int dig = 0; dig < 10; ++dig) bucket.learn(goal_kg, 1200.0, impulse * (dig % 2 == 0 ? 1.0 : 1.08));
  EXPECT_EQ(bucket.kg(), nominal_kg);
}

TEST(HeapedBucket, ADigThatBroughtWhatItWasToSaysNothing) {
  HeapedBucket bucket(nominal_kg);
  for (const double more : {1.0, 1.2, 1.4}) bucket.learn(1250.0, 1200.0, more * impulse);
  EXPECT_EQ(bucket.kg(), nominal_kg);
  bucket.learn(goal_kg, 1200.0, impulse);
  bucket.learn(goal_kg, 1450.0, 1.2 * impulse);  // between two that came short
  bucket.learn(goal_kg, 1200.0, 1.3 * impulse);
  bucket.learn(goal_kg, 1200.0, 1.4 * impulse);
  EXPECT_EQ(bucket.kg(), nominal_kg);
}

TEST(HeapedBucket, HoldsNoLessThanWasWeighedInIt) {
  HeapedBucket bucket(nominal_kg);
  for (const double more : {1.0, 1.2, 1.4}) bucket.learn(goal_kg, 1300.0, more * impulse);
  ASSERT_EQ(bucket.kg(), 1300.0);
  bucket.held(1340.0);  // a heavier soil has come
  EXPECT_EQ(bucket.kg(), 1340.0);
  bucket.held(1200.0);
  EXPECT_EQ(bucket.kg(), 1340.0);
  bucket.held(1700.0);
  EXPECT_EQ(bucket.kg(), nominal_kg) << "and no more than of the heaviest soil";
}

TEST(HeapedBucket, NoSoilIsLighterThanSixTenths) {
  HeapedBucket bucket(nominal_kg);
  for (const double more : {1.0, 1.2, 1.4}) bucket.learn(goal_kg, 300.0, more * impulse);
  EXPECT_EQ(bucket.kg(), 0.6 * nominal_kg);
}

}  // namespace
