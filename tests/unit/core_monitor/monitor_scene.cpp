#include "monitor_scene.hpp"

#include <cstring>
#include <ostream>
#include <sstream>

namespace berm::core_test {

std::string flag_name(int flag) {
  switch (flag) {
    case SK_FLAG_EMPTY: return "EMPTY";
    case SK_FLAG_SET: return "SET";
    case SK_FLAG_INTERPOLATED: return "INTERPOLATED";
    case SK_FLAG_NOT_VISITED: return "NOT_VISITED";
    case SK_FLAG_INTERPOLATED_NOT_VISITED: return "INTERPOLATED_NOT_VISITED";
    case SK_FLAG_CHANGED: return "CHANGED";
    case SK_FLAG_OBSTACLE: return "OBSTACLE";
    default: break;
  }
  std::ostringstream text;
  text << "0x" << std::hex << flag;
  return text.str();
}

std::unique_ptr<sk_monitor_rules> monitor_rules(bool continuous) {
  auto rules = std::make_unique<sk_monitor_rules>();
  rules->height_threshold_mm = kHeightThreshold;
  rules->neighbour_threshold_mm = kNeighbourThreshold;
  rules->slope_threshold_mm = kSlopeThreshold;
  rules->wait_us = kWait;
  rules->period_us = kPeriod;
  rules->dwell_us = kDwell;
  rules->continuous = continuous;
  std::memset(rules->watched, 1, sizeof rules->watched);
  return rules;
}

std::ostream& operator<<(std::ostream& out, const MonitorCell& cell) {
  return out << flag_name(cell.flag) << " at " << cell.height_mm << ", obstacle " << cell.obstacle_height_mm << " mm";
}

MonitorScene::MonitorScene(bool continuous) : rules(monitor_rules(continuous)) { sk_monitor_begin(monitor.get()); }

void MonitorScene::ground(std::int32_t height_mm) {
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) accumulated(iy, ix, {SK_FLAG_SET, height_mm, -20000});
}

void MonitorScene::accumulated(int iy, int ix, const MonitorCell& cell) {
  monitor->accumulated_flag[iy][ix] = static_cast<std::uint16_t>(cell.flag);
  monitor->height_mm[iy][ix] = cell.height_mm;
  monitor->obstacle_height_mm[iy][ix] = cell.obstacle_height_mm;
}

MonitorCell MonitorScene::accumulated(int iy, int ix) const {
  return {monitor->accumulated_flag[iy][ix], monitor->height_mm[iy][ix], monitor->obstacle_height_mm[iy][ix]};
}

void MonitorScene::temporary(int iy, int ix, int flag, std::int32_t height_mm) {
  see(iy, ix, height_mm);  // takes care of the list
  monitor->temporary_flag[iy][ix] = static_cast<std::uint8_t>(flag);
  monitor->highest_mm[iy][ix] = monitor->second_mm[iy][ix] = static_cast<std::int16_t>(height_mm);
}

void MonitorScene::see(int iy, int ix, std::int32_t z_mm, int points) {
  for (int i = 0; i < points; ++i) sk_monitor_insert(monitor.get(), iy, ix, z_mm, false, now_us);
}

void MonitorScene::interpolate(int iy, int ix, std::int32_t z_mm) { sk_monitor_insert(monitor.get(), iy, ix, z_mm, true, now_us); }

bool MonitorScene::step() {
  now_us += kPeriod;
  return sk_monitor_step(monitor.get(), rules.get(), now_us, &where);
}

bool MonitorScene::settle() {
  step();
  return step();
}

}  // namespace berm::core_test
