// A joint in doubles, moved by closed-form steps of constant acceleration: no code and no formula of the core. Angles in urad, times in s.
#pragma once

#include <array>

namespace berm::core_test {

class SimulatedJoint {
 public:
  struct Limits {
    double acceleration_max, speed_low, speed_high;  // the speed stays between these, whatever is asked
  };
  SimulatedJoint(double angle, double speed, const Limits& limits);

  // Asks for an acceleration (cut to the limits) for a time.
  void run(double acceleration, double duration_s);
  // From now to standstill: on by this angle in the direction it moves in.
  void brake(double stop_angle);

  double speed() const { return speed_; }
  double angle() const { return angle_; }
  double lowest() const { return lowest_; }    // angle taken so far
  double highest() const { return highest_; }
  double fastest() const { return fastest_; }  // absolute speed so far

 private:
  void note();
  void step(double acceleration, double duration_s);
  Limits limits_;
  double angle_, speed_, lowest_, highest_, fastest_ = 0.0;
};

// The table's angle for a speed: that of the next faster of eight speeds from 0 to the largest.
double stop_angle(const std::array<double, 8>& table, double velocity_max, double speed);

}  // namespace berm::core_test
