// A scene as files for others.
#pragma once

#include <string>

#include "truck_world/scene.hpp"

namespace berm::truck_world {

// "scene_000012" for scene 12.
std::string scene_name(int number);

// Writes FOLDER/scene_NNNNNN.pcd, .labels.csv and, last, .json; with a picture, .svg before it. Each file is whole or absent; when one cannot be
// written those of the scene are removed again, and a std::runtime_error names it. .labels.csv: a line of names, then for each point of the cloud,
// in its order, the label (a surface's name, or outlier) and the sample of the sweep.
void write_scene(const std::string& folder, const Scene& scene, bool picture);

}  // namespace berm::truck_world
