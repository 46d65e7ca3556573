// Turns a joint goal into velocity requests: accelerates to the speed limit, decelerates on v = sqrt(2 a d), lands without overshoot. Where the
// kernel lets out less, the profile goes on from that, and the prediction is made from it.
#pragma once

#include <optional>

#include "motion/joint_model.hpp"

namespace berm::app {

struct ControllerLimits {
  double velocity = 0.0;      // rad/s
  double acceleration = 0.0;  // rad/s2, of requests while speeding up
  double deceleration = 0.0;  // rad/s2, what the joint can surely brake with
  double landing_gain = 0.0;  // 1/s, speed per angle left near the goal

  // The same motion in slower time: the joint passes the same angles at this share of the speeds.
  ControllerLimits at_tempo(double share) const { return {share * velocity, share * share * acceleration, share * share * deceleration, share * landing_gain}; }
};

// Limits under what the machine file promises: a share of the braking ability at the reach (m), of the acceleration and of the speed.
ControllerLimits limits_of(const MachineModel& machine, std::size_t joint, double reach_m);
// The same under what was identified of the joint with so much in the bucket, where anything was.
ControllerLimits limits_of(const MachineModel& machine, std::size_t joint, double reach_m, double payload_kg);

class JointController {
public:
  JointController(const JointResponse& response, double step_s) : JointController(TwoWayResponse{response, response}, step_s) {}
  JointController(const TwoWayResponse& response, double step_s)
      : model_(response, step_s), step_(step_s), low_(-response.up.velocity_max), high_(response.up.velocity_max) {}

  // How the joint answers from now on.
  void respond(const TwoWayResponse& response) { model_.respond(response); }

  // At the start of each step: what the machine was told in each of the steps since the last, and between which speeds (low <= 0 <= high)
  // requests are permitted now.
  void heard(double commanded, double low, double high, int steps = 1);

  // The request for this step, from the measured angle and velocity.
  double toward(double goal, double measured_angle, double measured_velocity, const ControllerLimits& limits);
  // The request that follows a moving reference (rad, rad/s) that is meant for the time when the request acts.
  double follow(double reference, double reference_velocity, double measured_angle, double measured_velocity, const ControllerLimits& limits);
  // At the end of each step: what was asked for; the app's guards may have lowered it.
  void asked(double command);
  // Both, where there is no kernel to cut anything: asked, and heard a step later.
  void sent(double command);

  // Of the speed that it would ask for here had the kernel never cut a request, what it may ask for: 1 when nothing was cut or that speed is
  // reached again.
  double share() const;
  // What it asked for last was more than is permitted now, which is more than nothing.
  bool cut() const { return cut_; }
  double lag() const { return model_.response().up.lag; }  // s
  // With the commands under way; where the joint is it does not know.
  const JointModel& model() const { return model_; }
  JointModel::State predict(double measured_angle, double measured_velocity) const { return model_.predict(measured_angle, measured_velocity); }

private:
  // How fast a request may grow: by the acceleration from the one before; ahead: besides to so much more than the joint's speed when it acts.
  struct Ramp { double then, ahead = 0.0; };  // rad/s
  double ramped(double wanted, double from, const ControllerLimits& limits, const Ramp& ramp) const;
  double proposed(double wanted, const ControllerLimits& limits, const Ramp& ramp);

  JointModel model_;
  double step_;
  double low_, high_;            // permitted
  double last_ = 0.0;            // asked for, or what of it was let out
  double uncut_ = 0.0;           // asked for had nothing ever been cut
  std::optional<double> proposal_;  // of this step
  bool cut_ = false;
};

}  // namespace berm::app
