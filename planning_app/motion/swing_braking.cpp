#include "motion/swing_braking.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

namespace {

constexpr double least_peak = 0.3;               // rad/s: of a slow swing a landing says little
constexpr double first_share = 0.65, last_share = 0.25;  // of the peak: between them the landing is measured
constexpr double kept = 0.94;                    // of the plan: the joint's lag and noise
constexpr double more = 1.25;                    // than was kept to
constexpr double still = 0.02;                   // rad/s

}  // namespace

void SwingBraking::step(double time_s, double velocity, double planned) {
  const double speed = std::fabs(velocity);
  if (speed < still) {
    forget();
    return;
  }
  if (speed >= peak_) {
    peak_ = speed;
    from_s_ = -1.0;
    return;
  }
  if (peak_ < least_peak) return;
  if (from_s_ < 0.0 && speed < first_share * peak_) {
    from_s_ = time_s;
    from_ = speed;
    planned_ = planned;
  } else if (from_s_ >= 0.0 && speed < last_share * peak_) {
    judge((from_ - speed) / (time_s - from_s_), 0.5 * (planned_ + planned));
    peak_ = 0.0;  // once a landing
    from_s_ = -1.0;
  }
}

void SwingBraking::forget() {
  peak_ = 0.0;
  from_s_ = -1.0;
}

void SwingBraking::judge(double reached, double planned) {
  if (reached >= kept * planned) {
    if (planned >= known_ * kept) known_ = std::min({more * planned, most_, limit_});
  } else if (reached < kept * known_) {
    limit_ = std::max(reached, known_ / more);
    known_ = limit_;
  }
}

}  // namespace berm::app
