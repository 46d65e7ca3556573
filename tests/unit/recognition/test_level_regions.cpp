// Level planes from scanlines.
#include "recognition/level_regions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace berm::app {
namespace {

using Eigen::Vector3d;

// 30 fans a degree apart over a surface, its height by the place in plan, 5 to 9 m off.
FanSweep sweep_over_heights(const std::function<double(double, double)>& height, double noise = 0.01) {
  constexpr double degree = std::numbers::pi / 180;
  FanSweep sweep;
  const Vector3d head(0.0, 0.0, 3.0);
  for (int fan = 0; fan < 30; ++fan) {
    sweep.heads.push_back(head);
    sweep.begin.push_back(sweep.returns.size());
    const double c = std::cos((fan - 15) * degree), s = std::sin((fan - 15) * degree);
    for (int k = 0; k < 20; ++k) {
      const double d = 5.0 + 0.2 * k, x = c * d, y = s * d, off = (k + fan) % 2 == 0 ? noise : -noise;
      sweep.returns.push_back({Vector3d(x, y, height(x, y) + off).cast<float>()});
    }
  }
  sweep.begin.push_back(sweep.returns.size());
  return sweep;
}

const LevelPlace everywhere{Eigen::Vector2d(7.0, 0.0), 10.0};

TEST(LevelRegions, AFloorIsOneWithItsPlaneAndHowFlatItIs) {
  for (const double rise : {0.0, 0.05, -0.05}) {
    const FanSweep sweep = sweep_over_heights([&](double x, double y) { return 0.4 + rise * (x - 7.0) + 0.5 * rise * y; });
    const auto regions = level_regions(sweep, everywhere);
    ASSERT_EQ(regions.size(), 1U) << rise;
    EXPECT_EQ(regions[0].count, 600);
    EXPECT_EQ(regions[0].segments.size(), 30U);
    EXPECT_NEAR(-regions[0].normal.x() / regions[0].normal.z(), rise, 0.003);
    EXPECT_NEAR(-regions[0].normal.y() / regions[0].normal.z(), 0.5 * rise, 0.003);
    EXPECT_NEAR(regions[0].spread, 0.01, 0.001);
    EXPECT_NEAR(regions[0].noise, 0.03 * std::sin(std::atan(2.6 / 6.9)), 0.002) << "its rays meet it at 21 degrees";
  }
}

// A sheet over a cab rises by a fifth, from scanline to scanline as well as along them.
TEST(LevelRegions, WhatRisesIsOneToo) {
  for (const Eigen::Vector2d& rise : {Eigen::Vector2d(0.2, 0.0), Eigen::Vector2d(0.0, 0.5)}) {
    const auto regions = level_regions(sweep_over_heights([&](double x, double y) { return rise.x() * (x - 7.0) + rise.y() * y; }), everywhere);
    ASSERT_FALSE(regions.empty());
    EXPECT_GT(regions[0].count, 500);
    EXPECT_NEAR(-regions[0].normal.x() / regions[0].normal.z(), rise.x(), 0.02);
    EXPECT_NEAR(-regions[0].normal.y() / regions[0].normal.z(), rise.y(), 0.02);
  }
}

TEST(LevelRegions, AStepParts) {
  const auto regions = level_regions(sweep_over_heights([](double x, double) { return x < 7.0 ? 0.0 : 0.4; }), everywhere);
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_NEAR(std::abs(regions[0].middle.z() - regions[1].middle.z()), 0.4, 0.02);
}

TEST(LevelRegions, AreOfWhatLiesWithinThePlaceAndIsNotUpright) {
  FanSweep sweep = sweep_over_heights([](double, double) { return 0.0; });
  const auto near = level_regions(sweep, {Eigen::Vector2d(6.0, 0.0), 0.5});
  ASSERT_EQ(near.size(), 1U);
  EXPECT_LT(near[0].count, 60);
  for (const LevelEnds& s : near[0].segments) EXPECT_LT((s.farthest.head<2>() - Eigen::Vector2f(6.0F, 0.0F)).norm(), 0.5F);
  for (FanReturn& r : sweep.returns) r.upright = true;
  EXPECT_TRUE(level_regions(sweep, everywhere).empty());
}

TEST(LevelRegions, OfBedsAreFoundAgainWhereOneStandsElsewhere) {
  const FanSweep sweep = sweep_over_heights([](double x, double) { return x < 6.0 ? 0.0 : 0.5; });
  LevelRegionsOfBeds regions(sweep);
  const std::size_t all = regions.about({7.0, 0.0, 1.0}).size();
  EXPECT_EQ(all, 2U);
  EXPECT_EQ(regions.about({7.5, 0.0, 1.0}).size(), all);
  EXPECT_EQ(regions.about({20.0, 0.0, 1.0}).size(), 0U);
  EXPECT_EQ(regions.about({7.0, 0.0, 1.0}).size(), all);
}

}  // namespace
}  // namespace berm::app
