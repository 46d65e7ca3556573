// How well a joint's model foretells it: every half second the model is put where the joint is, moved by the commands that the machine is then given,
// and compared with where the joint has come to.
#pragma once

#include "motion/joint_model.hpp"

namespace berm::app {

class PredictionError {
public:
  explicit PredictionError(const TwoWayResponse& response, double step_s) : model_(response, step_s) {}

  // Once a cycle: how the joint answers, what the machine was told, where the joint is; free: nothing but the machine moves it or holds it up.
  void step(const TwoWayResponse& response, double commanded, double angle, double velocity, bool free);

  double root_mean_square() const;  // rad, of the half seconds in which it moved
  double largest() const { return largest_; }

private:
  JointModel model_;
  double placed_angle_ = 0.0;
  int steps_ = -1;                  // since it was placed; -1: it is to be
  double squares_ = 0.0, largest_ = 0.0;
  int spans_ = 0;
};

}  // namespace berm::app
