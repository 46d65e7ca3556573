#include "plant/machine/pan_servo.hpp"

#include <algorithm>
#include <cmath>

namespace berm::plant {

void PanServo::step(double dt, double goal, double rate) {
  constexpr int kSubsteps = 10;
  const double h = dt / kSubsteps;
  const double aim = std::clamp(goal, mount_.pan_low, mount_.pan_high);
  const double limit = std::clamp(rate, 0.0, mount_.pan_rate_max);
  for (int i = 0; i < kSubsteps; ++i) {
    const double left = aim - angle_;
    // the speed from which it can just brake before the goal, and never past the goal within this step
    const double approach = std::min({limit, std::sqrt(2.0 * 0.9 * mount_.pan_acceleration * std::abs(left)), std::abs(left) / h});
    const double wanted = left >= 0.0 ? approach : -approach;
    const double change = std::clamp(wanted - velocity_, -mount_.pan_acceleration * h, mount_.pan_acceleration * h);
    velocity_ += change;
    angle_ = std::clamp(angle_ + velocity_ * h, mount_.pan_low, mount_.pan_high);
  }
}

}  // namespace berm::plant
