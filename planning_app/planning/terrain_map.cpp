#include "planning/terrain_map.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

TerrainMap::TerrainMap() : height_(static_cast<std::size_t>(side * side), 0.0), time_(height_.size(), -1.0) {}

std::optional<std::size_t> TerrainMap::index(double x, double y) {
  const double ix = std::floor((x + half_side) / cell), iy = std::floor((y + half_side) / cell);
  if (!(ix >= 0.0 && iy >= 0.0 && ix < side && iy < side)) return std::nullopt;
  return static_cast<std::size_t>(iy) * side + static_cast<std::size_t>(ix);
}

void TerrainMap::insert(double x, double y, double z, double time_s) {
  const auto i = index(x, y);
  if (!i) return;
  // Within one passage of the scanline the highest return stands, later passages replace it.
  constexpr double same_passage = 0.3;
  if (time_[*i] >= 0.0 && time_s - time_[*i] < same_passage && z < height_[*i]) return;
  height_[*i] = z;
  time_[*i] = time_s;
}

std::optional<double> TerrainMap::height(double x, double y) const {
  const auto i = index(x, y);
  if (!i || time_[*i] < 0.0) return std::nullopt;
  return height_[*i];
}

double TerrainMap::height_or(double x, double y, double unknown) const { return height(x, y).value_or(unknown); }

double TerrainMap::observed_at(double x, double y) const {
  const auto i = index(x, y);
  return i ? time_[*i] : -1.0;
}

void TerrainMap::forget(double x_low, double y_low, double x_high, double y_high) {
  for (double y = y_low + 0.5 * cell; y < y_high + cell; y += cell)
    for (double x = x_low + 0.5 * cell; x < x_high + cell; x += cell)
      if (const auto i = index(x, y)) time_[*i] = -1.0;
}

}  // namespace berm::app
