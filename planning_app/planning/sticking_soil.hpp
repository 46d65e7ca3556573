// Soil that sticks in the bucket: what stays is known from the weighing after a dump, and the next pass is adapted to it.
#pragma once

namespace berm::app {

class StickingSoil {
public:
  // What the bucket held at most since the dig, and what was weighed in it after the dump.
  void learn(double before_kg, double after_kg);

  // What of a bucket of so much is expected to stay; 0 while nothing is known to stick.
  double stays_kg(double carried_kg) const { return sticks() ? share_ * carried_kg : 0.0; }
  bool sticks() const { return share_ > noticed; }
  double share() const { return share_; }
  // What stayed after the last dump, however little of the load: the next dig begins with it. 0 where the weighing shows as much of nothing.
  double left_kg() const { return sticks() || in_bucket_ > nothing_kg ? in_bucket_ : 0.0; }
  // How much farther the bucket is to open over the bed, rad: more after each pass that left something, a little less after one that did not,
  // for another soil may have come.
  double open_farther() const { return open_farther_; }

private:
  static constexpr double noticed = 0.03;  // of the load; less may be the weighing's error
  static constexpr double nothing_kg = 12.0;  // the weighing's own error, in kg whatever it weighs, and a little

  double share_ = 0.0, in_bucket_ = 0.0, open_farther_ = 0.0;
};

}  // namespace berm::app
