#include "motion/overrun_limits.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

namespace {

constexpr double lowest = 0.5;
constexpr double spare = 0.90;             // beyond what the last overrun alone asks for
constexpr double unlearned = 0.004;        // by a landing that kept to goal and model
constexpr double says_something = radians(10.0);  // rad/s, peak of such a landing

}  // namespace

bool OverrunLimits::judge(std::size_t joint, bool loaded, const Braking& braking) {
  double& pace = (braking.positive ? pace_[loaded].up : pace_[loaded].down)[joint];
  if (overran(braking)) {
    // A way of stopping grows with the square of the speed.
    pace = std::max(lowest, spare * std::sqrt(braking.share) * pace);
    return true;
  }
  if (braking.peak > says_something) pace = std::min(1.0, pace + unlearned);
  return false;
}

}  // namespace berm::app
