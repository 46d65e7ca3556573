#include "motion/bucket_weight.hpp"

#include <algorithm>

namespace berm::app {

namespace {
constexpr double gravity = 9.81;
}

double weight_in_bucket(const MachineModel& machine, const Joints& angle, const Moments& held, const Moments& empty) {
  constexpr double least_share = 0.3, unknown = -1.0;
  const ArmPoints arm = forward(machine, angle);
  // A weight's moments about the boom's and the stick's pin differ by it times the way between them, wherever in the bucket it lies.
  const double way = arm.stick_pin.r - arm.boom_pin.r;
  if (way < least_share * machine.boom_length) return unknown;
  return std::max(0.0, ((held[0] - empty[0]) - (held[1] - empty[1])) / (gravity * way));
}

Moments without_load(const MachineModel& machine, const Joints& angle, const Moments& held, double kg) {
  const ArmPoints arm = forward(machine, angle);
  const double r = 0.5 * (arm.bucket_pin.r + arm.tip.r), weight = gravity * kg;
  return {held[0] - weight * (r - arm.boom_pin.r), held[1] - weight * (r - arm.stick_pin.r), held[2] - weight * (r - arm.bucket_pin.r)};
}

}  // namespace berm::app
