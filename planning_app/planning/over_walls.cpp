#include "planning/over_walls.hpp"

#include <algorithm>

#include "planning/bed_map.hpp"
#include "planning/soil_slide.hpp"

namespace berm::app {

namespace {

constexpr double pour_across = 2.0;  // m, by the bucket's scale: from a heaped bucket's first soil to its last

}  // namespace

// kg that leave the grid until the soil rests.
double OverWalls::leaves(BedGrid grid) const {
  constexpr int rounds = 120;
  constexpr double steepest = BedMap::repose * BedGrid::cell, rest_step = 0.002, share = 0.25;
  double over = 0.0;  // m over a cell
  for (int round = 0; round < rounds; ++round) {
    slide_to_rest(grid.height, grid.columns, grid.rows, {steepest, rest_step, 1});
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column) {
        const int at_walls = (row == 0) + (row + 1 == grid.rows) + (column == 0) + (column + 1 == grid.columns);
        double& height = grid.height[grid.index(column, row)];
        const double part = share * at_walls * std::max(0.0, height - wall_ - steepest);
        height -= part;
        over += part;
      }
  }
  return over * density_ * BedGrid::cell * BedGrid::cell;
}

double OverWalls::falls(const BedPoint& at, double kg) {
  const double with = leaves(poured(heights_, {at.u, at.v, BedMap::dump_along * scale_.width, pour_across * scale_.bucket, kg, density_}));
  if (!(with > 0.0)) return 0.0;
  // What would slide over them without it, by deviations of sight, is none of its.
  if (!without_) without_ = leaves(heights_);
  return std::clamp(with - *without_, 0.0, kg);
}

}  // namespace berm::app
