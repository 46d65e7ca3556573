// Turns a joint goal into velocity requests: accelerates to the speed limit, decelerates on v = sqrt(2 a d), lands without overshoot.
#pragma once

#include "motion/joint_model.hpp"

namespace berm::app {

struct ControllerLimits {
  double velocity = 0.0;      // rad/s
  double acceleration = 0.0;  // rad/s2, of requests while speeding up
  double deceleration = 0.0;  // rad/s2, what the joint can surely brake with
  double landing_gain = 0.0;  // 1/s, speed per angle left near the goal
};

// Limits under what the machine file promises: a share of the braking ability at the reach (m), of the acceleration and of the speed.
ControllerLimits limits_of(const MachineModel& machine, std::size_t joint, double reach_m);

class JointController {
public:
  JointController(const JointResponse& response, double step_s) : model_(response, step_s), step_(step_s) {}

  // The request for this step, from the measured angle and velocity.
  double toward(double goal, double measured_angle, double measured_velocity, const ControllerLimits& limits);
  // The request that follows a moving reference (rad, rad/s) that is meant for the time when the request acts.
  double follow(double reference, double reference_velocity, double measured_angle, double measured_velocity, const ControllerLimits& limits);
  // What became of the request: the kernel may have cut it.
  void sent(double command);

  JointModel::State predict(double measured_angle, double measured_velocity) const { return model_.predict(measured_angle, measured_velocity); }

private:
  double ramped(double wanted, const ControllerLimits& limits);

  JointModel model_;
  double step_;
  double last_ = 0.0;
};

}  // namespace berm::app
