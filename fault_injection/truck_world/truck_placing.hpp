// A truck where the site allows one: its body, its pose, its load, and the sweep that sees it. Base frame, metres, radians.
#pragma once

#include <cstdint>

#include "truck_world/bed_load.hpp"
#include "truck_world/ground_plan.hpp"
#include "truck_world/opening_edge.hpp"
#include "truck_world/scene.hpp"
#include "truck_world/site_ground.hpp"

namespace berm::truck_world {

constexpr double place_near = 5.0, place_far = 8.5;      // of the middle of the bed from the swing axis
constexpr double drop_most = 3.0;
constexpr double machine_clear = 3.4;                     // between the swing axis and anything that stands: tail radius and half a metre
constexpr double look_down_least = 0.5;                   // of the sensor over the highest corner
constexpr double own_hidden_most = 0.02;                  // share of the edge that the truck itself may hide
constexpr double tilt_most = 0.06;                        // roll or pitch, 3.4 degrees

// Where something is to stand, and the ground under it.
struct SitePlace {
  Vector2d at = Vector2d::Zero();
  double yaw = 0.0, drop = 0.0;
  Vector2d gradient = Vector2d::Zero();
};
SitePlace draw_place(Random& random);

// The ground with a bench whose face ends before what stands there.
SiteGround ground_before(const SitePlace& place, const GroundRectangle& standing, double roughness);

struct PlacedTruck {
  std::size_t truck_class = 0;
  TruckBody body;
  BedLoad load;
  SitePlace place;
  SiteGround ground;
  GroundRectangle standing;        // body and cab
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  // of the truck frame
  double pitch = 0.0, roll = 0.0;
  Sweep sweep;
  Mesh mesh;
  std::array<Vector3d, 4> corners{};
  std::vector<EdgePoint> edge;
  std::vector<bool> hidden;        // of edge, by the truck itself
};

// Draws until the truck keeps clear of the machine, lies within the sensor's sector, and shows its opening. Throws std::runtime_error when none does.
PlacedTruck place_truck(const std::vector<TruckClass>& classes, const SceneOptions& options, std::uint64_t seed, int number);

}  // namespace berm::truck_world
