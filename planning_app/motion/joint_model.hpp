// A joint moved by its response: where it is and will be, from the commands under way.
#pragma once

#include <deque>

#include "motion/joint_response.hpp"

namespace berm::app {

class JointModel {
public:
  JointModel(const JointResponse& response, double step_s) : response_{response, response}, step_(step_s) {}
  JointModel(const TwoWayResponse& response, double step_s) : response_(response), step_(step_s) {}

  // From now on, for commands under way too. Both ways have the dead time of the way up.
  void respond(const TwoWayResponse& response) { response_ = response; }
  void reset(double angle, double velocity);
  // There it is in truth; the commands under way stay so.
  void place(double angle, double velocity) { state_ = {angle, velocity}; }
  // The command that the next step obeys when it adds one.
  double acting() const { return under_way_.size() < delay_steps() || under_way_.empty() ? 0.0 : under_way_.front(); }
  // The command takes effect dead_time later.
  void advance(double command);
  // Where the joint will be when a command given now begins to act, from a measurement made now. The model keeps the commands under way.
  struct State { double angle = 0.0, velocity = 0.0; };
  State predict(double measured_angle, double measured_velocity) const;
  // Notes a command as sent, without moving the model's own state.
  void remember(double command);

  double angle() const { return state_.angle; }
  double velocity() const { return state_.velocity; }
  const TwoWayResponse& response() const { return response_; }

private:
  State moved(State state, double command) const;
  std::size_t delay_steps() const;

  TwoWayResponse response_;
  double step_;
  State state_;
  std::deque<double> under_way_;  // oldest first
};

// Time from standstill at start to standstill at goal, by a trapezoidal profile after dead time and lag.
double time_to_reach(const JointResponse& response, double start, double goal);

}  // namespace berm::app
