#include "perception/scan_intake.hpp"

#include <algorithm>
#include <cstring>

namespace berm::app {

bool copy_scan_block(const berm_state_segment& segment, std::uint32_t n, berm_scan_block& out) {
  const berm_scan_block& source = segment.scan[n % BERM_SCAN_RING];
  const std::uint32_t complete = 2u * n + 2u;
  if (__atomic_load_n(&source.sequence, __ATOMIC_ACQUIRE) != complete) return false;
  std::memcpy(&out, &source, sizeof out);
  __atomic_thread_fence(__ATOMIC_ACQUIRE);
  return __atomic_load_n(&source.sequence, __ATOMIC_RELAXED) == complete;
}

int ScanIntake::take(const berm_state_segment& segment, TerrainMap& terrain, BedMap* bed, TruckSweep& sweep) {
  const std::uint32_t head = __atomic_load_n(&segment.scan_head, __ATOMIC_ACQUIRE);
  if (!started_ || head - next_ > BERM_SCAN_RING) {
    const std::uint32_t oldest = head > BERM_SCAN_RING ? head - BERM_SCAN_RING : 0;
    if (started_) missed_ += oldest - next_;
    next_ = oldest;
    started_ = true;
  }
  int points = 0;
  berm_scan_block block;
  for (; next_ != head; ++next_) {
    if (!copy_scan_block(segment, next_, block)) {
      ++missed_;
      continue;
    }
    sweep.take(block);
    const int count = std::min<int>(block.count, BERM_SCAN_BLOCK_SAMPLES);
    const double time_s = static_cast<double>(block.time_us) * 1e-6;
    for (int i = 0; i < count; ++i) {
      if (block.used[i] != 1) continue;
      const double x = block.point_mm[i][0] * 1e-3, y = block.point_mm[i][1] * 1e-3, z = block.point_mm[i][2] * 1e-3;
      terrain.insert(x, y, z, time_s);
      if (bed != nullptr) bed->insert(x, y, z, time_s);
      ++points;
    }
  }
  return points;
}

}  // namespace berm::app
