// What is true of a scene, for whoever judges a recogniser by it. Base frame, metres, radians.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "truck_world/mesh.hpp"
#include "truck_world/sweep.hpp"
#include "truck_world/thing.hpp"

namespace berm::truck_world {

// The truck of a scene; all zero in a scene without one.
struct TruckTruth {
  std::string truck_class;
  // On the inner top edge of the walls, in order round the opening, counter-clockwise from above: front left, rear left, rear right, front right as
  // seen from the bed towards the cab.
  std::array<Vector3d, 4> corners{};
  double yaw = 0.0, pitch = 0.0, roll = 0.0;            // of the bed; yaw of its long axis, towards the cab
  double inside_length = 0.0, inside_width = 0.0, wall_height = 0.0, wall_thickness = 0.0, floor_height = 0.0;
  double struck_m3 = 0.0;                               // level full
  std::string tailgate, fill;                           // up, down, none; empty, part, heaped, uneven
  double fill_m3 = 0.0;
  bool canopy = false;
  double mud = 0.0;                                     // thickest on the walls
  // Of the edge: without a rear wall, of three sides.
  double hidden_share = 0.0;      // no return within 10 cm: what hides it, the scan's own gaps, dropouts
  double occluded_share = 0.0;    // no line of sight from the sensor
  double occluded_drawn = 0.0;    // what an occluder was to make of occluded_share; 0 without one
  std::string occluder;           // "", own_arm, foreign_arm, heap
  std::string wall_hidden;        // "", or the wall that the occluder hides whole: wall_front, wall_rear
  std::int64_t returns = 0;       // of the cloud that are of it, its load included; no outliers
  std::int64_t bed_returns = 0;   // of these, on walls, floor and load
};

struct SceneTruth {
  std::uint64_t seed = 0;
  int scene = 0;
  bool truck = false;
  TruckTruth of_truck;
  std::string look_alike;         // "" in a scene with a truck, or with nothing like one
  OpenBox look_alike_box{};       // inside
  NoTruck no_truck{};             // why the look-alike is none
  std::vector<std::string> clutter;
  Vector2d place = Vector2d::Zero();  // middle of the bed, or of what stands for it, on the ground
  double drop = 0.0;              // of the ground there under the excavator's, before its slope
  Sensor sensor = Sensor::left_scanner;
  Vector3d viewpoint = Vector3d::Zero();  // of the sensor in the middle of the sweep
  double swing_begin = 0.0, swing_rate = 0.0;
  double time_begin = 0.0, duration = 0.0;
  int samples = 0;
  std::int64_t returns = 0, outliers = 0;
};

// Every member by its name; corners as arrays [x, y, z]; "truck" is null without a truck, "look_alike" without a look-alike.
nlohmann::ordered_json json_of(const SceneTruth& truth);

}  // namespace berm::truck_world
