#include "gathering/epoch_counter.hpp"

namespace berm::app {

bool EpochCounter::begins_with(const Eigen::Matrix3d& orientation) {
  constexpr double kFullTurn = 6.283185307179586;
  if (!orientation_) {
    orientation_ = orientation;
    return true;
  }
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(orientation * orientation_->transpose()));
  orientation_ = orientation;
  turn_rad_ = turn.angle();
  if (turn_rad_ < rule_.still_rad) {
    direction_.setZero();
    in_epoch_rad_ = 0.0;
    return true;
  }
  const bool reversed = direction_.dot(turn.axis()) < 0.0;
  direction_ = turn.axis();
  in_epoch_rad_ += turn_rad_;
  if (!reversed && in_epoch_rad_ < kFullTurn) return false;
  in_epoch_rad_ = reversed ? turn_rad_ : in_epoch_rad_ - kFullTurn;
  return true;
}

}  // namespace berm::app
