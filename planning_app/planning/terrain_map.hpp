// The app's own height map: newest height in each 0.2 m cell, from the app's own scan points (perception/scanline_processor.hpp).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace berm::app {

class TerrainMap {
public:
  static constexpr double cell = 0.2;       // m
  static constexpr double half_side = 15.0; // m; the map covers x and y within +-half_side

  TerrainMap();

  // Points outside the map are ignored.
  void insert(double x, double y, double z, double time_s);
  // Nothing where never observed or outside.
  std::optional<double> height(double x, double y) const;
  // The same with a height for cells never observed.
  double height_or(double x, double y, double unknown) const;
  double observed_at(double x, double y) const;  // s; -1 never
  void forget(double x_low, double y_low, double x_high, double y_high);

private:
  static constexpr int side = static_cast<int>(2.0 * half_side / cell);
  static std::optional<std::size_t> index(double x, double y);

  std::vector<double> height_, time_;
};

}  // namespace berm::app
