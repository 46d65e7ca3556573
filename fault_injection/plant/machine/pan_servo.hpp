// Pan servo of one scanner: a goal and a rate limit, reached with bounded acceleration. Radians, relative to the upper body.
#pragma once

#include "plant/machine/implement_shape.hpp"

namespace berm::plant {

class PanServo {
 public:
  explicit PanServo(const ScannerMount& mount) : mount_(mount) {}
  void step(double dt, double goal, double rate);  // goal and rate are clamped to the mount's limits
  double angle() const { return angle_; }
  double velocity() const { return velocity_; }

 private:
  ScannerMount mount_;
  double angle_ = 0.0, velocity_ = 0.0;
};

}  // namespace berm::plant
