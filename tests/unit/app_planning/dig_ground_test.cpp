#include "planning/dig_ground.hpp"

#include <gtest/gtest.h>

#include "app_bench/bench_machine.hpp"
#include "planning/soil_slide.hpp"

namespace {

using namespace berm::app;

constexpr double crest = 6.0, lower = -2.2;

// The bench as a scanner over the cab sees it: the face beyond the crest stays hidden.
TerrainMap seen_bench(double time_s = 1.0) {
  TerrainMap map;
  for (double x = 3.0; x < 12.0; x += 0.1)
    for (double y = -5.0; y < 5.0; y += 0.1)
      if (x <= crest || x >= 9.1) map.insert(x, y, x <= crest ? 0.0 : lower, time_s);
  return map;
}

DigGround seen() {
  DigGround ground(berm::app_bench::bench());
  ground.observe(seen_bench());
  return ground;
}

double volume(const DigGround& ground) {
  double sum = 0.0;
  for (double x = 2.9; x < 11.6; x += DigGround::cell)
    for (double y = -5.1; y < 5.2; y += DigGround::cell) sum += ground.height(x, y);
  return sum * DigGround::cell * DigGround::cell;
}

TEST(DigGround, AHiddenFaceFallsFromTheCrestToTheFoot) {
  const DigGround ground = seen();
  EXPECT_EQ(ground.height(5.5, 0.0), 0.0);
  EXPECT_NEAR(ground.height(6.7, 0.0), -1.5 * 0.7, 0.2);
  EXPECT_EQ(ground.height(8.5, 0.0), lower);
}

// The machine went back by a metre: the face that it had cut to 5.2 m stands a metre farther out.
TEST(DigGround, AfterAMoveAHiddenFaceIsNoHigherThanItWasDug) {
  DigGround before = seen();
  for (double x = 5.2; x < 9.0; x += 0.1)
    for (double y = -1.0; y < 1.0; y += 0.1) before.lower_to(x, y, -2.4);
  DigGround after(berm::app_bench::bench(), before, 1.0), fresh(berm::app_bench::bench());
  after.observe(seen_bench());
  fresh.observe(seen_bench());
  EXPECT_EQ(after.height(5.5, 0.0), 0.0) << "seen";
  EXPECT_NEAR(fresh.height(6.5, 0.0), -0.75, 0.2);
  EXPECT_EQ(after.height(6.5, 0.0), -2.4);
  EXPECT_EQ(after.height(6.5, 3.0), fresh.height(6.5, 3.0)) << "nobody dug there";
  after.observe(seen_bench(9.0));
  EXPECT_EQ(after.height(5.5, 0.0), 0.0);
}

TEST(DigGround, WhatIsSeenCountsWhenItIsNewer) {
  DigGround ground = seen();
  ground.lower_to(5.5, 0.0, -0.6);
  ground.observe(seen_bench());
  EXPECT_EQ(ground.height(5.5, 0.0), -0.6) << "seen before the cut";
  ground.observe(seen_bench(9.0));
  EXPECT_EQ(ground.height(5.5, 0.0), 0.0);
}

TEST(DigGround, TheBucketOnlyLowers) {
  DigGround ground = seen();
  ground.lower_to(6.7, 0.0, 3.0);
  EXPECT_NEAR(ground.height(6.7, 0.0), -1.5 * 0.7, 0.2);
  ground.lower_to(6.7, 0.0, -2.0);
  EXPECT_EQ(ground.height(6.7, 0.0), -2.0);
  ground.lower_to(60.0, 0.0, -2.0);  // outside: nothing
}

TEST(DigGround, ACutFillsFromItsSidesAndNothingIsLost) {
  DigGround ground = seen();
  for (double x = 5.0; x < 8.0; x += 0.1)
    for (double y = -0.6; y < 0.6; y += 0.1) ground.lower_to(x, y, -2.6);
  const double cut = volume(ground);
  ground.settle();
  EXPECT_NEAR(volume(ground), cut, 1e-6);
  EXPECT_GT(ground.height(5.3, 0.1), -2.5) << "the bench slid into it";
  EXPECT_LT(ground.height(4.7, 0.1), -0.05) << "and is gone there";
  EXPECT_EQ(ground.height(9.5, 0.1), lower);
}

TEST(SoilSlide, LeavesWhatStandsAndLevelsWhatDoesNot) {
  std::vector<double> stands{0.0, 0.1, 0.2, 0.3}, high{0.0, 0.0, 2.0, 0.0, 0.0};
  slide_to_rest(stands, 4, 1, {0.1, 1e-9, 10});
  EXPECT_EQ(stands, (std::vector<double>{0.0, 0.1, 0.2, 0.3}));
  slide_to_rest(high, 5, 1, {0.3, 1e-6, 10000});
  double sum = 0.0;
  for (std::size_t i = 0; i < high.size(); ++i) {
    sum += high[i];
    if (i > 0) { EXPECT_LE(std::fabs(high[i] - high[i - 1]), 0.3 + 1e-4); }
  }
  EXPECT_NEAR(sum, 2.0, 1e-12);
}

}  // namespace
