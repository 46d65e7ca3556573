#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planning/bed_templates.hpp"

namespace {

using namespace berm::app;

// A load of the form height(u, v).
template <class Height>
BedGrid load(Height height) {
  BedGrid grid(4.88, 2.44);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      grid.height[grid.index(column, row)] = height(grid.u(column), grid.v(row));
      grid.known[grid.index(column, row)] = 1;
    }
  return grid;
}

TEST(BedTemplates, AreFiveByFiveOrSevenBySeven) {
  EXPECT_EQ(constant_template().side, 7);
  EXPECT_EQ(hole_template().side, 5);
  EXPECT_EQ(slope_template(true).side, 7);
  for (const BedTemplate& t : {constant_template(), hole_template(), slope_template(true), slope_template(false)})
    EXPECT_EQ(t.weight.size(), static_cast<std::size_t>(t.side * t.side));
}

TEST(BedTemplates, OnALevelLoadOnlyTheElevationScores) {
  const BedGrid grid = load([](double, double) { return 0.8; });
  for (int column : {0, 1, 16, 32})
    for (int row : {0, 8, 16}) {
      EXPECT_NEAR(score(grid, constant_template(), column, row), 0.8, 1e-12);
      EXPECT_NEAR(score(grid, hole_template(), column, row), 0.0, 1e-12);
      EXPECT_NEAR(score(grid, slope_template(true), column, row), 0.0, 1e-12);
      EXPECT_NEAR(score(grid, slope_template(false), column, row), 0.0, 1e-12);
    }
}

TEST(BedTemplates, AHoleIsFoundWhereItIs) {
  const BedGrid grid = load([](double u, double v) { return 0.8 - 0.3 * std::exp(-0.5 * (std::pow(u - 1.2, 2) + std::pow(v + 0.3, 2)) / 0.04); });
  const std::vector<double> scores = convolved(grid, hole_template());
  ASSERT_EQ(scores.size(), grid.height.size());
  const auto best = static_cast<std::size_t>(std::max_element(scores.begin(), scores.end()) - scores.begin());
  EXPECT_EQ(best, grid.index(grid.column_of(1.2), grid.row_of(-0.3)));
  EXPECT_GT(scores[best], 0.1);
  const BedGrid heap = load([](double u, double v) { return 0.3 * std::exp(-0.5 * (u * u + v * v) / 0.04); });
  EXPECT_LT(score(heap, hole_template(), 16, 8), -0.1) << "a heap is the contrary";
}

TEST(BedTemplates, ASlopeTellsItsRiseAndItsDirection) {
  const BedGrid grid = load([](double u, double v) { return 1.0 + 0.2 * u - 0.3 * v; });
  // Over the seven cells of a side, from middle to middle: each cell's rise times one, as the weights are of a fit.
  EXPECT_NEAR(score(grid, slope_template(true), 16, 8), 7 * 0.2 * BedGrid::cell, 1e-9);
  EXPECT_NEAR(score(grid, slope_template(false), 16, 8), -7 * 0.3 * BedGrid::cell, 1e-9);
  EXPECT_NEAR(score(grid, hole_template(), 16, 8), 0.0, 1e-12) << "a slope is no hole";
}

TEST(BedTemplates, TheLeastMeanElevationIsTheLowestPart) {
  const BedGrid grid = load([](double u, double) { return u > 0.9 ? 0.1 : 0.6; });
  const std::vector<double> scores = convolved(grid, constant_template());
  const auto best = static_cast<int>(std::min_element(scores.begin(), scores.end()) - scores.begin());
  EXPECT_GT(grid.u(best % grid.columns), 1.2);
}

}  // namespace
