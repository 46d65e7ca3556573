#include "perception/truck_sweep.hpp"

#include <algorithm>

namespace berm::app {

void TruckSweep::begin(std::size_t scanner) {
  *this = {};
  scanner_ = scanner;
  recording_ = true;
}

void TruckSweep::take(const berm_scan_block& block) {
  if (!recording_ || block.scanner != scanner_) return;
  if (any_ && block.scanline != line_) ++lines_;
  any_ = true;
  line_ = block.scanline;
  const int count = std::min<int>(block.count, BERM_SCAN_BLOCK_SAMPLES);
  for (int i = 0; i < count && points_.size() < most_points; ++i) {
    returns_ += block.echoes[i] > 0 ? 1 : 0;
    several_ += block.echoes[i] > 1 ? 1 : 0;
    if (block.used[i] != 1) continue;
    const double time_s = static_cast<double>(block.time_us) * 1e-6 + i * static_cast<double>(block.sample_period_ns) * 1e-9;
    points_.push_back({static_cast<float>(block.point_mm[i][0]) * 1e-3F, static_cast<float>(block.point_mm[i][1]) * 1e-3F,
                       static_cast<float>(block.point_mm[i][2]) * 1e-3F, lines_, time_s});
  }
}

}  // namespace berm::app
