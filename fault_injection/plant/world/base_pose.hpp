// How the machine's base stands in the world: the base frame's origin, turned by yaw, then pitch, then roll, about that origin.
// Roll lifts the left side, pitch lowers the front.
#pragma once

#include <cmath>

#include "plant/world/link_frames.hpp"
#include "plant/world/vec3.hpp"

namespace berm::plant {

struct BasePose {
  double x = 0, y = 0, yaw = 0, roll = 0, pitch = 0;
  bool operator==(const BasePose&) const = default;
};

class BaseFrame {
 public:
  BaseFrame() = default;
  explicit BaseFrame(const BasePose& p) : at_{p.x, p.y, 0} {
    const double cy = std::cos(p.yaw), sy = std::sin(p.yaw), cp = std::cos(p.pitch), sp = std::sin(p.pitch), cr = std::cos(p.roll), sr = std::sin(p.roll);
    x_ = {cy * cp, sy * cp, -sp};
    y_ = {cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr};
    z_ = {cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr};
  }
  [[nodiscard]] Vec3 turned(const Vec3& v) const { return v.x * x_ + v.y * y_ + v.z * z_; }
  [[nodiscard]] Vec3 out(const Vec3& p) const { return at_ + turned(p); }
  // Its axes in the world.
  [[nodiscard]] const Vec3& x() const { return x_; }
  [[nodiscard]] const Vec3& y() const { return y_; }
  [[nodiscard]] const Vec3& z() const { return z_; }
  [[nodiscard]] Ray out(const Ray& r) const { return {out(r.origin), turned(r.direction)}; }

 private:
  Vec3 at_, x_{1, 0, 0}, y_{0, 1, 0}, z_{0, 0, 1};  // axes of the base in the world
};

// The links as they stand over the world's ground: the swing plane turned with the base and inclined in itself. That the plane also leans sideways
// is left out: at one degree and a height of 2 m it shifts a point by 0.03 m across.
inline LinkFrames standing(const LinkFrames& links, const BasePose& base) {
  // Exactly as given where the base is level and straight, so that a run without a base motion is the same to the last bit.
  if (base.yaw == 0 && base.roll == 0 && base.pitch == 0) return links;
  const Vec3 ahead = BaseFrame(base).turned({std::cos(links.swing), std::sin(links.swing), 0});
  const double rise = std::asin(ahead.z), c = std::cos(rise), s = std::sin(rise);
  LinkFrames out = links;
  out.swing = std::atan2(ahead.y, ahead.x);
  for (LinkFrame& f : out.link) f = LinkFrame({{c * f.pin.r - s * f.pin.z, s * f.pin.r + c * f.pin.z}, f.angle + rise});
  return out;
}

}  // namespace berm::plant
