// The ground of a site from a measured point cloud: [terrain.measured] of a scenario.
#pragma once

#include <string>

#include "plant/machine/strict_table.hpp"
#include "plant/process/world_config.hpp"

namespace berm::plant {

// Where a name of a recording is looked up: the folder that the environment's BERM_REAL_DATA names, or the one beside the project; an absolute
// path stays as it is.
std::string recording_path(const std::string& name);

// Takes the table, reads its file and resamples the surface at the centres of the terrain's cells, levelled where the scenario says so.
// terrain: extent and cell. Throws ConfigError.
MeasuredGround read_measured_ground(StrictTable table, const TerrainConfig& terrain);

}  // namespace berm::plant
