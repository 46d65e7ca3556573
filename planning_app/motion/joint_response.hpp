// How a joint under closed-loop velocity control answers commands (stentz-1999, 4.4): after a dead time its speed follows the command as a first-order
// lag, within an acceleration and a deceleration limit. What the machine file promises of it, or what step responses showed.
#pragma once

#include "motion/machine_model.hpp"

namespace berm::app {

struct JointResponse {
  double dead_time = 0.1;      // from a command to its first effect, s
  double acceleration = 0.0;   // rad/s2, while it speeds up
  double velocity_max = 0.0;   // rad/s
  double lag = 0.0;            // time constant, s
  double stop_lag = 0.0;       // the same towards a zero command, at which a valve closes
  double deceleration = 0.0;   // rad/s2; 0: as while it speeds up
  double gain = 1.0;           // speed reached for one commanded
};

// Towards the left or up, and towards the right or down.
struct TwoWayResponse { JointResponse up, down; };

// The speed after a time in which the command that acts does not change, exactly.
double speed_after(const JointResponse& response, double speed, double command, double seconds);

// To commands that the machine is given, at a reach (m), with so much in the bucket: as identified, or where nothing is, as the machine file promises.
TwoWayResponse command_responses_of(const MachineModel& machine, std::size_t joint, double reach_m, double payload_kg);
// The same to requests, which the kernel makes commands of in its next cycle.
TwoWayResponse responses_of(const MachineModel& machine, std::size_t joint, double reach_m, double payload_kg);
// What the machine file promises of a joint, whatever was identified.
JointResponse promised_response(const MachineModel& machine, std::size_t joint);
// To requests, of a joint of which neither reach nor load is known: half of the heaviest payload at the middle of the reaches, up.
JointResponse response_of(const MachineModel& machine, std::size_t joint);

}  // namespace berm::app
