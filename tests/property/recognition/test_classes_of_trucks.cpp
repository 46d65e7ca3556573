// Drawn trucks through the recogniser: what it says of their walls' height and of their class.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "recognition/truck_recogniser.hpp"
#include "truck_world/scene.hpp"

namespace berm::truck_world {
namespace {

constexpr std::uint64_t kSeed = 60613;
constexpr int kScenes = 24;

struct Told {
  int found = 0, refused = 0, as_it_says = 0, half_round = 0;
};

// Trucks of one class, of a height that may be another than the recogniser knows.
Told told_of(const char* name, const Range& wall_height, const Range& floor_height) {
  std::vector<TruckClass> classes = read_truck_classes(BERM_TRUCK_CLASSES);
  std::erase_if(classes, [&](const TruckClass& c) { return c.name != name; });
  classes.front().wall_height = wall_height, classes.front().floor_height = floor_height;
  classes.front().volume_m3 = {1.0, 40.0}, classes.front().wall_top = {1.5, 4.0};
  const app::TruckRangeSet ranges = app::read_truck_ranges(BERM_TRUCK_RANGES);
  Told all;
  for (int k = 0; k < kScenes; ++k) {
    SceneOptions options;
    options.content = Content::truck;
    options.samples = 36000;
    const Scene scene = draw_scene(classes, options, kSeed, k);
    const Vector3d& v = scene.truth.viewpoint;
    const app::RecognisedTruck truck = app::recognise_truck(scene.cloud, {v.x(), v.y(), v.z()}, ranges);
    all.found += truck.found ? 1 : 0;
    all.refused += truck.reason.starts_with("its walls are ") && truck.reason.find("outside every class") != std::string::npos ? 1 : 0;
    all.as_it_says += truck.found && std::abs(truck.height - scene.truth.of_truck.wall_height) <= 3.0 * truck.height_deviation ? 1 : 0;
    all.half_round += truck.found && truck.truck_class == "half_round" ? 1 : 0;
  }
  std::cout << "seed " << kSeed << ", " << name << ": " << all.found << " of " << kScenes << " found, " << all.refused << " refused by their height, " << all.as_it_says
            << " as high as said, " << all.half_round << " half round\n";
  return all;
}

// Some low boxes over their wheels look as half pipes do (RECOGNITION.md).
TEST(ClassesOfTrucks, WallsLowerThanEveryClassAreRefusedOrTold) {
  const Told low = told_of("box", {0.60, 0.75}, {1.6, 2.0});
  EXPECT_GE(low.refused, kScenes / 2);
  EXPECT_LE(low.found - low.as_it_says, kScenes / 4);
}

TEST(ClassesOfTrucks, BoxesHigherThanEveryClassAreRefused) {
  const Told high = told_of("box", {1.95, 2.3}, {0.8, 1.1});
  EXPECT_GE(high.refused, kScenes - 3);
  EXPECT_LE(high.found - high.as_it_says, 1);
}

TEST(ClassesOfTrucks, AHalfRoundIsCalledSoAndABoxIsNot) {
  const Told pipes = told_of("half_round", {1.3, 1.8}, {1.05, 1.4}), boxes = told_of("box", {1.0, 1.75}, {1.15, 1.5});
  EXPECT_GE(pipes.found, kScenes - 3);
  EXPECT_GE(pipes.half_round, pipes.found - 2);
  EXPECT_GE(boxes.found, kScenes - 3);
  EXPECT_LE(boxes.half_round, 2);
  EXPECT_LE(boxes.refused + pipes.refused, 1);
}

}  // namespace
}  // namespace berm::truck_world
