// What berm_truck_world was asked to do.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "truck_world/scene.hpp"

namespace berm::truck_world {

struct ProgramOptions {
  int scenes = 0;
  std::uint64_t seed = 1;
  int only = -1;                // of the scenes; -1: all
  std::string out, classes;     // folder; file
  bool picture = false;
  SceneOptions scene;
};

// Reads the command line; the exit status when the program should end now. classes: the file that is taken unless another is named.
std::optional<int> read_options(int argc, char** argv, const std::string& classes, ProgramOptions& options);

}  // namespace berm::truck_world
