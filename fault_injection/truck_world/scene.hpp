// A scene of the truck world: drawn from (seed, number), cast as one sweep, with its truth.
#pragma once

#include <cstdint>
#include <vector>

#include "truck_world/scene_truth.hpp"

namespace berm::truck_world {

enum class Content { either, truck, no_truck };  // either: each in half of the scenes

struct SceneOptions {
  Content content = Content::either;
  bool lidar = false;
  int samples = 36000;            // of the sweep
  double swinging_share = 0.3;    // of the scenes: the machine swings during the sweep
  double hidden_max = 0.30;       // share of the opening's edge that an occluder may hide; 0: no occluders
  double end_hidden_share = 0.0;  // of the scenes with a truck: the occluder hides an end wall whole, where the place allows it
  RangeNoise noise;
};

struct Scene {
  SceneTruth truth;
  Sweep sweep;
  Mesh mesh;
  std::vector<app::ScanPoint> cloud;
  std::vector<PointTruth> point_truth;  // of the points of cloud, one by one
};

// The same arguments give the same scene, bit for bit; noise and hidden_max change nothing else. Throws std::runtime_error when the classes leave
// nothing to draw that fits the site.
Scene draw_scene(const std::vector<TruckClass>& classes, const SceneOptions& options, std::uint64_t seed, int number);

}  // namespace berm::truck_world
