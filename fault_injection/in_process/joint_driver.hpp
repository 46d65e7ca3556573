// Drives the joints to a pose as the simplified planner of leger-1998 section 2.5 did. Knows the machine file and what the kernel publishes.
#pragma once

#include <array>

#include "config/machine_file.hpp"
#include "contract/berm_contract.h"

namespace berm::in_process {

class JointDriver {
 public:
  // reach_m: the farthest that the implements come in the motion; the deceleration that is counted on goes by it. machine must outlive this.
  JointDriver(const config::MachineFile& machine, double reach_m);

  // The speed to ask for, rad/s, on the way to an angle (rad) at no more than limit (rad/s). Once a cycle for each joint.
  double speed(std::size_t joint, double goal, double limit, const berm_state& state);
  // Whether the joints stand at the pose.
  static bool arrived(const std::array<double, 4>& goal, const berm_state& state);
  // Half of its largest speed: what a joint of the arm is moved with.
  double arm_limit(std::size_t joint) const;

 private:
  const config::MachineFile& machine_;
  std::array<double, 4> deceleration_{};  // rad/s2
  std::array<double, 4> asked_{};         // rad/s
};

// The joint speeds of all four joints, rad/s, into a request, within what the machine file permits.
void put_speeds(const std::array<double, 4>& speed, const config::MachineFile& machine, berm_request& request);
// Magic, version, sequence, time stamp, CRC: the rest must be filled in.
void seal(berm_request& request, std::uint32_t sequence, const berm_state& state);

}  // namespace berm::in_process
