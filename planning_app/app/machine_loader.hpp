// Machine and site files into the app's models.
#pragma once

#include "config/machine_file.hpp"
#include "config/site_file.hpp"
#include "motion/machine_model.hpp"
#include "planning/site_model.hpp"

namespace berm::app {

MachineModel machine_model(const config::MachineFile& file);
SiteModel site_model(const config::SiteFile& file);

}  // namespace berm::app
