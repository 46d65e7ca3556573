// How hard the swing can brake, learned from its own landings. The braking table of the machine file is that of the heaviest payload, so that an empty
// bucket's swing could land much harder: after each landing that kept to what was asked a little more is asked, until one does not.
#pragma once

namespace berm::app {

class SwingBraking {
public:
  // most: rad/s2, never asked for more.
  explicit SwingBraking(double most) : most_(most) {}

  // Once a cycle while the swing is moved towards a goal: its measured speed (rad/s), and the deceleration that its controller now plans with.
  void step(double time_s, double velocity, double planned);
  // It is slowed for another reason than that it lands: of that slowing down nothing is learned.
  void forget();
  // What a landing may be planned with, also where the table allows less.
  double known() const { return known_; }  // rad/s2; 0 before the first

private:
  void judge(double reached, double planned);

  double most_;
  double known_ = 0.0;                    // rad/s2
  double limit_ = 1e9;                    // what was not reached
  double peak_ = 0.0;                     // of this swing, rad/s
  double from_s_ = -1.0, from_ = 0.0, planned_ = 0.0;
};

}  // namespace berm::app
