// Which tests are run in which poses, from the machine file alone.
#pragma once

#include <vector>

#include "identify/driver.hpp"

namespace berm::identify {

// One joint in one pose of the others, and where it may move.
struct Station {
  std::size_t joint = 0;
  std::size_t row = 0;        // of the braking table; the last for boom, stick and bucket, whose tests count for every row
  Joints pose{};
  JointSpan span{};
  double reach_m = 0.0;       // of the pose; for a boom, stick or bucket the largest over the span
};

// Swing: for each row of the table that any pose reaches, the poses just within its reach that hold stick and bucket farthest out, by several
// weightings of the two, for the masses are not known. Boom, stick and bucket: stretched and tucked in. Every pose keeps the prisms of the machine
// file above the ground. Throws std::runtime_error when a joint has no room.
std::vector<Station> stations(const config::MachineFile& machine, const std::vector<std::size_t>& joints);

}  // namespace berm::identify
