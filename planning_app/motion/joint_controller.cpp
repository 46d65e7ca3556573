#include "motion/joint_controller.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

namespace {

// Shares of what the machine file promises. The rest is for payload, shared pump flow and the kernel's own error bounds.
constexpr double swing_share = 0.775;  // faster no pass was shorter, and a stop from there reaches over ground that no sweep has seen lately
constexpr double arm_share = 0.99;
constexpr double brake_share = 0.90;
constexpr double empty_swing_brake_share = 0.75;  // of what was identified; harder landings made no pass shorter, and overrun by more where a brake is weak
constexpr double acceleration_share = 0.85;  // the file's is an upper bound, measured on an empty machine too: a loaded one does less
constexpr double bus_step = 0.0005;       // rad/s; the kernel cuts every command to whole ones
constexpr double landing_gain = 4.5;      // 1/s; the dead time is predicted away, noise and a slower joint than its model remain

double table_deceleration(const BrakingTable& table, std::size_t joint, double reach_m, double velocity_max) {
  std::size_t row = 0;
  while (row + 1 < table.reach.size() && table.reach[row] < reach_m) ++row;
  // A row's figure is that of its upper end: between two ends the joint brakes as far as between their figures.
  const double upper = table.angle[joint][row].back(), lower = row == 0 ? upper : table.angle[joint][row - 1].back();
  const double share = row == 0 ? 1.0 : std::clamp((reach_m - table.reach[row - 1]) / (table.reach[row] - table.reach[row - 1]), 0.0, 1.0);
  return velocity_max * velocity_max / (2.0 * (lower + share * (upper - lower)));
}

}  // namespace

ControllerLimits limits_of(const MachineModel& machine, std::size_t joint, double reach_m) {
  const JointLimits& j = machine.joint[joint];
  const double acceleration = acceleration_share * j.acceleration_max;
  const double brake = std::min(table_deceleration(machine.braking, joint, reach_m, j.velocity_max), acceleration);
  return {(joint == swing ? swing_share : arm_share) * j.velocity_max, acceleration, brake_share * brake, landing_gain};
}

ControllerLimits limits_of(const MachineModel& machine, std::size_t joint, double reach_m, double payload_kg) {
  ControllerLimits limits = limits_of(machine, joint, reach_m);
  if (!machine.responses) return limits;
  const TwoWayResponse response = responses_of(machine, joint, reach_m, payload_kg);
  limits.acceleration = std::min(response.up.acceleration, response.down.acceleration);
  const double able = std::min(response.up.deceleration, response.down.deceleration);
  if (joint != swing) limits.deceleration = brake_share * able;
  // A loaded swing lands beside the truck. Harder than by the braking table, by which the kernel foresees its stops, it would come so fast that it is slowed.
  else limits.deceleration = payload_kg > 0.0 ? std::min(brake_share * able, limits.deceleration) : empty_swing_brake_share * able;
  return limits;
}

double JointController::ramped(double wanted, double from, const ControllerLimits& limits, const Ramp& ramp) const {
  const double up = limits.acceleration * step_;
  // Slowing is never delayed beyond what the deceleration profile asks for; only growth of speed is ramped.
  if (std::fabs(wanted) <= std::fabs(from) && wanted * from >= 0.0) return wanted;
  // Of a joint that is faster than it is asked to be, and is slowed, nothing more is asked for at once.
  const double most = from >= ramp.then ? std::max(from + up, ramp.then + ramp.ahead) : from + up;
  const double least = from <= ramp.then ? std::min(from - up, ramp.then - ramp.ahead) : from - up;
  return std::clamp(wanted, least, most);
}

double JointController::proposed(double wanted, const ControllerLimits& limits, const Ramp& ramp) {
  const bool whole = std::fabs(uncut_ - last_) < bus_step;  // a speed that was cut does not jump
  uncut_ = ramped(wanted, uncut_, limits, ramp);
  proposal_ = std::clamp(ramped(wanted, last_, limits, whole ? ramp : Ramp{ramp.then}), low_, high_);
  return *proposal_;
}

void JointController::heard(double commanded, double low, double high, int steps) {
  for (int k = 0; k < steps; ++k) model_.remember(commanded);
  low_ = low;
  high_ = high;
  const double let_out = std::clamp(last_, low, high);
  // As the request holds it, in whole millionths: a difference of just a step is none in the kernel's record either.
  constexpr double micro = 1e6;
  cut_ = let_out != 0.0 && std::fabs(std::trunc(last_ * micro) - std::round(let_out * micro)) > std::round(bus_step * micro);
  // Else a speed that was cut would jump when the room is there again.
  last_ = let_out;
  proposal_.reset();
}

double JointController::toward(double goal, double measured_angle, double measured_velocity, const ControllerLimits& limits) {
  const JointModel::State then = model_.predict(measured_angle, measured_velocity);
  // What is asked for has been taken up only a lag later: what is left then decides.
  const double left = goal - then.angle - then.velocity * lag();
  const double distance = std::fabs(left);
  // Below the switching distance a proportional landing replaces the square root, whose slope has no bound at zero.
  const double switching = limits.deceleration / (limits.landing_gain * limits.landing_gain);
  const double profile = distance > switching ? std::sqrt(limits.deceleration * (2.0 * distance - switching)) : limits.landing_gain * distance;
  const double speed = std::min(limits.velocity, profile);
  // A joint that lags behind its command speeds up as it can only while the command is so far ahead.
  return proposed(std::copysign(speed, left), limits, {then.velocity, limits.acceleration * lag()});
}

double JointController::follow(double reference, double reference_velocity, double measured_angle, double measured_velocity, const ControllerLimits& limits) {
  const JointModel::State then = model_.predict(measured_angle, measured_velocity);
  const double off = reference - then.angle + (reference_velocity - then.velocity) * lag();  // a lag later
  const double wanted = reference_velocity + limits.landing_gain * off;
  return proposed(std::clamp(wanted, -limits.velocity, limits.velocity), limits, {then.velocity});
}

void JointController::asked(double command) {
  // What a guard of the app's own took away is no cut of the kernel's.
  if (!proposal_) uncut_ = command;
  else if (*proposal_ != 0.0) uncut_ *= command / *proposal_;
  last_ = command;
}

void JointController::sent(double command) {
  asked(command);
  const double limit = model_.response().up.velocity_max;
  heard(command, -limit, limit);
}

double JointController::share() const {
  if (std::fabs(uncut_) < bus_step) return 1.0;
  return std::clamp(last_ / uncut_, 0.0, 1.0);
}

}  // namespace berm::app
