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

ControllerLimits ArmController::limits_at(std::size_t joint, double reach_m) {
  controller_[joint].respond(responses_of(*machine_, joint, reach_m, payload_kg_));
  return limits_of(*machine_, joint, reach_m, payload_kg_);
}

Joints ArmController::toward(const Joints& goals, const Joints& paces, const Joints& tempos, const Joints& angle, const Joints& velocity) {
  Joints command{};
  const double reach = reach_of(*machine_, angle);
  for (std::size_t j = 0; j < joints; ++j) {
    ControllerLimits limits = limits_at(j, reach);
    if (j == swing) swing_deceleration_ = limits.deceleration = std::max(limits.deceleration, swing_at_least_);
    const double learned = (goals[j] >= angle[j] ? learned_.up : learned_.down)[j];
    limits.velocity *= paces[j] * learned;
    limits.deceleration *= learned * learned;
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
    const double wanted = controller_[j].follow(reference[j], reference_velocity[j], angle[j], velocity[j], limits_at(j, reach));
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

Joints ArmController::taken_up(const Joints& angle, const Joints& velocity) const {
  constexpr double most_of_lag = 0.6;  // with half of it a stop was foreseen 1.4 cm nearer to a zone's floor than was asked for
  Joints later{};
  for (std::size_t j = 0; j < joints; ++j) {
    const JointModel::State then = controller_[j].predict(angle[j], velocity[j]);
    later[j] = then.angle + most_of_lag * controller_[j].lag() * then.velocity;
  }
  return later;
}

}  // namespace berm::app
