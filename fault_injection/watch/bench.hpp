// The site, the machine and the parked truck of the drawn intrusions.
#pragma once

#include <string>

#include "config/machine_file.hpp"
#include "config/site_file.hpp"
#include "plant/machine/plant_profile.hpp"
#include "plant/process/world_config.hpp"
#include "watch/intrusion.hpp"
#include "watch/loading_motion.hpp"

namespace berm::watch {

struct Bench {
  config::MachineFile machine;           // its workspace watched
  config::SiteFile site;
  plant::PlantProfile profile;
  plant::WorldConfig world;              // of the bench scenario: terrain, soil, a parked truck, the scanners with their noise
  LoadingPlace place;
  IntrusionSite intrusion_site;
};

// machine: name or file. histogram: the kernel compares with histograms, whatever the machine says. profiles: folder of the plant's profiles, where
// NAME_plant.toml goes with the machine NAME.
Bench make_bench(const std::string& machine, bool histogram, const std::string& profiles);

}  // namespace berm::watch
