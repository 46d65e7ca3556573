#include <gtest/gtest.h>

#include <random>

#include "perception/second_sweep.hpp"

namespace {

using namespace berm::app;

TEST(SecondSweep, AFlaggedReturnIsBelievedWhenItComesAgain) {
  const TerrainMap terrain;
  SecondSweep second;
  EXPECT_FALSE(second.confirms(terrain, 5.0, 1.0, -0.5, 10.0));
  EXPECT_FALSE(second.confirms(terrain, 5.0, 1.0, -0.5, 10.1)) << "the same passage";
  EXPECT_TRUE(second.confirms(terrain, 5.05, 1.05, -0.4, 13.0));
}

TEST(SecondSweep, NotAtAnotherHeightNorElsewhereNorMuchLater) {
  const TerrainMap terrain;
  SecondSweep second;
  EXPECT_FALSE(second.confirms(terrain, 5.0, 1.0, 1.5, 10.0));
  EXPECT_FALSE(second.confirms(terrain, 5.0, 1.0, 0.5, 13.0));
  EXPECT_FALSE(second.confirms(terrain, 5.5, 1.0, 0.5, 16.0));
  EXPECT_FALSE(second.confirms(terrain, 5.0, 1.0, 0.5, 13.0 + SecondSweep::longest_wait + 1.0));
}

TEST(SecondSweep, WhatTheMapHoldsFromAnEarlierPassageConfirms) {
  TerrainMap terrain;
  SecondSweep second;
  terrain.insert(5.0, 1.0, -2.2, 10.0);
  EXPECT_FALSE(second.confirms(terrain, 5.0, 1.0, -2.2, 10.1)) << "of the same passage";
  EXPECT_TRUE(second.confirms(terrain, 5.0, 1.0, -2.1, 40.0));
  EXPECT_FALSE(second.confirms(terrain, 5.0, 1.0, 0.0, 41.0)) << "dust over it";
}

TEST(SecondSweep, BeyondTheMapNothingIs) {
  const TerrainMap terrain;
  SecondSweep second;
  for (const double x : {15.1, -15.1, 1e9, -1e300}) {
    EXPECT_FALSE(second.confirms(terrain, x, 0.0, 0.0, 10.0));
    EXPECT_FALSE(second.confirms(terrain, x, 0.0, 0.0, 13.0));
  }
}

// Dust that drifts through six metres of air: what of it is taken for something.
TEST(SecondSweep, HardlyAnyOfDustThatDriftsIsBelieved) {
  const TerrainMap terrain;
  SecondSweep second;
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> place(-10.0, 10.0), height(-2.0, 4.0);
  int believed = 0;
  constexpr int returns = 3600;  // a hundredth of what both scanners send in 15 s
  for (int i = 0; i < returns; ++i) {
    const double x = place(random), y = place(random), z = height(random);
    believed += second.confirms(terrain, x, y, z, 10.0 + i * 15.0 / returns) ? 1 : 0;
  }
  EXPECT_LT(believed, returns / 50);
}

}  // namespace
