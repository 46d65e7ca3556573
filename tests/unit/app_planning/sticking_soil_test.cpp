// Soil that sticks: what is learned from weighings after dumps, and what may be in a bucket of which a part does not come out.
#include <gtest/gtest.h>

#include "motion/angles.hpp"
#include "planning/sticking_soil.hpp"
#include "planning/truck_fill.hpp"

namespace {

using namespace berm::app;

TEST(StickingSoil, ConvergesToTheShareAndOpensFartherUpToALimit) {
  StickingSoil soil;
  double opened = 0.0;
  for (int pass = 0; pass < 8; ++pass) {
    soil.learn(1500.0, 180.0);
    EXPECT_GE(soil.open_farther(), opened);
    opened = soil.open_farther();
  }
  EXPECT_TRUE(soil.sticks());
  EXPECT_NEAR(soil.share(), 0.12, 0.001);
  EXPECT_NEAR(soil.stays_kg(1000.0), 120.0, 1.0);
  EXPECT_DOUBLE_EQ(soil.left_kg(), 180.0);
  EXPECT_DOUBLE_EQ(opened, radians(38.0));
}

TEST(StickingSoil, AWeighingsErrorIsNoSticking) {
  StickingSoil soil;
  for (int pass = 0; pass < 8; ++pass) soil.learn(1500.0, pass % 2 == 0 ? 25.0 : -25.0);
  EXPECT_FALSE(soil.sticks());
  EXPECT_EQ(soil.stays_kg(1500.0), 0.0);
  EXPECT_EQ(soil.open_farther(), 0.0);
}

TEST(StickingSoil, ForgetsWhenAnotherSoilComes) {
  StickingSoil soil;
  for (int pass = 0; pass < 8; ++pass) soil.learn(1500.0, 180.0);
  for (int pass = 0; pass < 20; ++pass) soil.learn(1500.0, 0.0);
  EXPECT_FALSE(soil.sticks());
  EXPECT_EQ(soil.open_farther(), 0.0);
}

TEST(StickingSoil, AHandfulSaysNothing) {
  StickingSoil soil;
  soil.learn(200.0, 60.0);
  EXPECT_FALSE(soil.sticks());
  EXPECT_DOUBLE_EQ(soil.left_kg(), 60.0);
}

TEST(StickingSoil, WhatIsLeftIsKnownThoughItIsTooLittleToStick) {
  StickingSoil soil;
  for (int pass = 0; pass < 5; ++pass) soil.learn(1500.0, 33.0);
  EXPECT_FALSE(soil.sticks());
  EXPECT_DOUBLE_EQ(soil.left_kg(), 33.0);
  EXPECT_DOUBLE_EQ(soil.stays_kg(1500.0), 0.0);
  soil.learn(1500.0, 8.0);
  EXPECT_DOUBLE_EQ(soil.left_kg(), 0.0) << "what the weighing shows of nothing";
}

TEST(TruckFill, WhatStaysInTheBucketDoesNotCountForTheTruck) {
  TruckFill fill(18000.0, 1560.0);
  fill.add_pass(16500.0, 0.0);
  const double most = TruckFill::most_share * 18000.0 - 16500.0;
  EXPECT_LT(fill.allowed_kg(most + 100.0), most);
  EXPECT_DOUBLE_EQ(fill.allowed_kg(most + 100.0, 101.0), most + 100.0) << "it may be emptied, for 101 kg stay in it";
  EXPECT_DOUBLE_EQ(fill.allowed_kg(100.0, 150.0), 100.0);
}

// What is poured of a part is weighed by what is left in the bucket, and what sticks is among that.
TEST(TruckFill, OfAPartThatIsPouredAllReachesTheTruck) {
  TruckFill fill(18000.0, 1560.0);
  fill.add_pass(16500.0, 0.0);
  EXPECT_DOUBLE_EQ(fill.allowed_kg(1600.0, 50.0), fill.allowed_kg(1600.0));
  EXPECT_NEAR(16500.0 + fill.allowed_kg(1600.0, 50.0), TruckFill::part_share * 18000.0, 1e-9);
}

}  // namespace
