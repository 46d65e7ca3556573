// At what share of its speed each joint follows its rule while others get less of theirs.
#pragma once

#include "motion/script.hpp"

namespace berm::app {

// shares: of the speeds that the joints would have, what they have. A rule that waited for the swing is timed by it (a lowering over the dig, a pouring over
// the bed): it is slowed with the swing, so that each swing angle finds the implements where the search for the script's parameters had them. The other rules
// go ahead, into safer poses.
Joints tempos_of(const Script& script, const Joints& shares);

}  // namespace berm::app
