// Smoothing, what is put where the walls hide the bed, and soil that comes to rest.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "planning/bed_grid.hpp"

namespace {

using namespace berm::app;

BedGrid level(double height) {
  BedGrid grid(4.88, 2.44);
  std::fill(grid.height.begin(), grid.height.end(), height);
  std::fill(grid.known.begin(), grid.known.end(), char{1});
  return grid;
}

double sum(const BedGrid& grid) { return std::accumulate(grid.height.begin(), grid.height.end(), 0.0); }

TEST(BedGrid, HasAboutFiveHundredCellsRoundTheBedsMiddle) {
  const BedGrid grid = level(0.0);
  EXPECT_EQ(grid.columns, 33);
  EXPECT_EQ(grid.rows, 17);
  EXPECT_NEAR(grid.u(16), 0.0, 1e-12);
  EXPECT_NEAR(grid.v(8), 0.0, 1e-12);
  for (int column = 0; column < grid.columns; ++column) EXPECT_EQ(grid.column_of(grid.u(column)), column);
  for (int row = 0; row < grid.rows; ++row) EXPECT_EQ(grid.row_of(grid.v(row)), row);
  EXPECT_EQ(grid.column_of(-9.0), 0);
  EXPECT_EQ(grid.row_of(9.0), 16);
}

TEST(BedGrid, SmoothingTakesTheNoiseAndLeavesThePlane) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.03);
  BedGrid grid = level(0.5);
  double before = 0.0;
  for (double& z : grid.height) {
    const double n = noise(random);
    z += n;
    before += n * n;
  }
  const BedGrid smooth = smoothed(grid, 0.30);
  double after = 0.0;
  for (const double z : smooth.height) after += (z - 0.5) * (z - 0.5);
  EXPECT_LT(after, 0.1 * before);

  BedGrid plane = level(0.0);
  for (int row = 0; row < plane.rows; ++row)
    for (int column = 0; column < plane.columns; ++column) plane.height[plane.index(column, row)] = 0.3 + 0.1 * plane.u(column);
  const BedGrid same = smoothed(plane, 0.30);
  for (int column = 4; column < plane.columns - 4; ++column) EXPECT_NEAR(same.at(column, 8), plane.at(column, 8), 1e-9) << "column " << column;
}

TEST(BedGrid, SmoothingTakesNothingFromUnknownCellsAndFillsNone) {
  BedGrid grid = level(0.4);
  grid.height[grid.index(10, 8)] = 99.0;
  grid.known[grid.index(10, 8)] = 0;
  const BedGrid smooth = smoothed(grid, 0.30);
  EXPECT_EQ(smooth.known[grid.index(10, 8)], 0);
  EXPECT_NEAR(smooth.at(11, 8), 0.4, 1e-12);
}

TEST(BedGrid, UnknownCellsGetTheMeanOfTheKnown) {
  BedGrid grid = level(0.2);
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < grid.columns; ++column) grid.known[grid.index(column, row)] = 0;
  for (int column = 0; column < grid.columns; ++column) grid.height[grid.index(column, 8)] = 0.9 + 0.2;
  EXPECT_NEAR(grid.known_share(), 9.0 / 17.0, 1e-12);
  const BedGrid full = filled(grid, level(0.0));
  EXPECT_EQ(full.known_share(), 1.0);
  EXPECT_NEAR(full.at(5, 2), 0.2 + 0.9 / 9.0, 1e-12);
  EXPECT_NEAR(full.at(5, 12), 0.2, 1e-12);
  BedGrid dark = level(0.7);
  std::fill(dark.known.begin(), dark.known.end(), char{0});
  EXPECT_EQ(filled(dark, level(0.0)).at(3, 3), 0.0) << "nothing is known at all";
}

TEST(BedGrid, TheBooksRaiseAndLowerWhatIsHidden) {
  BedGrid grid = level(0.0), noted = level(0.0);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < 16; ++column) {
      grid.height[grid.index(column, row)] = 0.6;    // one half is loaded ...
      noted.height[noted.index(column, row)] = 0.5;  // ... and the books know about it
    }
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < grid.columns; ++column) grid.known[grid.index(column, row)] = 0;
  const BedGrid full = filled(grid, noted);
  const double lift = 0.1 * 16.0 / 33.0;  // by how much more is seen than was noted
  EXPECT_NEAR(full.at(3, 2), 0.5 + lift, 1e-9);
  EXPECT_NEAR(full.at(30, 2), lift, 1e-9);
  EXPECT_NEAR(full.at(30, 12), 0.0, 1e-12) << "what is seen stays";
}

TEST(BedGrid, SoilSlidesUntilItRestsAndNoneIsLost) {
  BedGrid grid = level(0.0);
  for (int row = 6; row < 11; ++row)
    for (int column = 13; column < 20; ++column) grid.height[grid.index(column, row)] = 0.9;
  const BedGrid rest = settled(grid, 0.65);
  EXPECT_NEAR(sum(rest), sum(grid), 1e-9);
  for (int row = 0; row < rest.rows; ++row)
    for (int column = 0; column + 1 < rest.columns; ++column) EXPECT_LT(std::fabs(rest.at(column, row) - rest.at(column + 1, row)), 0.65 * BedGrid::cell + 0.03);
  EXPECT_NEAR(rest.at(10, 8), rest.at(22, 8), 0.03) << "to all sides alike";
  const BedGrid flat = settled(level(1.3), 0.65);
  EXPECT_EQ(flat.at(0, 0), 1.3) << "the walls hold it";
}

}  // namespace
