// Reads the parts of a scenario that describe the world.
#pragma once

#include <string>

#include "plant/machine/strict_table.hpp"
#include "plant/process/world_config.hpp"

namespace berm::plant {

// Takes terrain, soil, truck, person, vehicle, box and scanner from the scenario's table. Throws ConfigError.
WorldConfig read_world(StrictTable& file);

// A soil of its own, fault_injection/soils: schema, name and the table soil of a scenario. Throws ConfigError.
SoilConfig load_soil(const std::string& file);

}  // namespace berm::plant
