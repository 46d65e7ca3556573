// Pouring while the kernel lets motions out slowly. Joints have the little speed that is permitted at once there, as none has at full speed: the swing, that
// lands or turns round slowly at full speed, is early for the arm and the bucket, which are timed by its angles.
#pragma once

#include "motion/arm_kinematics.hpp"

namespace berm::app {

// Of a load, the share that runs out of a bucket that opens on while the swing turns back by this angle (rad), of a machine all of whose joints keep to the
// same small share of their speeds.
double share_run_out_over(const MachineModel& machine, double way_back);

// The lip is not over the bed yet, and comes there: the bucket is not to open farther meanwhile. share_beside: of what would fall now (PourWatch).
bool lip_still_comes(double share_beside, const Joints& goals, const Joints& angle, const Joints& velocity);

}  // namespace berm::app
