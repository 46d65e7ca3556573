#include "app/motion_guard.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace berm::app {

namespace {

struct Share { double swing, arm; };
constexpr std::array<Share, 10> shares{{{1.0, 1.0}, {0.75, 1.0}, {0.5, 1.0}, {0.75, 0.6}, {0.25, 1.0}, {0.5, 0.5}, {0.0, 1.0}, {0.0, 0.6}, {0.0, 0.3}, {0.0, 0.15}}};

constexpr double a_little = radians(5.0);

// Where a request leads, a little on.
Joints led_on(const Joints& angle, const Joints& command) {
  double most = 0.0;
  for (const double v : command) most = std::max(most, std::fabs(v));
  Joints on = angle;
  for (std::size_t j = 0; j < joints && most > 0.0; ++j) on[j] += a_little * command[j] / most;
  return on;
}

}  // namespace

Joints guarded(const MachineModel& machine, const Skyline& skyline, const Joints& angle, const Joints& command) {
  for (const Share& share : shares) {
    Joints slowed = command;
    slowed[swing] *= share.swing;
    for (const std::size_t j : {boom, stick, bucket}) slowed[j] *= share.arm;
    if (skyline.clear(angle, slowed)) return slowed;
  }
  const Joints creep = crept(machine, command);
  const auto blocking = skyline.blocking(preview(machine, angle, creep));
  return blocking && skyline.stands_too_high(*blocking) && !skyline.clear(led_on(angle, command), {}) ? Joints{} : creep;
}

Joints crept(const MachineModel& machine, const Joints& command) {
  Joints creep = command;
  for (std::size_t j = 0; j < joints; ++j) {
    const double limit = 0.9 * machine.joint[j].creep_velocity;
    creep[j] = std::clamp(command[j], -limit, limit);
  }
  return creep;
}

bool cut_short(const Joints& angle, const Joints& wanted, const Joints& allowed, const std::optional<Joints>& goals) {
  constexpr double there = radians(1.0);
  for (std::size_t j = 0; j < joints; ++j)
    if (allowed[j] != wanted[j] && !(goals && std::fabs(wrapped((*goals)[j] - angle[j])) < there)) return true;
  return false;
}

}  // namespace berm::app
