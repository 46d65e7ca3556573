// Bookkeeping of one truck's load, from the on-board weighing before and after each dump.
#pragma once

namespace berm::app {

class TruckFill {
public:
  explicit TruckFill(double target_kg) : target_(target_kg) {}

  void add_pass(double before_kg, double after_kg);
  double loaded_kg() const { return loaded_; }
  int passes() const { return passes_; }
  bool full() const { return loaded_ >= full_share * target_; }
  // What the next pass should bring: the remainder spread evenly over the fewest passes of at most full_bucket_kg; never beyond the overload limit.
  double next_goal_kg(double full_bucket_kg) const;

  static constexpr double full_share = 0.96;   // a last bucket for less than this would overload it rather
  static constexpr double overload_share = 1.03;
  static constexpr double trim_share = 1.02;      // a bucket that would bring more than this lets some of it go first

private:
  double target_;
  double loaded_ = 0.0;
  int passes_ = 0;
};

}  // namespace berm::app
