#include <gtest/gtest.h>

#include "planning/load_balance.hpp"

namespace {

using namespace berm::app;

constexpr BedArea area{-1.6, 1.1, -0.1, 0.1};

TEST(LoadBalance, TheCentreIsTheMeanWeightedByMass) {
  LoadMoment load;
  EXPECT_EQ(load.centre().u, 0.0);
  load.add({-1.5, 0.1}, 1000.0);
  load.add({1.0, -0.2}, 500.0);
  EXPECT_EQ(load.kg, 1500.0);
  EXPECT_NEAR(load.centre().u, -1000.0 / 1500.0, 1e-12);
  EXPECT_NEAR(load.centre().v, 0.0, 1e-12);
}

TEST(LoadBalance, WhatIsStillToComeMayMendIt) {
  LoadMoment load;
  load.add({-1.6, 0.0}, 1500.0);
  EXPECT_NEAR(least_final_offset(load, 0.0, area), 1.6, 1e-12) << "the last dump";
  EXPECT_NEAR(least_final_offset(load, 1500.0, area), 0.25, 1e-12) << "the other end is nearer";
  EXPECT_EQ(least_final_offset(load, 3000.0, area), 0.0);
}

TEST(LoadBalance, BothDirectionsCount) {
  LoadMoment load;
  load.add({0.3, 0.4}, 1000.0);
  EXPECT_NEAR(least_final_offset(load, 0.0, area), 0.5, 1e-12);
  EXPECT_NEAR(least_final_offset(load, 1000.0, area), 0.15, 1e-12) << "along it is mended, across not wholly";
  EXPECT_EQ(least_final_offset(LoadMoment{}, 0.0, area), 0.0);
}

}  // namespace
