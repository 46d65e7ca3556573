// When a scanner's epoch ends (zolynski-2012, 2.7): on reversal, at standstill; and, not in the paper, after a full turn.
#pragma once

#include <Eigen/Geometry>
#include <optional>

namespace berm::app {

struct EpochRule {
  double still_rad = 5e-4;     // turns less than this from scan to scan are standstill
  double reversal_rad = 2e-3;  // turned back so far is a reversal, less is the encoder's unrest
};

class EpochCounter {
public:
  explicit EpochCounter(const EpochRule& rule) : rule_(rule) {}

  // Takes the orientation at the next scan; whether a new epoch begins with it. True for the first scan.
  bool begins_with(const Eigen::Matrix3d& orientation);
  double last_turn_rad() const { return turn_rad_; }  // from the scan before

private:
  EpochRule rule_;
  std::optional<Eigen::Matrix3d> orientation_;
  Eigen::Vector3d direction_ = Eigen::Vector3d::Zero();  // of the epoch's turn; none after standstill
  double turn_rad_ = 0.0;
  double in_epoch_rad_ = 0.0;
  double back_rad_ = 0.0;  // turned back against direction_
};

}  // namespace berm::app
