// A joint under commands with dead time, and readings of it with errors and age: what motion supervision sees. No formula of the core. Angles in
// urad, speeds in urad/s, times in us.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

namespace berm::core_test {

class SupervisedMachine {
 public:
  struct Make {
    double deceleration, acceleration;    // urad/s2
    double angle_error, velocity_error;   // of readings; and of how a command is obeyed
    std::int64_t dead_time_us;
  };
  SupervisedMachine(const Make& make, double angle, double speed) : make_(make), angle_(angle), speed_(speed), obeyed_(speed) { note(); }

  void command(double velocity_urad_s) { pending_.push_back({now_us_ + make_.dead_time_us, velocity_urad_s}); }
  // Goes on to now_us; follow_error within +-1: share of the velocity error by which a command is missed.
  void run_to(std::int64_t now_us, double follow_error);

  double angle() const { return angle_; }
  double speed() const { return speed_; }
  struct State { double angle, speed; };
  // As it was that long ago, at most 200 ms.
  State before(std::int64_t age_us) const;

 private:
  static constexpr std::int64_t kStepUs = 1000;
  struct Pending { std::int64_t due_us; double velocity; };
  void move(double target);
  void slow(double to);
  void note();

  Make make_;
  double angle_, speed_, obeyed_;
  std::int64_t now_us_ = 0;
  std::deque<Pending> pending_;
  std::deque<State> past_;  // newest last, a step apart
};

}  // namespace berm::core_test
