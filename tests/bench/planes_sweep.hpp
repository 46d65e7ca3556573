// One drawn sweep as the parties of the plane benchmark are given it, and the faces of the bed's walls that it shows.
#pragma once

#include <vector>

#include "planes_found.hpp"
#include "truck_world/scene.hpp"

namespace berm::bench {

constexpr int kUsualSamples = 36000;  // of a sweep

struct SweepPoints {
  const truck_world::Scene* scene = nullptr;
  std::vector<Eigen::Vector3d> points;  // within 30 m, as far as the recogniser looks
  std::vector<std::uint32_t> samples;   // of each: its place in the sweep
  double density = 1.0;                 // samples of the sweep over kUsualSamples
};
SweepPoints sweep_points(const truck_world::Scene& scene);

// The inner or outer face of a wall. Upright and straight walls alone: not the curved side of a half pipe.
struct WallFace {
  truck_world::Surface wall = truck_world::Surface::wall_front;
  bool outer = false;
  Eigen::Vector3d normal;  // of the wall
  Eigen::Vector3d middle;  // mean of what the sweep's rays hit of it, without their noise: with the mud that lies there
  Eigen::Vector3d bare;    // below the mud
  int returns = 0;
};

// Those with 50 returns or more in a sweep of the usual samples, and as many times more in a denser one.
std::vector<WallFace> faces_seen(const truck_world::Scene& scene, const std::vector<truck_world::TruckClass>& classes);

struct FaceError {
  bool matched = false;
  double angle = 0.0, offset = 0.0;  // rad; m at the face's middle
  double bare_offset = 0.0;          // m, from the wall below its mud
};
constexpr double kAngleGate = 5.0 * truck_world::pi / 180.0, kOffsetGate = 0.05, kBoxGate = 0.5;

// The plane nearest to the face among those within both gates whose box, kBoxGate larger, holds the face's middle.
FaceError match(const WallFace& face, const std::vector<FoundPlane>& planes);

}  // namespace berm::bench
