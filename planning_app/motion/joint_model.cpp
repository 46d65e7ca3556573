#include "motion/joint_model.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

std::size_t JointModel::delay_steps() const {
  return static_cast<std::size_t>(std::lround(response_.up.dead_time / step_));
}

JointModel::State JointModel::moved(State state, double command) const {
  const double before = state.velocity;
  const bool up = before > 0.0 || (before == 0.0 && command > 0.0);
  state.velocity = speed_after(up ? response_.up : response_.down, before, command, step_);
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
  while (under_way_.size() > delay_steps()) {  // more than one only when the dead time became shorter
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
  const double braking = response.deceleration > 0.0 ? response.deceleration : response.acceleration;
  const double ramps = 1.0 / response.acceleration + 1.0 / braking;  // s for a rad/s, up and down
  const double peak = std::min(response.velocity_max, std::sqrt(2.0 * distance / ramps));
  return response.dead_time + response.lag + peak * ramps + (distance - 0.5 * peak * peak * ramps) / peak;
}

}  // namespace berm::app
