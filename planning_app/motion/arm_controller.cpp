#include "motion/arm_controller.hpp"

#include <algorithm>

#include "motion/reach_preview.hpp"

namespace berm::app {

namespace {

JointController controller_for(const MachineModel& machine, std::size_t joint) {
  return JointController(response_of(machine, joint), machine.cycle);
}

}  // namespace

ArmController::ArmController(const MachineModel& machine)
    : machine_(&machine),
      controller_{controller_for(machine, swing), controller_for(machine, boom), controller_for(machine, stick), controller_for(machine, bucket)} {}

Joints ArmController::toward(const Joints& goals, const Joints& paces, const Joints& tempos, const Joints& angle, const Joints& velocity) {
  Joints command{};
  const double reach = reach_of(*machine_, angle);
  for (std::size_t j = 0; j < joints; ++j) {
    ControllerLimits limits = limits_of(*machine_, j, reach);
    if (j == swing) swing_deceleration_ = limits.deceleration = std::max(limits.deceleration, swing_at_least_);
    limits.velocity *= paces[j];
    limits = limits.at_tempo(tempos[j]);
    const double then = controller_[j].predict(angle[j], velocity[j]).angle;
    command[j] = within_range(*machine_, j, reach, then, controller_[j].toward(goals[j], angle[j], velocity[j], limits));
  }
  return command;
}

Joints ArmController::follow(const Joints& reference, const Joints& reference_velocity, const Joints& angle, const Joints& velocity) {
  Joints command{};
  const double reach = reach_of(*machine_, angle);
  for (std::size_t j = 0; j < joints; ++j) {
    const double wanted = controller_[j].follow(reference[j], reference_velocity[j], angle[j], velocity[j], limits_of(*machine_, j, reach));
    command[j] = within_range(*machine_, j, reach, controller_[j].predict(angle[j], velocity[j]).angle, wanted);
  }
  return command;
}

void ArmController::heard(const Joints& commanded, const Joints& permitted_low, const Joints& permitted_high, int cycles) {
  for (std::size_t j = 0; j < joints; ++j) controller_[j].heard(commanded[j], permitted_low[j], permitted_high[j], cycles);
}

void ArmController::asked(const Joints& command) {
  for (std::size_t j = 0; j < joints; ++j) controller_[j].asked(command[j]);
}

void ArmController::sent(const Joints& command) {
  for (std::size_t j = 0; j < joints; ++j) controller_[j].sent(command[j]);
}

Joints ArmController::shares() const {
  Joints share{};
  for (std::size_t j = 0; j < joints; ++j) share[j] = controller_[j].share();
  return share;
}

Joints ArmController::predicted(const Joints& angle, const Joints& velocity) const {
  Joints then{};
  for (std::size_t j = 0; j < joints; ++j) then[j] = controller_[j].predict(angle[j], velocity[j]).angle;
  return then;
}

}  // namespace berm::app
