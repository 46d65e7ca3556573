// Things of a site that are no truck: clutter round the loading place, and look-alikes that stand where a truck would.
// Own frame: origin on the ground in the middle, long side along x, z up. Metres.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "truck_world/mesh.hpp"
#include "truck_world/random_streams.hpp"
#include "truck_world/truck_class.hpp"

namespace berm::truck_world {

struct Thing {
  std::string name;
  Mesh mesh;
  Vector2d half = Vector2d::Zero();  // half length and half width of the rectangle that it stands on
};

constexpr std::array<std::string_view, 7> clutter_names{"berm", "heap", "loader", "container", "pickup", "person", "wall"};
// kind: place in clutter_names.
Thing draw_clutter(std::size_t kind, Random& random);

enum class LookAlike { long_container, skip, trench_box, building_pit, loader_bucket, hollow_pile, flat_bed, box_trailer };
constexpr std::array<std::string_view, 8> look_alike_names{"long_container", "skip",        "trench_box", "building_pit",
                                                           "loader_bucket",  "hollow_pile", "flat_bed",   "box_trailer"};
constexpr std::string_view name_of(LookAlike kind) { return look_alike_names[static_cast<std::size_t>(kind)]; }

// Why it is no truck; a look-alike has at least one of these.
struct NoTruck {
  bool outside_sizes = false;  // its box is outside every class by outside_margin
  bool wall_missing = false, floor_missing = false, roofed = false;
};

struct DrawnLookAlike {
  LookAlike kind = LookAlike::skip;
  Thing thing;
  OpenBox box;                        // inside; what it would measure as a bed
  NoTruck because;
  Vector2d hole = Vector2d::Zero();   // half length and half width of the ground that it takes the place of; 0: none
};
// Throws std::runtime_error when the classes leave no sizes outside of them that this kind can have.
DrawnLookAlike draw_look_alike(LookAlike kind, const std::vector<TruckClass>& classes, Random& random);

}  // namespace berm::truck_world
