// What the launcher itself needs of a scenario, a site and a trace: the names of the machine and site files, outlines for the picture, paths of
// people and vehicles. The plant reads and checks the whole scenario.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "config/output_file.hpp"
#include "run/site_picture.hpp"

namespace berm::run {

struct ScenarioNames { std::string machine, site; };

// Throws std::runtime_error with one line when the file is missing, is no TOML, or names no machine or site.
ScenarioNames scenario_names(const std::string& path);
// The scenario and the files that it names, the recording of a measured ground excepted, for a look at what must not be overwritten.
std::vector<config::NamedFile> files_of_scenario(const std::string& path);
// How many lidars on the upper body a machine file has: [[lidar]].
std::size_t lidar_count(const std::string& machine);
// Fills the arm, dig zones and bearings.
void describe_site(const std::string& machine, const std::string& site, SitePictureInput& picture);
// From the columns NAME_x_m and NAME_y_m of trace.csv; only what moved.
std::vector<MoverPath> mover_paths(const std::string& trace);

}  // namespace berm::run
