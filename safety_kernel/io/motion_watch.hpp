// Whether the machine moves as it was told, and its angles as its speeds say: feeds the readings and the commands under way to
// core/motion_supervision and core/joint_agreement, joint by joint.
#pragma once

#include <cstdint>

#include "config/parameter_block.h"
#include "core/joint_agreement.h"
#include "core/motion_supervision.h"
#include "io/motion_check.hpp"

namespace berm::kernel {

class MotionWatch {
 public:
  explicit MotionWatch(const berm_parameters& parameters);

  // The readings of this cycle are not fresh: what the joints do is not known.
  void lose();
  // BERM_STOP_NONE or the fault of this reading; NONE until angle and velocity have both come anew (angle_us, velocity_us: when they came).
  // box: of the commands under way; its reach chooses the row of the braking table.
  std::uint8_t check(const MotionQuery& query, const sk_reach_box& box, std::int64_t angle_us, std::int64_t velocity_us);

 private:
  std::uint8_t agree(const MotionQuery& query);
  std::int32_t row_of(const MotionQuery& query, const sk_reach_box& box) const;

  const berm_parameters& parameters_;
  const std::int64_t window_us_;
  std::int64_t heard_us_ = -1;                       // first of the readings without a gap
  std::int64_t angle_us_ = -1, velocity_us_ = -1;    // of the newest reading judged
  sk_motion_joint joint_[SK_JOINTS];
  sk_agreement agreement_[SK_JOINTS];
};

}  // namespace berm::kernel
