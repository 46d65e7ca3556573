// Watches a joint slow down: how far it runs beyond what its model does with the same commands, and beyond its goal (stentz-1999, 5: a full bucket's swing,
// a boom that is lowered under load).
#pragma once

#include <optional>

#include "motion/joint_model.hpp"

namespace berm::app {

// One slowing down, from its beginning to standstill or until the joint speeds up again.
struct Braking {
  bool positive = true;                      // the motion's direction
  double peak = 0.0;                         // speed at its beginning, rad/s
  double over_model = 0.0, over_goal = 0.0;  // rad, at most; of a goal that was known well before, not one that was set nearer than it can stop
  double share = 1.0;                        // of the way that it took, what the model would have needed; at most 1
};

class BrakingWatch {
public:
  explicit BrakingWatch(const TwoWayResponse& response, double step_s) : model_(response, step_s), step_(step_s) {}

  // Once a cycle: how the joint answers, what the machine was told, where the joint is, and where it is to come to. A slowing down that has ended.
  std::optional<Braking> step(const TwoWayResponse& response, double commanded, double angle, double velocity, std::optional<double> goal);
  bool slows() const { return slows_; }
  // What moves the joint now is not what the machine was told.
  void forget() { slows_ = false; }

private:
  std::optional<Braking> judged(double angle, double velocity, std::optional<double> goal);

  JointModel model_;
  bool slows_ = false;
  Braking braking_;
  double from_ = 0.0;
  double model_farthest_ = 0.0;              // in the direction: told to come back, the model does so before a joint that still runs
  std::optional<double> goal_, last_goal_;   // of this slowing down; of the cycle before
  int goal_steps_ = 0;                       // for which the goal has been the same
  double step_;
};

}  // namespace berm::app
