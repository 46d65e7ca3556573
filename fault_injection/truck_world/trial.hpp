// Trials of the truck recogniser: drawn scenes, each judged by its truth.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "recognition/truck_recogniser.hpp"
#include "truck_world/scene.hpp"

namespace berm::truck_world {

constexpr double kCornerGate = 0.30;  // m: a truck whose corners are farther off counts as not recognised

// One scene. Errors only where a truck was found in a scene with one.
struct Trial {
  int scene = 0;
  bool truck = false, found = false;
  bool recognised = false;        // a truck was found where it stands: every corner within kCornerGate, and the cab on the right end
  std::string truck_class, tailgate, fill, wall_hidden, look_alike, reason;
  double hidden_share = 0.0, occluded_share = 0.0;  // SceneTruth
  std::array<double, 4> corner_errors{};  // m
  double yaw_error = 0.0;         // rad
  double length_error = 0.0, width_error = 0.0, height_error = 0.0;  // m
  double height_deviation = 0.0;  // m, the recogniser's own
  std::array<double, 8> error{}, deviation{};  // of middle x y z (m), yaw, pitch, roll (rad), length, width (m); the recogniser's own
  double nees = 0.0;              // of the eight parameters of the opening by the recogniser's own covariance
  double milliseconds = 0.0;
  app::BedEvidence evidence;
  double cab = 0.0;               // evidence of the cab
  double true_score = 0.0, true_cab = 0.0;  // what bed and cab weigh where the truck truly stands
  app::BedPose pose;
  app::LevelPlanes planes;        // floor and canopy as they were matched
  std::string told_class;         // the recogniser's
  double true_height = 0.0;       // m, of the walls
};

// Of the sensor in the middle of the sweep, as a file of the scene has it.
std::array<double, 3> viewpoint_of(const Scene& scene);

Trial judge(const Scene& scene, const app::RecognisedTruck& answer);

// A row for each trial, with a line of names.
std::string table(const std::vector<Trial>& trials);

// Counts and percentiles; "by_class" has the same for each class of trucks, kind of tailgate and of load.
nlohmann::ordered_json summary(const std::vector<Trial>& trials);

}  // namespace berm::truck_world
