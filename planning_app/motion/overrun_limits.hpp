// What is learned from joints that overran: a joint that ran beyond its goal or its model by more than a figure is asked for lower speeds and for gentler
// landings, for the load with which it did; slowly unlearned by landings that kept to both.
#pragma once

#include <array>

#include "motion/arm_controller.hpp"
#include "motion/braking_watch.hpp"

namespace berm::app {

class OverrunLimits {
public:
  static constexpr double goal_figure = radians(2.0), model_figure = radians(1.5);

  static bool overran(const Braking& braking) { return braking.over_goal > goal_figure || braking.over_model > model_figure; }
  // True when the joint overran: its pace is now lower, if it was not the lowest.
  bool judge(std::size_t joint, bool loaded, const Braking& braking);
  const LearnedPaces& paces(bool loaded) const { return pace_[loaded]; }

private:
  std::array<LearnedPaces, 2> pace_;  // empty, loaded
};

}  // namespace berm::app
