// First-order model of a joint under closed-loop velocity control (stentz-1999, 4.4): dead time, then a velocity that follows the command
// within an acceleration limit and a velocity limit.
#pragma once

#include <deque>

#include "motion/machine_model.hpp"

namespace berm::app {

struct JointResponse {
  double dead_time = 0.1;      // from a command to its first effect, s
  double acceleration = 0.0;   // rad/s2
  double velocity_max = 0.0;   // rad/s
};

// What the machine file promises of a joint.
JointResponse response_of(const MachineModel& machine, std::size_t joint);

class JointModel {
public:
  JointModel(const JointResponse& response, double step_s) : response_(response), step_(step_s) {}

  void reset(double angle, double velocity);
  // The command takes effect dead_time later.
  void advance(double command);
  // Where the joint will be when a command given now begins to act, from a measurement made now. The model keeps the commands under way.
  struct State { double angle = 0.0, velocity = 0.0; };
  State predict(double measured_angle, double measured_velocity) const;
  // Notes a command as sent, without moving the model's own state.
  void remember(double command);

  double angle() const { return state_.angle; }
  double velocity() const { return state_.velocity; }
  const JointResponse& response() const { return response_; }

private:
  State moved(State state, double command) const;
  std::size_t delay_steps() const;

  JointResponse response_;
  double step_;
  State state_;
  std::deque<double> under_way_;  // oldest first
};

// Time from standstill at start to standstill at goal, by a trapezoidal profile after the dead time.
double time_to_reach(const JointResponse& response, double start, double goal);

}  // namespace berm::app
