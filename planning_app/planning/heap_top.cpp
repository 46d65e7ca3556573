#include "planning/heap_top.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace berm::app {

BedGrid filled_nearby(const BedGrid& seen, const BedGrid& noted) {
  constexpr double sigma = 0.4;         // m
  constexpr double everywhere = 0.01;   // of a near cell's weight: what all that is seen has to say where nothing near is
  const int reach = std::max(seen.columns, seen.rows);
  std::vector<double> weight(static_cast<std::size_t>(reach));
  for (int k = 0; k < reach; ++k) weight[static_cast<std::size_t>(k)] = std::exp(-0.5 * std::pow(k * BedGrid::cell / sigma, 2));
  BedGrid noted_where_known = noted;
  noted_where_known.known = seen.known;
  const double lift = seen.known_mean() - noted_where_known.known_mean();
  BedGrid out = seen;
  for (int row = 0; row < seen.rows; ++row)
    for (int column = 0; column < seen.columns; ++column) {
      const std::size_t here = seen.index(column, row);
      if (seen.known[here]) continue;
      double sum = everywhere * lift, weights = everywhere;
      for (int j = 0; j < seen.rows; ++j)
        for (int i = 0; i < seen.columns; ++i) {
          const std::size_t there = seen.index(i, j);
          if (!seen.known[there]) continue;
          const double w = weight[static_cast<std::size_t>(std::abs(i - column))] * weight[static_cast<std::size_t>(std::abs(j - row))];
          sum += w * (seen.height[there] - noted.height[there]);
          weights += w;
        }
      out.height[here] = std::max(0.0, noted.height[here] + sum / weights);
      out.known[here] = 1;
    }
  return out;
}

HeapedSoil heaped_soil(const BedGrid& seen, const BedGrid& heights, double load_kg) {
  constexpr double least_height = 0.3;                    // m, mean: of less the deviations of sight are too large a part
  constexpr double lightest = 0.7, heaviest = 1.1;        // of the usual density
  constexpr double steepest = 1.0;
  constexpr int span = 3, least_slopes = 40;              // cells; over 0.45 m a range's deviation is a small slope
  constexpr double heap_share = 0.9;                      // of the slopes that are seen: the steepest are the heaps' sides
  HeapedSoil soil;
  double sum = 0.0;
  for (const double height : heights.height) sum += height;
  const double area = heights.length * heights.width, mean = sum / static_cast<double>(heights.height.size());
  if (mean < least_height) return soil;
  soil.density = std::clamp(load_kg / (mean * area), lightest * BedMap::loose_density, heaviest * BedMap::loose_density);
  std::vector<double> slopes;
  for (int row = 0; row + span < seen.rows; ++row)
    for (int column = 0; column + span < seen.columns; ++column) {
      const std::size_t here = seen.index(column, row), along = seen.index(column + span, row), across = seen.index(column, row + span);
      if (!seen.known[here] || !seen.known[along] || !seen.known[across]) continue;
      slopes.push_back(std::max(std::fabs(seen.height[along] - seen.height[here]), std::fabs(seen.height[across] - seen.height[here])) / (span * BedGrid::cell));
    }
  if (slopes.size() < least_slopes) return soil;
  const auto nth = slopes.begin() + static_cast<std::ptrdiff_t>(heap_share * static_cast<double>(slopes.size() - 1));
  std::nth_element(slopes.begin(), nth, slopes.end());
  soil.slope = std::clamp(*nth, BedMap::repose, steepest);
  return soil;
}

double top_after(const BedGrid& heights, const BedPoint& at, double kg, const HeapedSoil& soil, const ImplementScale& scale) {
  constexpr double exact = 0.005;  // m
  constexpr double blunt = 0.25;   // half of half
  const double half_u = blunt * BedMap::dump_along * scale.width, half_v = blunt * BedMap::dump_across * scale.bucket;
  // Of each cell: how high the top must stand for the cone to reach it.
  std::vector<double> reached(heights.height.size());
  double low = 0.0, under = 0.0;
  for (int row = 0; row < heights.rows; ++row)
    for (int column = 0; column < heights.columns; ++column) {
      const double away = std::hypot(std::max(0.0, std::fabs(heights.u(column) - at.u) - half_u), std::max(0.0, std::fabs(heights.v(row) - at.v) - half_v));
      const std::size_t i = heights.index(column, row);
      reached[i] = heights.height[i] + soil.slope * away;
      if (away == 0.0) under = std::max(under, heights.height[i]);
    }
  const double cells = kg / (soil.density * BedGrid::cell * BedGrid::cell);  // heights that it adds up to
  double high = *std::max_element(reached.begin(), reached.end()) + cells / static_cast<double>(reached.size());
  while (high - low > exact) {
    const double top = 0.5 * (low + high);
    double sum = 0.0;
    for (const double from : reached) sum += std::max(0.0, top - from);
    (sum < cells ? low : high) = top;
  }
  return std::max(under, high);
}

}  // namespace berm::app
