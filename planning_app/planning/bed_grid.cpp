#include "planning/bed_grid.hpp"

#include <algorithm>
#include <cmath>

#include "planning/soil_slide.hpp"

namespace berm::app {

BedGrid::BedGrid(double along, double across)
    : length(along), width(across), columns(static_cast<int>(std::ceil(along / cell))), rows(static_cast<int>(std::ceil(across / cell))),
      height(static_cast<std::size_t>(columns * rows), 0.0), known(height.size(), 0) {}

double BedGrid::at(int column, int row) const { return height[index(std::clamp(column, 0, columns - 1), std::clamp(row, 0, rows - 1))]; }

int BedGrid::column_of(double along) const { return std::clamp(static_cast<int>(std::floor(along / cell + 0.5 * columns)), 0, columns - 1); }

int BedGrid::row_of(double across) const { return std::clamp(static_cast<int>(std::floor(across / cell + 0.5 * rows)), 0, rows - 1); }

double BedGrid::known_share() const {
  return static_cast<double>(std::count_if(known.begin(), known.end(), [](char k) { return k != 0; })) / static_cast<double>(known.size());
}

double BedGrid::known_mean() const {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < height.size(); ++i)
    if (known[i]) { sum += height[i]; ++count; }
  return count == 0 ? 0.0 : sum / count;
}

BedGrid smoothed(const BedGrid& grid, double sigma) {
  const int reach = static_cast<int>(std::ceil(2.0 * sigma / BedGrid::cell));
  std::vector<double> weight(static_cast<std::size_t>(reach) + 1);
  for (int k = 0; k <= reach; ++k) weight[static_cast<std::size_t>(k)] = std::exp(-0.5 * std::pow(k * BedGrid::cell / sigma, 2));
  BedGrid out = grid;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      if (!grid.known[grid.index(column, row)]) continue;
      double sum = 0.0, weights = 0.0;
      for (int j = std::max(0, row - reach); j <= std::min(grid.rows - 1, row + reach); ++j)
        for (int i = std::max(0, column - reach); i <= std::min(grid.columns - 1, column + reach); ++i) {
          if (!grid.known[grid.index(i, j)]) continue;
          const double w = weight[static_cast<std::size_t>(std::abs(i - column))] * weight[static_cast<std::size_t>(std::abs(j - row))];
          sum += w * grid.height[grid.index(i, j)];
          weights += w;
        }
      out.height[grid.index(column, row)] = sum / weights;
    }
  return out;
}

BedGrid filled(const BedGrid& grid, const BedGrid& noted) {
  BedGrid out = grid, noted_where_known = noted;
  noted_where_known.known = grid.known;
  const double lift = grid.known_mean() - noted_where_known.known_mean();
  for (std::size_t i = 0; i < out.height.size(); ++i)
    if (!out.known[i]) {
      out.height[i] = std::max(0.0, noted.height[i] + lift);
      out.known[i] = 1;
    }
  return out;
}

BedGrid poured(const BedGrid& grid, const Pour& pour) {
  BedGrid out = grid;
  std::vector<std::size_t> covered;
  for (int row = 0; row < out.rows; ++row)
    for (int column = 0; column < out.columns; ++column)
      if (std::fabs(out.u(column) - pour.u) < 0.5 * pour.along && std::fabs(out.v(row) - pour.v) < 0.5 * pour.across) covered.push_back(out.index(column, row));
  constexpr double area = BedGrid::cell * BedGrid::cell;
  for (const std::size_t i : covered) out.height[i] += pour.kg / (pour.density * area * static_cast<double>(covered.size()));
  return out;
}

BedGrid settled(const BedGrid& grid, double slope) {
  constexpr int most_rounds = 60;
  constexpr double rest_step = 0.002;  // m
  BedGrid out = grid;
  slide_to_rest(out.height, out.columns, out.rows, {slope * BedGrid::cell, rest_step, most_rounds});
  return out;
}

}  // namespace berm::app
