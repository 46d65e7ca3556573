// Trucks on sloping ground, from the sweep that sees one to the bed that is loaded: it is the truth's, with its tilt.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/recognised_bed.hpp"
#include "truck_world/scene.hpp"
#include "truck_world/trial.hpp"

namespace {

using namespace berm;

TEST(TiltedTruck, TheBedToLoadTiltsAsTheTruckDoes) {
  const app::TruckRangeSet ranges = app::read_truck_ranges(BERM_TRUCK_RANGES);
  const auto classes = truck_world::read_truck_classes(BERM_TRUCK_CLASSES);
  truck_world::SceneOptions options;
  options.samples = 72000;
  options.content = truck_world::Content::truck;
  int tilted = 0;
  for (int number = 0; tilted < 6; ++number) {
    ASSERT_LT(number, 60);
    const truck_world::Scene scene = truck_world::draw_scene(classes, options, 2718, number);
    const truck_world::TruckTruth& truth = scene.truth.of_truck;
    if (std::max(std::abs(truth.pitch), std::abs(truth.roll)) < 0.035) continue;
    const app::RecognisedTruck truck = app::recognise_truck(scene.cloud, truck_world::viewpoint_of(scene), ranges);
    if (!truck_world::judge(scene, truck).recognised) continue;
    ++tilted;
    const app::TruckBed bed = app::recognised_bed(truck);
    double highest = -1e9, lowest = 1e9;
    for (const Eigen::Vector3d& corner : truth.corners) {
      const double x = corner.x() - bed.centre_x, y = corner.y() - bed.centre_y, c = std::cos(bed.yaw), s = std::sin(bed.yaw);
      EXPECT_NEAR(bed.top_at(x * c + y * s, -x * s + y * c), corner.z(), 0.04) << number;
      highest = std::max(highest, corner.z()), lowest = std::min(lowest, corner.z());
    }
    EXPECT_NEAR(bed.wall_top, highest, 0.04) << number;
    EXPECT_GT(highest - lowest, 0.07) << "it tilts";
    EXPECT_NEAR(bed.height, truth.wall_height, 0.1);
  }
}

}  // namespace
