#include "motion/own_machine.hpp"

#include <algorithm>
#include <cmath>

#include "motion/arm_kinematics.hpp"

namespace berm::app {

OwnMachine::OwnMachine(const MachineModel& machine) : machine_(machine) {
  for (const Prism& prism : machine_.parts) {
    Part part;
    part.link = prism.link;
    part.half_width = prism.half_width + machine_.self_margin;
    widest_ = std::max(widest_, part.half_width);
    const std::size_t n = prism.outline.size();
    for (std::size_t i = 0; i < n; ++i) {
      const auto &from = prism.outline[i], &to = prism.outline[(i + 1) % n];  // counter-clockwise: outwards is to the right
      const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
      Edge e;
      e.normal_x = (to[1] - from[1]) / length;
      e.normal_z = -(to[0] - from[0]) / length;
      e.offset = e.normal_x * from[0] + e.normal_z * from[1] + machine_.self_margin;
      part.edge.push_back(e);
      part.reach = std::max(part.reach, std::hypot(from[0], from[1]) + 2.0 * machine_.self_margin);
    }
    part_.push_back(std::move(part));
  }
  pose({});
}

void OwnMachine::pose(const Joints& angle) {
  const ArmPoints arm = forward(machine_, angle);
  const auto set = [this](std::size_t link, const PlanePoint& pin, double attitude) {
    link_[link] = {pin.r, pin.z, std::cos(attitude), std::sin(attitude)};
  };
  set(boom, arm.boom_pin, angle[boom]);
  set(stick, arm.stick_pin, arm.stick_attitude);
  set(bucket, arm.bucket_pin, arm.bucket_attitude);
}

bool OwnMachine::holds(double x, double y, double z) const {
  if (x * x + y * y < machine_.own_body_radius * machine_.own_body_radius) return true;
  const double across = std::fabs(y);
  if (across > widest_) return false;
  return std::any_of(part_.begin(), part_.end(), [&](const Part& part) {
    if (across > part.half_width) return false;
    const Link& link = link_[part.link];
    const double ahead = x - link.r, up = z - link.z;
    if (ahead * ahead + up * up > part.reach * part.reach) return false;
    const double px = ahead * link.cosine + up * link.sine, pz = up * link.cosine - ahead * link.sine;
    return std::all_of(part.edge.begin(), part.edge.end(), [&](const Edge& e) { return e.normal_x * px + e.normal_z * pz <= e.offset; });
  });
}

}  // namespace berm::app
