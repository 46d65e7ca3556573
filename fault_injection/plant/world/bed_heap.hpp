// Soil in a truck's bed: a height field over the bed's inside, in the bed's frame (origin in the middle of the floor, x along the bed).
#pragma once

#include <vector>

#include "plant/world/height_grid.hpp"
#include "plant/world/settling.hpp"

namespace berm::plant {

struct Overflow { double x = 0, y = 0, loose_volume = 0; };  // just outside the wall, bed's frame

class BedHeap {
 public:
  // Inside lengths; wall height over the floor; cells of about 0.10 m; slope at which the soil rests.
  BedHeap(double length, double width, double wall_height, double wall_thickness, double repose);

  void deposit(double x, double y, double loose_volume);
  // Soil that is wetter or drier from now on: what lies here already stands as it did until it is next touched.
  void rest_at(double repose) { repose_ = repose; }
  // Relaxes; what runs over the walls is appended to `over` and has left the bed.
  void settle(int budget, std::vector<Overflow>& over);

  [[nodiscard]] const HeightGrid& grid() const { return grid_; }
  [[nodiscard]] double loose_volume() const;
  [[nodiscard]] bool at_rest() const { return settling_.at_rest(); }
  // Of the load's centroid from the middle of the bed, in the plane; 0 when empty.
  [[nodiscard]] double centre_offset() const;
  // Standard deviation of the cells' heights.
  [[nodiscard]] double height_stddev() const;

  // As Settling asks.
  [[nodiscard]] int count_x() const { return grid_.count_x(); }
  [[nodiscard]] int count_y() const { return grid_.count_y(); }
  [[nodiscard]] double distance(int dx, int dy) const;
  [[nodiscard]] double height(int ix, int iy) const;
  double give(int ix, int iy, int jx, int jy);

 private:
  [[nodiscard]] bool inside(int ix, int iy) const { return ix >= 0 && iy >= 0 && ix < grid_.count_x() && iy < grid_.count_y(); }

  double wall_height_, wall_thickness_, repose_;
  HeightGrid grid_;
  Settling settling_;
  std::vector<Overflow> over_;
};

}  // namespace berm::plant
