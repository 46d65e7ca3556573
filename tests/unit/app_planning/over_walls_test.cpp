// How much of a dump is forecast to slide over the bed's walls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planning/bed_map.hpp"
#include "planning/over_walls.hpp"

namespace {

using namespace berm::app;

constexpr double wall = 1.2, density = 1300.0, bucket_kg = 1400.0;

template <class Height>
BedGrid bed(Height height) {
  BedGrid grid(4.8, 2.4);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) grid.height[grid.index(column, row)] = height(grid.u(column), grid.v(row));
  std::fill(grid.known.begin(), grid.known.end(), char{1});
  return grid;
}

double falls(const BedGrid& grid, const BedPoint& at, double kg = bucket_kg) { return OverWalls(grid, wall, density, {}).falls(at, kg); }

// As high as it can stand between the side walls.
double ridge(double v) { return wall + BedMap::repose * (1.2 + 0.5 * BedGrid::cell - std::fabs(v)); }

TEST(OverWalls, NothingFallsFromALowLoad) {
  EXPECT_EQ(falls(bed([](double, double) { return 0.3; }), {}), 0.0);
  EXPECT_EQ(falls(bed([](double, double) { return 0.3; }), {2.0, 1.0}), 0.0) << "in a corner";
  EXPECT_EQ(falls(bed([](double, double v) { return ridge(v); }), {}, 0.0), 0.0) << "nothing is poured";
}

TEST(OverWalls, MostFallsFromAFullRidge) {
  const BedGrid full = bed([](double, double v) { return ridge(v); });
  EXPECT_GT(falls(full, {}), 0.7 * bucket_kg);
  EXPECT_LE(falls(full, {}), bucket_kg);
  EXPECT_GT(falls(full, {}, 2.0 * bucket_kg), 1.8 * falls(full, {}));
}

// A heap that reaches the walls at one end: what is poured there falls, a metre and a half from it there is room.
TEST(OverWalls, ALowerPlaceTakesIt) {
  const BedGrid heaped = bed([](double u, double v) { return std::max(0.9, ridge(v) - BedMap::repose * std::max(0.0, 0.8 - u)); });
  const double onto = falls(heaped, {1.2, 0.0}), beside = falls(heaped, {-1.2, 0.0});
  EXPECT_GT(onto, 300.0);
  EXPECT_LT(beside, 0.2 * onto);
  double before = 0.0;
  for (const double kg : {200.0, 600.0, 1000.0, 1400.0}) {
    const double now = falls(heaped, {1.2, 0.0}, kg);
    EXPECT_GE(now, before) << kg << " kg";
    before = now;
  }
  EXPECT_GT(falls(heaped, {1.2, 0.5}), onto) << "nearer to a side wall";
}

// Sight's deviations leave cells that would slide over the walls by themselves.
TEST(OverWalls, WhatSlidesWithoutTheDumpIsNotItsOwn) {
  const BedGrid rough = bed([](double u, double v) { return (std::fabs(u + 2.0) < 0.1 && std::fabs(v) > 1.0 ? 1.8 : 0.6); });
  EXPECT_NEAR(falls(rough, {1.0, 0.0}), 0.0, 1e-9);
}

}  // namespace
