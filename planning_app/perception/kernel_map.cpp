#include "perception/kernel_map.hpp"

#include <cmath>
#include <limits>

namespace berm::app {

namespace {

constexpr int side = BERM_MAP_CELLS;
constexpr double level_ground = 0.0;

}  // namespace

KernelMap::KernelMap() : height_(static_cast<std::size_t>(side * side), 0.0), status_(height_.size(), BERM_CELL_UNKNOWN) {}

void KernelMap::take(const berm_state_segment& segment) {
  cell_ = segment.cell_mm > 0 ? segment.cell_mm * 1e-3 : 0.3;
  origin_ = segment.map_origin_mm * 1e-3;
  for (int iy = 0; iy < side; ++iy)
    for (int ix = 0; ix < side; ++ix) {
      const std::size_t i = static_cast<std::size_t>(iy * side + ix);
      height_[i] = __atomic_load_n(&segment.map_height_mm[iy][ix], __ATOMIC_RELAXED) * 1e-3;
      status_[i] = __atomic_load_n(&segment.map_status[iy][ix], __ATOMIC_RELAXED);
    }
}

Ground KernelMap::ground(Unseen unseen) const {
  return [this, unseen](double x, double y) {
    const double ix = std::floor((x - origin_) / cell_), iy = std::floor((y - origin_) / cell_);
    const double blocked = unseen == Unseen::blocked ? std::numeric_limits<double>::infinity() : level_ground;
    if (!(ix >= 0.0 && iy >= 0.0 && ix < side && iy < side)) return blocked;
    const std::size_t i = static_cast<std::size_t>(iy) * side + static_cast<std::size_t>(ix);
    if (status_[i] == BERM_CELL_OBSERVED) return height_[i];
    if (status_[i] == BERM_CELL_OWN_BODY) return level_ground;  // the implements' least distance from the axis is checked by itself
    if (status_[i] == BERM_CELL_STALE && unseen == Unseen::level) return height_[i];
    return blocked;
  };
}

}  // namespace berm::app
