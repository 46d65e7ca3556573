#include "motion/joint_model.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

JointResponse response_of(const MachineModel& machine, std::size_t joint) {
  return {machine.command_latency, machine.joint[joint].acceleration_max, machine.joint[joint].velocity_max};
}

std::size_t JointModel::delay_steps() const {
  return static_cast<std::size_t>(std::lround(response_.dead_time / step_));
}

JointModel::State JointModel::moved(State state, double command) const {
  const double wanted = std::clamp(command, -response_.velocity_max, response_.velocity_max);
  const double change = response_.acceleration * step_;
  const double before = state.velocity;
  state.velocity += std::clamp(wanted - state.velocity, -change, change);
  state.angle += 0.5 * (before + state.velocity) * step_;
  return state;
}

void JointModel::reset(double angle, double velocity) {
  state_ = {angle, velocity};
  under_way_.clear();
}

void JointModel::remember(double command) {
  under_way_.push_back(command);
  while (under_way_.size() > delay_steps()) under_way_.pop_front();
}

void JointModel::advance(double command) {
  under_way_.push_back(command);
  double acting = 0.0;
  if (under_way_.size() > delay_steps()) {
    acting = under_way_.front();
    under_way_.pop_front();
  }
  state_ = moved(state_, acting);
}

JointModel::State JointModel::predict(double measured_angle, double measured_velocity) const {
  State state{measured_angle, measured_velocity};
  for (const double command : under_way_) state = moved(state, command);
  return state;
}

double time_to_reach(const JointResponse& response, double start, double goal) {
  const double distance = std::fabs(goal - start);
  if (distance == 0.0) return 0.0;
  const double ramp = response.velocity_max * response.velocity_max / response.acceleration;  // both ramps together
  if (distance <= ramp) return response.dead_time + 2.0 * std::sqrt(distance / response.acceleration);
  return response.dead_time + 2.0 * response.velocity_max / response.acceleration + (distance - ramp) / response.velocity_max;
}

}  // namespace berm::app
