// What a triangle of a scene belongs to: the label of every point that a scanner sees of it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace berm::truck_world {

enum class Surface : std::uint8_t {
  ground,
  wall_front,   // the four walls of the bed, mud and all; front is the cab's end
  wall_rear,    // the tailgate, up
  wall_left,
  wall_right,
  bed_floor,
  load,         // soil in the bed
  truck_body,   // canopy, cab, chassis, wheels, a tailgate that hangs down
  look_alike,
  clutter,
  occluder,     // a heap or another machine's arm before the truck
  own_arm       // the excavator's own; its returns never reach the cloud
};
constexpr std::array<std::string_view, 12> surface_names{"ground", "wall_front", "wall_rear",  "wall_left", "wall_right", "bed_floor",
                                                         "load",   "truck_body", "look_alike", "clutter",   "occluder",   "own_arm"};
constexpr std::string_view name_of(Surface surface) { return surface_names[static_cast<std::size_t>(surface)]; }
// The load counts as the truck's.
constexpr bool is_truck(Surface surface) { return surface >= Surface::wall_front && surface <= Surface::truck_body; }

}  // namespace berm::truck_world
