// What is left in a bucket by a weighing that wavers and never shows less than nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "app/weighing.hpp"

namespace {

using namespace berm::app;

double shown_in_the_mean(double truly_kg, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> wavers(truly_kg, 15.0);
  MeanWeight shown;
  for (int k = 0; k < 400; ++k) shown.add(std::max(0.0, wavers(random)));
  return shown.kg();
}

TEST(Weighing, OfAnEmptyBucketNothingIsLeft) {
  for (unsigned seed = 1; seed <= 20; ++seed) EXPECT_LT(left_in_bucket(shown_in_the_mean(0.0, seed)), 2.0) << "seed " << seed;
  EXPECT_EQ(left_in_bucket(0.0), 0.0);
}

TEST(Weighing, WhatSticksIsLeftWhole) {
  for (const double kg : {20.0, 35.0, 50.0, 110.0})
    for (unsigned seed = 1; seed <= 20; ++seed) EXPECT_NEAR(left_in_bucket(shown_in_the_mean(kg, seed)), kg, 4.0) << "seed " << seed;
}

TEST(Weighing, MoreThatIsShownIsMoreThatIsLeft) {
  for (double kg = 0.0; kg < 100.0; kg += 0.5) EXPECT_LE(left_in_bucket(kg), left_in_bucket(kg + 0.5));
}

}  // namespace
