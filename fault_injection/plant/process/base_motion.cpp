#include "plant/process/base_motion.hpp"

#include <algorithm>

namespace berm::plant {

std::vector<BaseMotionConfig> read_base_motions(StrictTable& file) {
  std::vector<BaseMotionConfig> all;
  for (StrictTable& t : file.tables("base_motion")) {
    BaseMotionConfig m;
    m.at_s = t.number("at_s", 0.0, 36000.0);
    m.over_s = t.number("over_s", 0.01, 600.0);
    if (t.has("start_swing_above_deg")) m.start_swing_above = t.degrees("start_swing_above_deg", -180.0, 180.0);
    m.by.x = t.number("x", -3.0, 3.0);
    m.by.y = t.number("y", -3.0, 3.0);
    m.by.yaw = t.degrees("yaw_deg", -45.0, 45.0);
    m.by.roll = t.degrees("roll_deg", -10.0, 10.0);
    m.by.pitch = t.degrees("pitch_deg", -10.0, 10.0);
    t.finish();
    all.push_back(m);
  }
  return all;
}

BaseMotion::BaseMotion(const std::vector<BaseMotionConfig>& config) {
  for (const BaseMotionConfig& c : config) motion_.push_back({c});
}

void BaseMotion::step(double t, double swing) {
  pose_ = BasePose{};
  moving_ = false;
  for (Motion& m : motion_) {
    const BaseMotionConfig& c = m.config;
    if (m.began_s < 0.0 && t >= c.at_s && (!c.start_swing_above || swing > *c.start_swing_above)) m.began_s = t;
    if (m.began_s < 0.0) continue;
    const double part = std::clamp((t - m.began_s) / c.over_s, 0.0, 1.0);
    moving_ = moving_ || t - m.began_s <= c.over_s;
    pose_.x += part * c.by.x;
    pose_.y += part * c.by.y;
    pose_.yaw += part * c.by.yaw;
    pose_.roll += part * c.by.roll;
    pose_.pitch += part * c.by.pitch;
  }
}

}  // namespace berm::plant
