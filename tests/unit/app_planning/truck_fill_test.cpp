#include <gtest/gtest.h>

#include "planning/truck_fill.hpp"

namespace {

using berm::app::TruckFill;

constexpr double full_bucket = 1560.0;

TEST(TruckFill, FullFromItsShareOn) {
  TruckFill fill(18000.0, 1000.0);  // of a small bucket a handful is less than what is filled beyond that share
  for (int i = 0; i < 11; ++i) fill.add_pass(1600.0, 0.0);
  EXPECT_FALSE(fill.full());  // 17 600
  const double left = TruckFill::full_share * 18000.0 - 17600.0;
  EXPECT_FALSE(fill.full_with(left - 1.0));
  EXPECT_TRUE(fill.full_with(left + 1.0));
  fill.add_pass(left + 1.0, 0.0);
  EXPECT_TRUE(fill.full());
  EXPECT_EQ(fill.passes(), 12);
  EXPECT_EQ(fill.passes_left(), 0);
  EXPECT_EQ(fill.next_goal_kg(), 0.0);
}

TEST(TruckFill, ForNextToNothingNoPassIsMade) {
  TruckFill fill(4500.0, full_bucket);
  fill.add_pass(4500.0 * TruckFill::aim_share - 1.01 * TruckFill::worth_share * full_bucket, 0.0);
  EXPECT_FALSE(fill.full());
  fill.add_pass(0.02 * TruckFill::worth_share * full_bucket, 0.0);
  EXPECT_TRUE(fill.full());
}

TEST(TruckFill, WhatStaysInTheBucketDoesNotCountAndNothingIsTakenBack) {
  TruckFill fill(18000.0, full_bucket);
  fill.add_pass(1500.0, 200.0);
  EXPECT_EQ(fill.loaded_kg(), 1300.0);
  fill.add_pass(100.0, 130.0);
  EXPECT_EQ(fill.loaded_kg(), 1300.0);
}

TEST(TruckFill, TheRestIsPlannedInTheFewestEqualPasses) {
  TruckFill fill(18000.0, full_bucket);
  EXPECT_EQ(fill.passes_left(), 12);
  EXPECT_NEAR(fill.next_goal_kg(), 18000.0 * TruckFill::aim_share / 12.0, 1e-9);
  // A little more than a bucket is left: two halves, no bucket and a handful.
  fill.add_pass(18000.0 * TruckFill::aim_share - full_bucket - 40.0, 0.0);
  EXPECT_EQ(fill.passes_left(), 2);
  EXPECT_NEAR(fill.next_goal_kg(), 0.5 * (full_bucket + 40.0), 1e-9);
}

TEST(TruckFill, OfABucketThatWouldOverloadTheTruckAPartIsAllowed) {
  TruckFill fill(4500.0, full_bucket);
  fill.add_pass(3000.0, 0.0);
  const double rest = 4500.0 * TruckFill::part_share - 3000.0;
  EXPECT_EQ(fill.allowed_kg(1600.0), rest) << "overload";
  EXPECT_EQ(fill.allowed_kg(1450.0), 1450.0) << "within the limits";
  EXPECT_EQ(fill.allowed_kg(1300.0), 1300.0) << "the rest is another pass's";
  EXPECT_EQ(fill.allowed_kg(900.0), 900.0) << "enough is left";
}

// Less than the weighing can tell would be no part at all, and the pass for nothing.
TEST(TruckFill, APartIsWorthAPass) {
  for (const double missing : {0.061, 0.065, 0.08}) {
    TruckFill fill(18000.0, full_bucket);
    fill.add_pass(18000.0 * TruckFill::aim_share - missing * full_bucket, 0.0);
    ASSERT_FALSE(fill.full()) << missing;
    EXPECT_GE(fill.allowed_kg(390.0), TruckFill::worth_share * full_bucket) << missing;
    EXPECT_LE(fill.loaded_kg() + fill.allowed_kg(390.0), TruckFill::aim_share * 18000.0) << missing;
  }
}

TEST(TruckFill, OnlyABucketThatMayHoldTooMuchHasToBeWeighed) {
  TruckFill fill(18000.0, full_bucket);
  EXPECT_FALSE(fill.must_weigh(1600.0));
  for (int i = 0; i < 10; ++i) fill.add_pass(1480.0, 0.0);
  EXPECT_FALSE(fill.must_weigh(1600.0));  // 2984 kg left: no bucket is too much
  fill.add_pass(1600.0, 0.0);
  EXPECT_TRUE(fill.must_weigh(1600.0));
}

}  // namespace
