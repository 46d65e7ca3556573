// One drawn intrusion: who comes, how fast, which way, when, and which version of MergeCell the monitor runs. Base frame, metres, seconds, radians.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "plant/process/world_config.hpp"

namespace berm::watch {

enum class Way { dig_face, truck_side, towards, crossing };
enum class Who { adult, child, vehicle };
enum class When { learned, learning };  // somebody appears when the ground is learned, or while its heights still are
constexpr std::array<Way, 4> ways{Way::dig_face, Way::truck_side, Way::towards, Way::crossing};
constexpr std::array<Who, 3> whos{Who::adult, Who::child, Who::vehicle};
const char* name_of(Way way);
const char* name_of(Who who);

// What a way must go round, and where it may begin.
struct IntrusionSite {
  plant::TruckConfig truck;                  // where it stands parked
  std::array<double, 2> extent{};            // x and y of the terrain: from -extent to extent
  double crest_x = 0.0;                      // of the dig face
  double half_face = 0.0;                    // half the width of the dig face
  double region_radius = 0.0;
  double implements_reach = 0.0;             // from the swing axis
  double own_radius = 0.0;                   // nearer the swing axis is the machine itself
  double swing_low = 0.0, swing_high = 0.0;  // bearings between which the machine swings
};

struct Intrusion {
  std::uint64_t seed = 1;
  int run = 0;
  Way way = Way::towards;
  Who who = Who::adult;
  bool running = false;
  bool follows = true;                       // continuous MergeCell (Figure 7); else Figure 8
  double side_gap_m = 0.0;                   // along the truck: between the truck's side and the person's surface
  When when = When::learned;
  double waits_s = 0.0;                      // until it appears, from when the ground is learned or, while it is, from the start
  plant::MoverConfig mover;                  // appears_s and start_s are the trial's to set
};

// The rectangle of a parked truck with its cab, from above: the distance from a point, m, 0 within it.
double distance_from_truck(const plant::TruckConfig& truck, double x, double y);

// The same seed and run give the same intrusion; only when it begins goes by `when`.
Intrusion draw_intrusion(std::uint64_t seed, int run, const IntrusionSite& site, When when = When::learned);

// How long it is on its way, s.
double way_time(const plant::MoverConfig& mover);
// What a person needs to see the trial before him, one line.
std::string describe(const Intrusion& intrusion);

}  // namespace berm::watch
