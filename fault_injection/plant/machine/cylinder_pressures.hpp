// What the cylinders' pressure sensors read: weight of the implements and the payload, and the soil's force on the cutting edge, each at its
// lever about the joint's pin. No dynamics, no friction.
#pragma once

#include <array>

#include "plant/machine/implement_shape.hpp"
#include "plant/machine/plant_profile.hpp"
#include "plant/world/world.hpp"

namespace berm::plant {

struct SidePressures { double bottom_kpa, rod_kpa; };

// Moments (N m) with which the cylinders hold boom, stick and bucket about their pins; positive in the sense of growing joint angles.
std::array<double, 3> holding_moments(const InertiaConfig& mass, const ImplementShape& shape, const JointState& joints, double payload_kg, const EdgeForce& edge);

// The boom's bottom side raises it; stick and bucket are crowded by the bottom side and opened by the rod side. The side that carries nothing
// keeps the return line's pressure, against which the other works too.
std::array<SidePressures, 3> cylinder_pressures(const DynamicsConfig& config, const ImplementShape& shape, const JointState& joints, double payload_kg, const EdgeForce& edge);

}  // namespace berm::plant
