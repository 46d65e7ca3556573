#include <gtest/gtest.h>

#include "planning/truck_fill.hpp"

namespace {

using berm::app::TruckFill;

TEST(TruckFill, FullFromNinetySixPercentOn) {
  TruckFill fill(18000.0);
  for (int i = 0; i < 11; ++i) fill.add_pass(1569.0, 0.0);
  EXPECT_FALSE(fill.full());  // 17 259
  fill.add_pass(30.0, 0.0);
  EXPECT_TRUE(fill.full());   // 17 289
  EXPECT_EQ(fill.passes(), 12);
}

TEST(TruckFill, WhatStaysInTheBucketDoesNotCountAndNothingIsTakenBack) {
  TruckFill fill(18000.0);
  fill.add_pass(1500.0, 200.0);
  EXPECT_EQ(fill.loaded_kg(), 1300.0);
  fill.add_pass(100.0, 130.0);
  EXPECT_EQ(fill.loaded_kg(), 1300.0);
}

TEST(TruckFill, PlansEqualPassesThatNeverOverload) {
  TruckFill fill(18000.0);
  EXPECT_NEAR(fill.next_goal_kg(1600.0), 1500.0, 1e-9);  // 12 passes of 1500
  // Whatever the passes bring within 5 % of their goal, the sum ends within 97.5 and 103 %.
  for (const double error : {-0.05, -0.02, 0.0, 0.02, 0.05}) {
    TruckFill f(18000.0);
    for (int i = 0; i < 30 && !f.full(); ++i) f.add_pass(f.next_goal_kg(1600.0) * (1.0 + error), 0.0);
    EXPECT_TRUE(f.full());
    EXPECT_LE(f.loaded_kg(), 1.03 * 18000.0);
  }
}

}  // namespace
