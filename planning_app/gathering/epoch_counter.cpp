#include "gathering/epoch_counter.hpp"

#include <algorithm>

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
    in_epoch_rad_ = back_rad_ = 0.0;
    return true;
  }
  if (direction_.isZero()) direction_ = turn.axis();
  const bool back = direction_.dot(turn.axis()) < 0.0;
  back_rad_ = back ? back_rad_ + turn_rad_ : std::max(0.0, back_rad_ - turn_rad_);
  in_epoch_rad_ += back ? -turn_rad_ : turn_rad_;
  if (!back) direction_ = turn.axis();
  if (back_rad_ > rule_.reversal_rad) {
    direction_ = turn.axis();
    in_epoch_rad_ = back_rad_;
    back_rad_ = 0.0;
    return true;
  }
  if (in_epoch_rad_ < kFullTurn) return false;
  in_epoch_rad_ -= kFullTurn;
  return true;
}

}  // namespace berm::app
