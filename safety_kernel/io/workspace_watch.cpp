#include "io/workspace_watch.hpp"

#include <algorithm>

namespace berm::kernel {

WorkspaceWatch::WorkspaceWatch(const berm_parameters& parameters)
    : parameters_(parameters),
      lidars_(std::clamp<int>(parameters.lidars, 0, BERM_LIDARS)),
      scanners_(parameters, parameters.workspace_wait_us, parameters.workspace_period_us),
      lidar_{{parameters, 0}, {parameters, 1}} {
  static_assert(BERM_LIDARS == 2);
}

void WorkspaceWatch::begin() {
  scanners_.begin();
  for (int i = 0; i < lidars_; ++i) lidar_[i].begin();
  for (Last& last : last_) last = Last{};
}

void WorkspaceWatch::take(const ScanBlocks& blocks, std::int64_t now_us) {
  if (!watched()) return;
  for (int b = 0; b < blocks.count; ++b) {
    const berm_scan_block& block = blocks.block[b];
    Last& last = last_[block.scanner % BERM_SCANNERS];
    for (int i = 0; i < block.count; ++i) {
      const sk_point point{block.point_mm[i][0], block.point_mm[i][1], block.point_mm[i][2]};
      const std::int32_t index = block.first_index + i;
      if (block.used[i] == 0) continue;
      const bool follows = last.scanline == block.scanline && last.index + 1 == index;
      if (follows) scanners_.interpolate(last.point, point, MonitorWatch::Over::kEverything, now_us);
      scanners_.insert(point, now_us);
      last = {block.scanline, index, point};
    }
  }
}

void WorkspaceWatch::take(int lidar, const Vlp16Packet& packet, const JointAngles& joints, std::int64_t now_us) {
  if (watched() && lidar >= 0 && lidar < lidars_) lidar_[lidar].take(packet, joints, now_us);
}

void WorkspaceWatch::trucks(bool spotter_fresh, bool parked) {
  if (!watched() || !spotter_fresh || parked != lanes_open_) return;
  lanes_open_ = !parked;
  scanners_.change_lanes(parameters_, lanes_open_);
  for (int i = 0; i < lidars_; ++i) lidar_[i].monitor().change_lanes(parameters_, lanes_open_);
}

bool WorkspaceWatch::step(std::int64_t now_us) {
  if (!watched()) return false;
  bool stop = scanners_.step(now_us);
  for (int i = 0; i < lidars_; ++i) stop = lidar_[i].monitor().step(now_us) || stop;
  return stop;
}

bool WorkspaceWatch::place(std::int32_t& x_mm, std::int32_t& y_mm, std::int32_t& height_mm) const {
  for (int number = 0; number < monitors(); ++number)
    if (of(number).place(x_mm, y_mm, height_mm)) return true;
  return false;
}

}  // namespace berm::kernel
