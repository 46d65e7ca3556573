// The edge of a truck's opening in the base frame: which of it a sensor can see, and which of it a cloud shows.
#pragma once

#include <array>
#include <vector>

#include "truck_world/sweep.hpp"

namespace berm::truck_world {

struct EdgePoint {
  Vector3d at;
  Surface wall;
};

constexpr double edge_spacing = 0.05;   // m at most between points of the edge
constexpr double edge_reach = 0.10;     // m: a return as near shows a point of the edge
constexpr double hidden_of_wall_most = 0.5, open_end_seen = 0.5;  // share of a wall's edge; m of a side's end

// corners: as SceneTruth::corners. Without a rear wall three sides count. Points are spread evenly; each stands for the same length of a side.
std::vector<EdgePoint> edge_points(const std::array<Vector3d, 4>& corners, bool rear_wall);

// Whether what the tree holds keeps the sensor from seeing the point. What lies within 5 cm of it, the wall itself, does not.
bool hides(const BoundingTree& tree, const Sweep& sweep, const Vector3d& point);

// For each point whether tree hides it.
std::vector<bool> hidden_points(const BoundingTree& tree, const Sweep& sweep, const std::vector<EdgePoint>& edge);

// Whether the place of every end can be seen: of each wall at least half of the edge, and where the rear has none, the last half metre of one side's.
bool every_end_in_sight(const std::vector<EdgePoint>& edge, const std::vector<bool>& hidden);

// Share of true; 0 of none.
double share(const std::vector<bool>& flags);

// For each point whether no return of the cloud is within edge_reach.
std::vector<bool> points_without_return(const std::vector<app::ScanPoint>& cloud, const std::vector<EdgePoint>& edge);

}  // namespace berm::truck_world
