// Which level plane is a bed's floor and which its canopy: each rule by a bed that keeps it and one that just does not.
#include "recognition/level_planes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drawn_bed.hpp"
#include "recognition/bed_ground.hpp"
#include "recognition/truck_recogniser.hpp"
#include "recognition/upright_regions.hpp"

namespace berm::app {
namespace {

struct Drawn {
  explicit Drawn(const DrawnBed& bed) : sweep(make_fans(sweep_of(bed), drawn_viewpoint)) {
    upright_segments(sweep);
    pose.middle = {bed.x, bed.y, bed.top};
    pose.yaw = bed.yaw, pose.length = bed.length, pose.width = bed.width, pose.thickness = bed.thickness;
    pose.open_end = bed.rear_wall ? 0 : -1;
    regions = LevelRegionsOfBeds(sweep).about(pose.middle);
  }
  [[nodiscard]] LevelPlanes matched(const BedPose& with) const { return match_level_planes(with, regions, ranges, ground_below(depths_beside(sweep, pose))); }
  [[nodiscard]] LevelPlanes matched() const { return matched(pose); }
  FanSweep sweep;
  BedPose pose;
  std::vector<LevelRegion> regions;
  TruckRangeSet ranges = read_truck_ranges(BERM_TRUCK_RANGES);
};

// Far enough below the sensor for its floor to be seen over the near side.
DrawnBed low_one() {
  DrawnBed bed;
  bed.y = 6.0, bed.yaw = 0.0, bed.top = 0.6, bed.floor = -0.6, bed.ground = -2.2;
  return bed;
}

DrawnBed with_canopy() {
  DrawnBed bed;
  bed.canopy = 1.0, bed.cab = false;
  return bed;
}

TEST(LevelPlanes, AFloorThatIsSeenIsMatched) {
  const Drawn d(low_one());
  const LevelPlanes planes = d.matched();
  ASSERT_TRUE(planes.floor);
  EXPECT_NEAR(planes.floor->depth, 1.2, 0.01);
  EXPECT_GT(planes.floor->flatness, 3.0);
  EXPECT_FALSE(planes.canopy);
}

TEST(LevelPlanes, AFloorLiesBetweenTheSidesAndEndsParallelToTheTopsAndOverTheGround) {
  const Drawn d(low_one());
  BedPose p = d.pose;
  p.middle.y() -= 1.2;
  EXPECT_FALSE(d.matched(p).floor) << "half of it lies beside the bed";
  p = d.pose, p.middle.x() += 2.5;
  EXPECT_FALSE(d.matched(p).floor) << "half of it lies beyond an end";
  p = d.pose, p.pitch = 0.07;
  EXPECT_FALSE(d.matched(p).floor) << "it tilts";
  p = d.pose, p.middle.z() -= 0.8;
  EXPECT_FALSE(d.matched(p).floor) << "0.4 m below the tops";
  EXPECT_FALSE(match_level_planes(d.pose, d.regions, d.ranges, 1.2).floor) << "it lies on the ground";
  EXPECT_TRUE(match_level_planes(d.pose, d.regions, d.ranges, 2.8).floor);
}

// Of the same returns 3 cm higher and lower in turn.
TEST(LevelPlanes, SoilIsNoFloor) {
  Drawn d(low_one());
  int k = 0;
  for (FanReturn& r : d.sweep.returns)
    if (std::abs(r.place.z() + 0.6F) < 0.03F) r.place.z() += ++k % 2 == 0 ? 0.03F : -0.03F;
  d.regions = LevelRegionsOfBeds(d.sweep).about(d.pose.middle);
  EXPECT_FALSE(d.matched().floor);
}

TEST(LevelPlanes, ACanopyThatIsSeenIsMatchedBeyondItsEnd) {
  const Drawn d(with_canopy());
  const LevelPlanes planes = d.matched();
  ASSERT_TRUE(planes.canopy);
  EXPECT_EQ(planes.canopy->end, 1);
  EXPECT_NEAR(planes.canopy->length, 1.0, 0.2);
  EXPECT_NEAR(planes.canopy->rise, 0.2, 0.03);
  BedPose turned = d.pose;
  turned.yaw += std::numbers::pi;
  EXPECT_EQ(d.matched(turned).canopy.value_or(CanopyPlane{}).end, -1);
}

TEST(LevelPlanes, ACanopyBeginsAtTheTopOfAWallAndRisesAsAClassHasIt) {
  const Drawn d(with_canopy());
  BedPose p = d.pose;
  p.middle.z() += 0.15;
  EXPECT_FALSE(d.matched(p).canopy) << "below the top";
  p = d.pose, p.middle.head<2>() -= 0.5 * Eigen::Vector2d(std::cos(p.yaw), std::sin(p.yaw));
  EXPECT_FALSE(d.matched(p).canopy) << "half a metre beyond the wall";
  p = d.pose, p.roll = 0.15;
  EXPECT_FALSE(d.matched(p).canopy) << "it leans to a side";
  p = d.pose, p.open_end = 1;
  EXPECT_FALSE(d.matched(p).canopy) << "no wall stands there";
  Drawn none(with_canopy());
  none.ranges.classes.erase(none.ranges.classes.begin() + 2);
  EXPECT_FALSE(none.matched().canopy) << "no class has one";
  Drawn flat(with_canopy());
  flat.ranges.classes[2].canopy_rise = {0.4, 0.45};
  EXPECT_FALSE(flat.matched().canopy);
  Drawn longer(with_canopy());
  longer.ranges.classes[2].canopy_length = {1.8, 2.2}, longer.ranges.classes[2].canopy_rise = {0.05, 0.9};
  EXPECT_FALSE(longer.matched().canopy);
}

// A roof that is level with the tops, a gap behind the wall.
TEST(LevelPlanes, ACabsRoofIsNoCanopy) {
  for (const double over : {0.0, 0.1, 0.3}) {
    DrawnBed bed;
    bed.top += 0.3 - over;  // the roof is 0.3 m over the tops
    Drawn d(bed);
    d.pose.middle.z() = bed.top;
    for (FanReturn& r : d.sweep.returns)
      if (std::abs(static_cast<double>(r.place.z()) - bed.top - 0.3) < 0.05) r.place.z() -= static_cast<float>(0.3 - over);
    d.regions = LevelRegionsOfBeds(d.sweep).about(d.pose.middle);
    EXPECT_FALSE(d.matched().canopy) << over;
  }
}

// What is recognised says so: the floor's plane is in the answer, and a canopy tells the class.
TEST(LevelPlanes, AreWhatTheRecogniserGoesBy) {
  const TruckRangeSet ranges = read_truck_ranges(BERM_TRUCK_RANGES);
  const RecognisedTruck plain = recognise_truck(sweep_of(low_one()), drawn_viewpoint, ranges);
  ASSERT_TRUE(plain.found) << plain.reason;
  EXPECT_EQ(plain.truck_class, "box");
  ASSERT_TRUE(plain.planes.floor);
  EXPECT_NEAR(plain.planes.floor->depth, 1.2, 0.03);
  DrawnBed covered;
  covered.canopy = 1.0;
  const RecognisedTruck canopy = recognise_truck(sweep_of(covered), drawn_viewpoint, ranges);
  ASSERT_TRUE(canopy.found) << canopy.reason;
  EXPECT_TRUE(canopy.planes.canopy);
  EXPECT_EQ(canopy.truck_class, "canopy");
  EXPECT_NEAR(canopy.yaw, covered.yaw, 0.02);
}

// Its cab is where its canopy is, whatever stands beyond the other end.
TEST(LevelPlanes, TheCanopyTellsTheFront) {
  const Drawn d({});
  BedInterpretation i;
  i.pose = d.pose;
  weigh_whole(d.sweep, i);
  EXPECT_EQ(i.cab_end, 1);
  weigh_whole(d.sweep, i, false, -1);
  EXPECT_EQ(i.cab_end, -1);
  const TruckRangeSet ranges = read_truck_ranges(BERM_TRUCK_RANGES);
  DrawnBed between;
  between.block = true;
  const auto to_block = [&](const RecognisedTruck& truck) { return truck.found && std::abs(std::remainder(truck.yaw - between.yaw, 2 * std::numbers::pi)) > 3.0; };
  EXPECT_TRUE(to_block(recognise_truck(sweep_of(between), drawn_viewpoint, ranges))) << "the block is more like a cab than the cab";
  between.canopy = 1.0;
  const RecognisedTruck truck = recognise_truck(sweep_of(between), drawn_viewpoint, ranges);
  EXPECT_TRUE(truck.found) << truck.reason;
  EXPECT_FALSE(to_block(truck));
}

}  // namespace
}  // namespace berm::app
