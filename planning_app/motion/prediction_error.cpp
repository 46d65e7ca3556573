#include "motion/prediction_error.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

namespace {

constexpr int span_steps = 50;
constexpr double moved = radians(1.0);

}  // namespace

void PredictionError::step(const TwoWayResponse& response, double commanded, double angle, double velocity, bool free) {
  if (!free) steps_ = -1;
  if (steps_ == span_steps) {
    const double error = angle - model_.angle();
    if (std::fabs(angle - placed_angle_) > moved) {
      squares_ += error * error;
      largest_ = std::max(largest_, std::fabs(error));
      ++spans_;
    }
    steps_ = -1;
  }
  if (steps_ < 0) {
    model_.place(angle, velocity);
    placed_angle_ = angle;
    steps_ = 0;
  }
  model_.respond(response);
  model_.advance(commanded);
  ++steps_;
}

double PredictionError::root_mean_square() const { return spans_ == 0 ? 0.0 : std::sqrt(squares_ / spans_); }

}  // namespace berm::app
