#include "plant/world/bed_heap.hpp"

#include <algorithm>
#include <cmath>

namespace berm::plant {
namespace {
constexpr double wanted_cell = 0.10;
constexpr double rest_step = 0.002;  // smaller steps are left standing, m

int cells(double side) { return std::max(2, static_cast<int>(std::lround(side / wanted_cell))); }
}  // namespace

BedHeap::BedHeap(double length, double width, double wall_height, double wall_thickness, double repose)
    : wall_height_(wall_height), wall_thickness_(wall_thickness), repose_(repose),
      grid_(-length / 2, -width / 2, length / cells(length), width / cells(width), cells(length), cells(width), 0.0),
      settling_(grid_.count_x(), grid_.count_y()) {}

void BedHeap::deposit(double x, double y, double loose_volume) {
  if (loose_volume <= 0) return;
  const int ix = grid_.index_x(x), iy = grid_.index_y(y);
  grid_.set(ix, iy, grid_.at(ix, iy) + loose_volume / grid_.cell_area());
  settling_.touch(ix, iy);
}

void BedHeap::settle(int budget, std::vector<Overflow>& over) {
  settling_.run(*this, budget);
  grid_.refresh();
  over.insert(over.end(), over_.begin(), over_.end());
  over_.clear();
}

double BedHeap::distance(int dx, int dy) const { return std::hypot(dx * grid_.cell_x(), dy * grid_.cell_y()); }

double BedHeap::height(int ix, int iy) const { return inside(ix, iy) ? grid_.at(ix, iy) : wall_height_; }

double BedHeap::give(int ix, int iy, int jx, int jy) {
  const double here = grid_.at(ix, iy);
  const double excess = here - height(jx, jy) - repose_ * distance(jx - ix, jy - iy);
  if (excess <= rest_step) return 0;
  // Over the wall it is gone, so all of the excess goes; inside, half of it levels the step.
  const double moved = std::min(here, inside(jx, jy) ? excess / 2 : excess);
  if (moved <= 0) return 0;
  grid_.set(ix, iy, here - moved);
  if (inside(jx, jy)) {
    grid_.set(jx, jy, grid_.at(jx, jy) + moved);
  } else {
    const double out = wall_thickness_ + grid_.cell_x();
    over_.push_back({grid_.centre_x(ix) + (jx - ix) * out, grid_.centre_y(iy) + (jy - iy) * out, moved * grid_.cell_area()});
  }
  return moved;
}

double BedHeap::loose_volume() const {
  double sum = 0;
  for (int iy = 0; iy < grid_.count_y(); ++iy) {
    for (int ix = 0; ix < grid_.count_x(); ++ix) sum += grid_.at(ix, iy);
  }
  return sum * grid_.cell_area();
}

double BedHeap::centre_offset() const {
  double sum = 0, sum_x = 0, sum_y = 0;
  for (int iy = 0; iy < grid_.count_y(); ++iy) {
    for (int ix = 0; ix < grid_.count_x(); ++ix) {
      const double h = grid_.at(ix, iy);
      sum += h;
      sum_x += h * grid_.centre_x(ix);
      sum_y += h * grid_.centre_y(iy);
    }
  }
  return sum > 0 ? std::hypot(sum_x / sum, sum_y / sum) : 0.0;
}

double BedHeap::height_stddev() const {
  const double n = grid_.count_x() * grid_.count_y();
  const double mean = loose_volume() / (grid_.cell_area() * n);
  double sum = 0;
  for (int iy = 0; iy < grid_.count_y(); ++iy) {
    for (int ix = 0; ix < grid_.count_x(); ++ix) sum += (grid_.at(ix, iy) - mean) * (grid_.at(ix, iy) - mean);
  }
  return std::sqrt(sum / n);
}

}  // namespace berm::plant
