// Scenes for the tests of the truck world.
#pragma once

#include <vector>

#include "truck_world/bounding_tree.hpp"
#include "truck_world/scene.hpp"

namespace berm::truck_world {

inline std::vector<TruckClass> shipped_classes() { return read_truck_classes(BERM_TRUCK_CLASSES); }

// Sweeps as coarse as the head allows: quick, where the points do not matter.
inline SceneOptions coarse(Content content) {
  SceneOptions options;
  options.content = content;
  options.samples = 9200;
  return options;
}

inline Mesh part_of(const Scene& scene, bool (*takes)(Surface)) {
  Mesh part;
  for (const Triangle& t : scene.mesh)
    if (takes(t.surface)) part.push_back(t);
  return part;
}

}  // namespace berm::truck_world
