#include "perception/scan_intake.hpp"

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

void ScanIntake::hand_on(const ScanlinePart& part, TerrainMap& terrain, BedMap* bed, int& points) {
  for (const ScanReturn& s : part.samples()) {
    if (!s.usable()) continue;
    ++counts_.returns;
    if (s.flagged()) {
      ++counts_.flagged;
      // What is alone beside the own bucket comes again as long as the bucket hides the ground behind it.
      if (s.lone || !second_sweep_.confirms(terrain, s.x, s.y, s.z, s.time_s)) continue;
      ++counts_.confirmed;
    }
    terrain.insert(s.x, s.y, s.z, s.time_s);
    if (bed != nullptr) bed->insert(s.x, s.y, s.z, s.time_s);
    ++points;
  }
}

int ScanIntake::take(const berm_state_segment& segment, TerrainMap& terrain, BedMap* bed, TruckSweep& sweep) {
  constexpr std::int64_t most_ahead_ns = 1'000'000'000;  // of the machine's newest state; what is further ahead is no time of this clock
  history_.take(segment);
  const std::uint32_t head = __atomic_load_n(&segment.scan_head, __ATOMIC_ACQUIRE);
  if (!started_ || head - next_ > BERM_SCAN_RING) {
    const std::uint32_t oldest = head > BERM_SCAN_RING ? head - BERM_SCAN_RING : 0;
    if (started_) counts_.blocks_missed += oldest - next_;
    next_ = oldest;
    started_ = true;
  }
  int points = 0;
  berm_scan_block block;
  for (; next_ != head; ++next_) {
    if (!copy_scan_block(segment, next_, block)) {
      ++counts_.blocks_missed;
      continue;
    }
    if (!well_formed(block)) {
      ++counts_.blocks_refused;
      continue;
    }
    const std::int64_t ahead_ns = block.time_us * 1000 + std::int64_t{block.sample_period_ns} * (block.count - 1) - history_.newest_ns();
    if (ahead_ns > 0 && ahead_ns <= most_ahead_ns) break;
    if (ahead_ns > 0) {
      ++counts_.blocks_refused;
      continue;
    }
    for (const ScanlinePart& part : processor_.take(block, history_)) {
      sweep.take(part);
      hand_on(part, terrain, bed, points);
    }
  }
  return points;
}

}  // namespace berm::app
