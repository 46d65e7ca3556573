#include "app/motion_guard.hpp"

#include <algorithm>
#include <array>

namespace berm::app {

namespace {

struct Share { double swing, arm; };
constexpr std::array<Share, 10> shares{{{1.0, 1.0}, {0.75, 1.0}, {0.5, 1.0}, {0.75, 0.6}, {0.25, 1.0}, {0.5, 0.5}, {0.0, 1.0}, {0.0, 0.6}, {0.0, 0.3}, {0.0, 0.0}}};

}  // namespace

Joints guarded(const MachineModel& machine, const Skyline& skyline, const Joints& angle, const Joints& command) {
  for (const Share& share : shares) {
    Joints slowed = command;
    slowed[swing] *= share.swing;
    for (const std::size_t j : {boom, stick, bucket}) slowed[j] *= share.arm;
    if (skyline.clear(angle, slowed)) return slowed;
  }
  const auto standing = skyline.blocking(preview(machine, angle, {}));
  return standing && standing->what == Skyline::Blocking::What::too_high ? Joints{} : crept(machine, command);
}

Joints crept(const MachineModel& machine, const Joints& command) {
  Joints creep = command;
  for (std::size_t j = 0; j < joints; ++j) {
    const double limit = 0.9 * machine.joint[j].creep_velocity;
    creep[j] = std::clamp(command[j], -limit, limit);
  }
  return creep;
}

}  // namespace berm::app
