// The ground: a height field of undisturbed (bank) soil with loose soil on it. Loose soil rests at its angle of repose, cut bank at
// a steeper one, and bank that was never cut stands steeper still. Soil is neither made nor lost: bank * swell = loose.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "plant/process/world_config.hpp"
#include "plant/world/height_grid.hpp"
#include "plant/world/settling.hpp"

namespace berm::plant {

class Terrain {
 public:
  // Undisturbed bank stands up to this slope (70 degrees).
  static constexpr double undisturbed_slope = 2.747;

  Terrain(const TerrainConfig& config, const SoilConfig& soil, uint64_t seed);

  [[nodiscard]] const HeightGrid& grid() const { return grid_; }
  [[nodiscard]] double height(int ix, int iy) const;
  // The shape the site was made with, or that was measured, without roughness; also beyond the grid.
  [[nodiscard]] double as_built(double x, double y) const;
  // The heights of the level ground beyond the grid.
  [[nodiscard]] std::array<double, 2> levels_beyond() const;
  // Measured ground meets the level beyond it in a step, up or down.
  [[nodiscard]] bool measured() const { return config_.measured.has_value(); }
  [[nodiscard]] double loose_thickness(int ix, int iy) const { return loose_[index(ix, iy)]; }

  // Lowers a column to z if it is higher. Returns the loose volume of what was taken, m3; loose soil goes before bank.
  double cut(int ix, int iy, double z);
  void deposit(int ix, int iy, double loose_volume);
  // Relaxes at most `budget` cells, then brings the grid up to date. Call once a step.
  void settle(int budget);
  [[nodiscard]] bool at_rest() const { return settling_.at_rest(); }
  // Of all soil over the plane z = -20, as loose volume, m3.
  [[nodiscard]] double loose_volume() const;

  // As Settling asks.
  [[nodiscard]] int count_x() const { return grid_.count_x(); }
  [[nodiscard]] int count_y() const { return grid_.count_y(); }
  [[nodiscard]] double distance(int dx, int dy) const { return dx != 0 && dy != 0 ? grid_.cell_x() * 1.4142135623730951 : grid_.cell_x(); }
  double give(int ix, int iy, int jx, int jy);
  // Slopes at which it stands from now on; what stands too steep for them slides where it is next touched.
  void change_soil(const SoilConfig& soil) { soil_ = soil; }

 private:
  [[nodiscard]] size_t index(int ix, int iy) const { return static_cast<size_t>(iy) * static_cast<size_t>(grid_.count_x()) + static_cast<size_t>(ix); }
  [[nodiscard]] bool inside(int ix, int iy) const { return ix >= 0 && iy >= 0 && ix < grid_.count_x() && iy < grid_.count_y(); }
  void changed(int ix, int iy);

  TerrainConfig config_;
  SoilConfig soil_;
  HeightGrid grid_;            // bank + loose
  HeightGrid shape_;           // measured ground as it was at the start
  std::vector<double> bank_;   // z of the bank's surface
  std::vector<double> loose_;  // thickness on it
  std::vector<uint8_t> cut_;   // the bank was cut here
  Settling settling_;
};

}  // namespace berm::plant
