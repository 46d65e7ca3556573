// Faults of the machine's stand: at a time the base tilts, slips or turns.
#pragma once

#include <optional>
#include <vector>

#include "plant/machine/strict_table.hpp"
#include "plant/world/base_pose.hpp"

namespace berm::plant {

struct BaseMotionConfig {
  double at_s = 0.0, over_s = 0.0;            // begins, lasts
  std::optional<double> start_swing_above;    // begins when the swing first exceeds this at or after at_s
  BasePose by;                                // added evenly over that time
};

std::vector<BaseMotionConfig> read_base_motions(StrictTable& file);

class BaseMotion {
 public:
  explicit BaseMotion(const std::vector<BaseMotionConfig>& config);
  // From the cycle before to t.
  void step(double t, double swing);
  const BasePose& pose() const { return pose_; }
  bool moving() const { return moving_; }  // in the newest step

 private:
  struct Motion { BaseMotionConfig config; double began_s = -1.0; };
  std::vector<Motion> motion_;
  BasePose pose_;
  bool moving_ = false;
};

}  // namespace berm::plant
