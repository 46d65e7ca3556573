// Passes of any yield: the goals sum to the target, no pass is planned for less than half a bucket of them, and no truck is loaded beyond its limit.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "planning/truck_fill.hpp"

namespace {

using berm::app::TruckFill;

constexpr double full_bucket = 1560.0, heaped = 1608.0;

double drawn(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 100001) * 1e-5; }

// A truck that takes from two to twenty buckets.
double drawn_target() { return drawn(2.0 * full_bucket, 20.0 * full_bucket); }

RC_GTEST_PROP(TruckFill, GoalsThatAreMetSumToTheTarget, ()) {
  const double target = drawn_target();
  TruckFill fill(target, full_bucket);
  const int planned = fill.passes_left();
  while (!fill.full()) {
    const double goal = fill.next_goal_kg();
    RC_ASSERT(goal <= full_bucket + 1e-6);
    RC_ASSERT(goal >= 0.5 * full_bucket);  // the rest of two buckets at least in equal parts
    RC_ASSERT(!fill.must_weigh(heaped) || fill.allowed_kg(goal) >= goal - 1e-6);
    fill.add_pass(goal, 0.0);
    RC_ASSERT(fill.passes() <= planned);
  }
  RC_ASSERT(fill.passes() == planned);
  RC_ASSERT(std::abs(fill.loaded_kg() - TruckFill::aim_share * target) < 1e-6);
}

// Buckets come with anything from a fifth of the goal to all that they hold; what is not weighed goes as it is.
RC_GTEST_PROP(TruckFill, WhateverTheBucketsBringEveryTruckEndsWithinItsLimits, ()) {
  const double target = drawn_target();
  TruckFill fill(target, full_bucket);
  while (!fill.full() && fill.passes() < 200) {
    const double goal = fill.next_goal_kg();
    const double brought = drawn(0.2 * goal, heaped);
    const double goes = fill.must_weigh(heaped) ? fill.allowed_kg(brought) : brought;
    RC_ASSERT(goes >= 0.0 && goes <= brought);
    fill.add_pass(goes, 0.0);
  }
  RC_ASSERT(fill.full());
  RC_ASSERT(fill.loaded_kg() <= TruckFill::most_share * target + 1e-6);
  RC_ASSERT(fill.loaded_kg() >= std::min(TruckFill::full_share * target, TruckFill::aim_share * target - TruckFill::worth_share * full_bucket));
}

}  // namespace
