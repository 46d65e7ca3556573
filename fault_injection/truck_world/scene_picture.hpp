// A scene as an SVG: its points from above and from the side, coloured by what they are of, with the truth drawn over them.
#pragma once

#include <string>

#include "truck_world/scene.hpp"

namespace berm::truck_world {

// Whole or not at all. Throws std::runtime_error naming the path.
void write_picture(const std::string& path, const Scene& scene);

}  // namespace berm::truck_world
