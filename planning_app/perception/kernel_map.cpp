#include "perception/kernel_map.hpp"

#include <limits>

namespace berm::app {

namespace {

constexpr int side = BERM_MAP_CELLS;
constexpr double level_ground = 0.0, infinite = std::numeric_limits<double>::infinity();

}  // namespace

KernelMap::KernelMap() : level_(static_cast<std::size_t>(side * side), level_ground), blocked_(level_.size(), infinite) {}

void KernelMap::take(const berm_state_segment& segment) {
  cell_ = segment.cell_mm > 0 ? segment.cell_mm * 1e-3 : 0.3;
  origin_ = segment.map_origin_mm * 1e-3;
  void_ = true;
  for (int iy = 0; iy < side; ++iy)
    for (int ix = 0; ix < side; ++ix) {
      const std::size_t i = static_cast<std::size_t>(iy * side + ix);
      const double height = __atomic_load_n(&segment.map_height_mm[iy][ix], __ATOMIC_RELAXED) * 1e-3;
      const auto status = __atomic_load_n(&segment.map_status[iy][ix], __ATOMIC_RELAXED);
      const bool seen = status == BERM_CELL_OBSERVED || status == BERM_CELL_STALE;
      void_ = void_ && !seen;
      level_[i] = seen ? height : level_ground;
      // Under the own body level as well: the implements' least distance from the axis is checked by itself.
      blocked_[i] = status == BERM_CELL_OBSERVED ? height : status == BERM_CELL_OWN_BODY ? level_ground : infinite;
    }
}

CellGround KernelMap::ground(Unseen unseen) const {
  const bool blocks = unseen == Unseen::blocked;
  return {cell_, origin_, side, blocks ? blocked_.data() : level_.data(), blocks ? infinite : level_ground};
}

}  // namespace berm::app
