// Something between the sensor and a truck that hides part of the opening's edge, as large as the share asked for needs.
#pragma once

#include <optional>
#include <string>

#include "truck_world/opening_edge.hpp"
#include "truck_world/site_ground.hpp"

namespace berm::truck_world {

enum class OccluderKind { own_arm, foreign_arm, heap };
constexpr std::array<std::string_view, 3> occluder_names{"own_arm", "foreign_arm", "heap"};
constexpr std::string_view name_of(OccluderKind kind) { return occluder_names[static_cast<std::size_t>(kind)]; }

struct Occluder {
  OccluderKind kind = OccluderKind::own_arm;
  Mesh mesh;
  Vector2d place = Vector2d::Zero();
  double radius = 0.0;               // of the ground that it stands on
  double share = 0.0;                // of the edge that is hidden with it
};

// What it is to hide part of.
struct OcclusionTask {
  const Sweep& sweep;
  const SiteGround& ground;
  const std::vector<EdgePoint>& edge;
  const std::vector<bool>& hidden;        // of the edge, by the truck itself
  const std::vector<Vector2d>& outline;   // points round the truck, as dense as a hand's breadth
};

constexpr double occlusion_tolerance = 0.015;  // of the edge

// So that share of the edge is hidden, within occlusion_tolerance. None when nothing of a plausible size at the places tried does it.
std::optional<Occluder> draw_occluder(const OcclusionTask& task, double share, Random& random);

// So that all the points of a wall, its edge too, are hidden, and at most share_max of the whole edge.
std::optional<Occluder> draw_wall_occluder(const OcclusionTask& task, const std::vector<Vector3d>& wall, double share_max, Random& random);

}  // namespace berm::truck_world
