#include "motion/dig_stall.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

void DigStall::add(const DigEffort& effort, double dt) {
  constexpr double smoothing = 0.1;    // s
  constexpr double gets_on = 0.2;      // m/s of the tip: slower, and the force is not overcome
  constexpr double hard = 0.7;         // of the hardest: soil seldom breaks at the very limit
  constexpr double least_share = 0.05; // of a request that the kernel lets out; less is a stop
  if (effort.force_n) force_n_ += (*effort.force_n - force_n_) * (1.0 - std::exp(-dt / smoothing));
  if (effort.force_n && !effort.held && effort.tip_speed > gets_on) hardest_n_ = std::max(hardest_n_, force_n_);
  if (!effort.held) {
    held_s_ = pressed_s_ = 0.0;
    return;
  }
  const double counts = std::max(least_share, effort.let_out) * dt;
  held_s_ += counts;
  if (!effort.force_n || force_n_ > hard * hardest_n_) pressed_s_ += counts;
}

DigStall::Told DigStall::told() const {
  constexpr double patience = 1.0, patience_unpressed = 3.0;  // s
  if (pressed_s_ > patience) return Told::by_soil;
  return held_s_ > patience_unpressed ? Told::standing : Told::no;
}

}  // namespace berm::app
