// Bookkeeping of one truck's load, from the on-board weighing before and after each dump, and how many passes the rest takes.
#pragma once

namespace berm::app {

class TruckFill {
public:
  // What the truck is to carry, and what a pass is planned to bring at most.
  TruckFill(double target_kg, double full_bucket_kg) : target_(target_kg), full_bucket_(full_bucket_kg) {}

  void add_pass(double before_kg, double after_kg);
  // The bucket holds so much of this soil.
  void plan_with(double full_bucket_kg) { full_bucket_ = full_bucket_kg; }
  double loaded_kg() const { return loaded_; }
  double target_kg() const { return target_; }
  int passes() const { return passes_; }
  double rest_kg() const { return aim_share * target_ - loaded_; }
  bool full() const { return full_with(0.0); }
  // Whether a bucket of this much makes the truck full.
  bool full_with(double kg) const { return loaded_ + kg >= full_share * target_ || rest_kg() - kg < worth_share * full_bucket_; }
  // The fewest passes that bring the rest; 0 when the truck is full.
  int passes_left() const;
  // What the next pass should bring: the rest in equal parts, so that the last is no handful.
  double next_goal_kg() const;
  // What may leave a bucket of this much over the truck: all, of which stays_kg stick in it and do not leave it, or a part where that would overload the truck.
  double allowed_kg(double kg, double stays_kg = 0.0) const;
  // Whether a bucket that holds at most so much may hold more than is allowed: it has to be weighed before it pours.
  bool must_weigh(double heaped_kg) const;

  // Shares of the target: what passes are planned up to; when it is full; what is kept back rather than loaded, as far below the target as a truck's
  // books may be wrong; and what a part of a bucket that holds more is poured up to: the middle of what the books are wrong by either way.
  static constexpr double aim_share = 0.990, full_share = 0.985, most_share = 0.993, part_share = 0.990;
  static constexpr double worth_share = 0.06;    // of a full bucket; a pass for less is not worth its time

private:
  double target_, full_bucket_;
  double loaded_ = 0.0;
  int passes_ = 0;
};

}  // namespace berm::app
