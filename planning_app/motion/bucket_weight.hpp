// What hangs in the bucket, from the cylinders' pressures: known in every cycle, as soon as the bucket is out of the soil, where the on-board weighing is still
// blind.
#pragma once

#include "motion/arm_kinematics.hpp"
#include "motion/implement_weight.hpp"

namespace berm::app {

// kg beyond the empty implements; nothing but weight may act on the bucket, and it moves gently. Negative when the boom stands too steep to tell.
double weight_in_bucket(const MachineModel& machine, const Joints& angle, const Moments& held, const Moments& empty);

// What is held besides so much in the bucket, as if that lay halfway to the tip: where it lies, only the bucket's own pin can tell.
Moments without_load(const MachineModel& machine, const Joints& angle, const Moments& held, double kg);

}  // namespace berm::app
