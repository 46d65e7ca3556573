// Where the raised implements point while the machine is moved.
#pragma once

#include "motion/machine_model.hpp"

namespace berm::app {

// A swing angle within 3 degrees of the middle. After a move the kernel has seen nothing, and lets nothing run until it has seen each cell that lies under the
// standing implements. A cell whose edge their side touches does so in one cycle and not in the next, by the noise of the swing angle; one that does so just
// after the machine was switched to run, and was not seen yet, is a stop. So of those angles the one at which the sides of boom, stick and bucket keep
// farthest from the edges, from the machine's own body out to the tip. pose: of the raised implements; cell: of the kernel's map, whose edges are multiples of it, m.
double move_bearing(const MachineModel& machine, const Joints& pose, double middle, double cell);

}  // namespace berm::app
