#include "planning/over_walls.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "planning/bed_map.hpp"
#include "planning/soil_slide.hpp"

namespace berm::app {

namespace {

constexpr double pour_across = 2.0;  // m, by the bucket's scale: from a heaped bucket's first soil to its last

// Metres over one cell that leave the grid until the soil rests.
double leaves(BedGrid grid, double wall) {
  constexpr int rounds = 120;
  constexpr double steepest = BedMap::repose * BedGrid::cell, rest_step = 0.002, share = 0.25;
  double over = 0.0;
  for (int round = 0; round < rounds; ++round) {
    slide_to_rest(grid.height, grid.columns, grid.rows, {steepest, rest_step, 1});
    double falls = 0.0;
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column) {
        const int at_walls = (row == 0) + (row + 1 == grid.rows) + (column == 0) + (column + 1 == grid.columns);
        double& height = grid.height[grid.index(column, row)];
        const double part = share * at_walls * std::max(0.0, height - wall - steepest);
        height -= part;
        falls += part;
      }
    over += falls;
  }
  return over;
}

}  // namespace

double falls_over_walls(const BedGrid& heights, double wall, const BedPoint& at, double kg, double density, const ImplementScale& scale) {
  BedGrid with = heights;
  std::vector<std::size_t> covered;
  for (int row = 0; row < with.rows; ++row)
    for (int column = 0; column < with.columns; ++column)
      if (std::fabs(with.u(column) - at.u) < 0.5 * BedMap::dump_along * scale.width && std::fabs(with.v(row) - at.v) < 0.5 * pour_across * scale.bucket)
        covered.push_back(with.index(column, row));
  if (covered.empty() || !(kg > 0.0)) return 0.0;
  const double cell_kg = density * BedGrid::cell * BedGrid::cell;
  for (const std::size_t i : covered) with.height[i] += kg / (cell_kg * static_cast<double>(covered.size()));
  const double falls = leaves(std::move(with), wall);
  // What would slide over them without it, by deviations of sight, is none of its.
  return falls > 0.0 ? std::clamp((falls - leaves(heights, wall)) * cell_kg, 0.0, kg) : 0.0;
}

}  // namespace berm::app
