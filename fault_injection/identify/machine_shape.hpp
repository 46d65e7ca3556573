// How far the implements reach and how low they hang, from the machine file alone: its own forward kinematics of its prisms.
#pragma once

#include <array>

#include "config/machine_file.hpp"

namespace berm::identify {

using Joints = std::array<double, 4>;  // swing, boom, stick, bucket; rad, rad/s

enum JointIndex : std::size_t { swing = 0, boom = 1, stick = 2, bucket = 3 };

// Largest horizontal distance of any corner of the prisms from the swing axis, m.
double reach_m(const config::MachineFile& machine, const Joints& pose);
// Lowest corner of the prisms over the ground, m.
double lowest_m(const config::MachineFile& machine, const Joints& pose);
// Horizontal distance of the middle of a link's prisms (1 boom, 2 stick, 3 bucket) from the swing axis, m: a stand-in for its centre of mass.
double middle_m(const config::MachineFile& machine, const Joints& pose, int link);

}  // namespace berm::identify
