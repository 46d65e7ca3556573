#include "motion/braking_watch.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

namespace {

constexpr double least_peak = radians(5.0);   // rad/s: of a slow motion it says little
constexpr double slower = 0.95;               // of the speed: to less than that the joint is being slowed
constexpr double still = radians(0.5);        // rad/s
constexpr double known_s = 0.2;                // a goal set later may be the very reason of the slowing down
constexpr double least_way = radians(1.0);

}  // namespace

std::optional<Braking> BrakingWatch::judged(double angle, double velocity, std::optional<double> goal) {
  const double direction = braking_.positive ? 1.0 : -1.0, speed = direction * velocity;
  model_farthest_ = std::max(model_farthest_, direction * model_.angle());
  braking_.over_model = std::max(braking_.over_model, direction * angle - model_farthest_);
  if (goal_ && goal != goal_) goal_.reset();  // it is to go elsewhere now
  if (goal_) braking_.over_goal = std::max(braking_.over_goal, direction * (angle - *goal_));
  const bool faster_again = direction * model_.acting() > speed / slower + still;
  if (speed > still && !faster_again) return std::nullopt;
  slows_ = false;
  const double way = direction * (angle - from_);
  if (way > least_way) braking_.share = std::clamp((way - braking_.over_model) / way, 0.0, 1.0);
  return braking_;
}

std::optional<Braking> BrakingWatch::step(const TwoWayResponse& response, double commanded, double angle, double velocity, std::optional<double> goal) {
  goal_steps_ = goal == last_goal_ ? goal_steps_ + 1 : 0;
  last_goal_ = goal;
  std::optional<Braking> ended;
  if (slows_) ended = judged(angle, velocity, goal);
  if (!slows_) {
    model_.place(angle, velocity);
    const double direction = velocity < 0.0 ? -1.0 : 1.0;
    if (std::fabs(velocity) > least_peak && direction * model_.acting() < slower * std::fabs(velocity)) {
      slows_ = true;
      braking_ = {velocity > 0.0, std::fabs(velocity), 0.0, 0.0, 1.0};
      from_ = angle;
      model_farthest_ = direction * angle;
      const bool known_before = goal_steps_ * step_ > response.up.dead_time + known_s;
      goal_ = goal && known_before && direction * (*goal - angle) > 0.0 ? goal : std::nullopt;
    }
  }
  model_.respond(response);
  model_.advance(commanded);
  return ended;
}

}  // namespace berm::app
