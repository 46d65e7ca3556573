// Classes of trucks: the ranges that a truck's sizes are drawn from, and what is outside of all of them.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace berm::truck_world {

enum class BedShape { box, half_round };
enum class Tailgate { up, down, none };
const char* name_of(Tailgate tailgate);

// How often; they sum up to 1.
struct TailgateShares { double up = 1.0, down = 0.0, none = 0.0; };

using Range = std::array<double, 2>;  // low, high

// Metres; of the inside of the bed unless said otherwise. The keys of truck_classes.toml.
struct TruckClass {
  std::string name;
  BedShape bed = BedShape::box;
  bool tracks = false;
  Range volume_m3{};                    // level full
  Range inside_length{}, inside_width{}, wall_height{}, wall_thickness{};
  Range floor_height{}, wall_top{};     // over the ground
  TailgateShares tailgate;
  bool canopy = false;
  Range canopy_length{}, canopy_rise{};
  Range cab_gap{}, cab_length{}, cab_top{};
  Range mud{};                          // thickest mud on the walls
};

// Reads a file of classes. Throws config::ConfigError, one line with file, field and limit: a key that is missing, unknown, of the wrong type or out
// of range, no class, a name twice, ranges that leave no truck.
std::vector<TruckClass> read_truck_classes(const std::string& file);

// A box that some look-alike offers as a bed, inside, metres; length is the longer side.
struct OpenBox { double length = 0.0, width = 0.0, height = 0.0; };

constexpr double outside_margin = 0.3;  // m
// Whether length, width or height is outside each class's range by the margin or more.
bool outside_every_class(const std::vector<TruckClass>& classes, const OpenBox& box, double margin = outside_margin);

}  // namespace berm::truck_world
