// How high a heap is forecast to stand, against cones whose volume is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planning/heap_top.hpp"

namespace {

using namespace berm::app;

BedGrid cone(double top, double slope) {
  BedGrid grid(4.8, 2.4);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      grid.height[grid.index(column, row)] = std::max(0.5, top - slope * std::hypot(grid.u(column), grid.v(row)));
  std::fill(grid.known.begin(), grid.known.end(), char{1});
  return grid;
}

double volume(const BedGrid& grid) {
  double sum = 0.0;
  for (const double height : grid.height) sum += height;
  return sum * BedGrid::cell * BedGrid::cell;
}

TEST(HeapTop, DensityAndSlopeAreTheLoads) {
  for (const double slope : {0.7, 0.85}) {
    const BedGrid grid = cone(1.4, slope);
    const HeapedSoil soil = heaped_soil(grid, grid, 1100.0 * volume(grid));
    EXPECT_NEAR(soil.slope, slope, 0.06);
    EXPECT_NEAR(soil.density, 1100.0, 60.0);
  }
  const HeapedSoil usual = heaped_soil(BedGrid(4.8, 2.4), BedGrid(4.8, 2.4), 1500.0);
  EXPECT_EQ(usual.density, BedMap::loose_density) << "nothing is seen yet";
  EXPECT_EQ(usual.slope, BedMap::repose);
}

TEST(HeapTop, ADumpBringsItsVolumeAndNoMore) {
  const HeapedSoil soil{1100.0, 0.8};
  BedGrid flat(4.8, 2.4);
  const double top = top_after(flat, {0.0, 0.0}, 1300.0, soil, {});
  EXPECT_GT(top, 0.5);
  EXPECT_LT(top, std::cbrt(3.0 * 1300.0 / 1100.0 * 0.64 / 3.1416)) << "blunter than a cone";
  EXPECT_NEAR(top_after(flat, {0.0, 0.0}, 1e6, soil, {}), 1e6 / 1100.0 / (flat.columns * flat.rows * BedGrid::cell * BedGrid::cell), 1.5) << "a full bed rises as a whole";
  const BedGrid heap = cone(1.6, 0.8);
  EXPECT_GT(top_after(heap, {0.0, 0.0}, 1300.0, soil, {}), 1.5) << "never lower than what stands there";
  EXPECT_LT(top_after(heap, {1.5, 0.0}, 1300.0, soil, {}), 1.35) << "beside it there is room";
  EXPECT_GT(top_after(flat, {0.0, 0.0}, 1300.0, {900.0, 0.8}, {}), top) << "light soil heaps higher";
}

// What the walls hide beside a heap that is seen to be lower than by the books is lower too.
TEST(HeapTop, HiddenCellsFollowWhatIsSeenNearThem) {
  const BedGrid books = cone(1.8, 0.8), truth = cone(1.6, 0.8);
  BedGrid seen = truth;
  for (int row = 0; row < seen.rows; ++row)
    for (int column = 0; column < seen.columns; ++column)
      if (seen.v(row) < 0.0) seen.known[seen.index(column, row)] = 0;
  const BedGrid full = filled_nearby(seen, books);
  EXPECT_EQ(full.known_share(), 1.0);
  const int column = full.column_of(0.0), row = full.row_of(-0.15);
  EXPECT_NEAR(full.at(column, row), truth.at(column, row), 0.1);
  EXPECT_EQ(full.at(column, full.row_of(0.3)), truth.at(column, full.row_of(0.3))) << "what is seen stays";
}

}  // namespace
