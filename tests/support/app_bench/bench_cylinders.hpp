// The pressures in the miniature machine's cylinders: what holds its implements, what the bucket carries, and the soil's push on the tip.
#pragma once

#include "motion/soil_force.hpp"

namespace berm::app_bench {

// N, of the soil on a tip that moves from one pose to the next and meanwhile takes so much: against its way.
app::PlaneForce soil_push(const app::MachineModel& machine, const app::Joints& before, const app::Joints& now, double taken_kg);

app::CylinderPressures pressures(const app::MachineModel& machine, const app::Joints& angle, double load_kg, const app::PlaneForce& soil);

}  // namespace berm::app_bench
