// Reads the parts of a scenario that describe the world.
#pragma once

#include "plant/machine/strict_table.hpp"
#include "plant/process/world_config.hpp"

namespace berm::plant {

// Takes terrain, soil, truck, person, vehicle, box and scanner from the scenario's table. Throws ConfigError.
WorldConfig read_world(StrictTable& file);

}  // namespace berm::plant
