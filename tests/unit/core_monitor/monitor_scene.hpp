// A Workspace Monitor with known ground, and its cells one by one.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/workspace_monitor.h"

namespace berm::core_test {

constexpr std::int32_t kHeightThreshold = 500, kNeighbourThreshold = 300, kSlopeThreshold = 1000;  // mm
constexpr std::int32_t kPeriod = 500'000, kWait = 2'000'000, kDwell = 3'000'000;                   // us

// The seven flags of Table 1 by name, in the table's order; anything else in hexadecimal.
std::string flag_name(int flag);

// Thresholds as above, every cell watched.
std::unique_ptr<sk_monitor_rules> monitor_rules(bool continuous);

struct MonitorCell {
  int flag;
  std::int32_t height_mm, obstacle_height_mm;
  bool operator==(const MonitorCell& o) const { return flag == o.flag && height_mm == o.height_mm && obstacle_height_mm == o.obstacle_height_mm; }
};
std::ostream& operator<<(std::ostream& out, const MonitorCell& cell);

class MonitorScene {
 public:
  explicit MonitorScene(bool continuous);

  // Every cell of the accumulated map SET at this height, as after a sweep over level ground.
  void ground(std::int32_t height_mm);
  void accumulated(int iy, int ix, const MonitorCell& cell);
  MonitorCell accumulated(int iy, int ix) const;
  void temporary(int iy, int ix, int flag, std::int32_t height_mm);
  int temporary_flag(int iy, int ix) const { return monitor->temporary_flag[iy][ix]; }

  // As many measured points of one height; one interpolated point.
  void see(int iy, int ix, std::int32_t z_mm, int points = 2);
  void interpolate(int iy, int ix, std::int32_t z_mm);
  // A period passes; then a step.
  bool step();
  // What is seen is in the accumulated map after two steps: one to see that the scan has passed, one to merge.
  bool settle();

  std::unique_ptr<sk_monitor> monitor = std::make_unique<sk_monitor>();
  std::unique_ptr<sk_monitor_rules> rules;
  std::int64_t now_us = 0;
  sk_monitor_cell where{};
};

}  // namespace berm::core_test
