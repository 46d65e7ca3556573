#include "simulated_joint.hpp"

#include <algorithm>
#include <cmath>

namespace berm::core_test {

SimulatedJoint::SimulatedJoint(double angle, double speed, const Limits& limits)
    : limits_(limits), angle_(angle), speed_(speed), lowest_(angle), highest_(angle) {
  note();
}

void SimulatedJoint::note() {
  lowest_ = std::min(lowest_, angle_);
  highest_ = std::max(highest_, angle_);
  fastest_ = std::max(fastest_, std::fabs(speed_));
}

void SimulatedJoint::step(double acceleration, double duration_s) {
  angle_ += speed_ * duration_s + 0.5 * acceleration * duration_s * duration_s;
  speed_ = std::clamp(speed_ + acceleration * duration_s, limits_.speed_low, limits_.speed_high);
  note();
}

void SimulatedJoint::run(double acceleration, double duration_s) {
  const double a = std::clamp(acceleration, -limits_.acceleration_max, limits_.acceleration_max);
  if (a == 0.0) {
    step(0.0, duration_s);
    return;
  }
  const double until_limit = std::max(0.0, ((a > 0.0 ? limits_.speed_high : limits_.speed_low) - speed_) / a);
  const double ramp = std::min(duration_s, until_limit);
  const double until_turn = -speed_ / a;  // the farthest angle is where the speed is zero
  if (until_turn > 0.0 && until_turn < ramp) {
    step(a, until_turn);
    step(a, ramp - until_turn);
  } else {
    step(a, ramp);
  }
  step(0.0, duration_s - ramp);
}

void SimulatedJoint::brake(double stop_angle) {
  if (speed_ == 0.0) return;
  angle_ += speed_ > 0.0 ? stop_angle : -stop_angle;
  speed_ = 0.0;
  note();
}

double stop_angle(const std::array<double, 8>& table, double velocity_max, double speed) {
  for (int column = 0; column < 8; ++column)
    if (velocity_max * column / 7.0 >= std::fabs(speed)) {
      const auto c = static_cast<std::size_t>(column);
      if (column == 0) return table[0];
      const double above = std::fabs(speed) * 7.0 / velocity_max - (column - 1);  // share of the column's width
      return table[c - 1] + (table[c] - table[c - 1]) * above;
    }
  return table[7];
}

}  // namespace berm::core_test
