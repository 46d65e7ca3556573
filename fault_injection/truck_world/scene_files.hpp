// A scene as files for others.
#pragma once

#include <cstdint>
#include <string>

#include "truck_world/scene.hpp"

namespace berm::truck_world {

// "scene_000012" for scene 12.
std::string scene_name(int number);

// Writes FOLDER/scene_NNNNNN.pcd, .labels.csv and, last, .json; with a picture, .svg before it. Each file is whole or absent; when one cannot be
// written the folder stays as it was, and a std::runtime_error names it. .labels.csv: a line of names, then for each point of the cloud,
// in its order, the label (a surface's name, or outlier) and the sample of the sweep.
void write_scene(const std::string& folder, const Scene& scene, bool picture);

// Why a run may not write its scenes there: it would mix with an earlier one's. adds: one scene more, of the same seed. Empty for none.
std::string of_another_run(const std::string& folder, std::uint64_t seed, bool adds);

}  // namespace berm::truck_world
