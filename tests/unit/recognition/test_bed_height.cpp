// The height of a bed's walls: from its floor, from the foot of its walls, from the class alone; each with a deviation that says which.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "drawn_bed.hpp"
#include "recognition/bed_height.hpp"
#include "recognition/bed_inside.hpp"
#include "recognition/rays_of_sweep.hpp"

namespace berm::app {
namespace {

FittedBed known(const DrawnBed& bed) {
  FittedBed fit;
  fit.pose.middle = {bed.x, bed.y, bed.top};
  fit.pose.yaw = bed.yaw;
  fit.pose.length = bed.length;
  fit.pose.width = bed.width;
  fit.pose.thickness = bed.thickness;
  fit.pose.open_end = bed.rear_wall ? 0 : -1;
  fit.covariance = 1e-6 * Matrix8d::Identity();
  return fit;
}

std::vector<Ray> rays_to(const DrawnBed& bed) { return rays_near(make_fans(sweep_of(bed), drawn_viewpoint), known(bed).pose, 2.5); }

BedHeight height_of(const DrawnBed& bed, const TruckRangeSet& ranges) { return bed_height(known(bed), rays_to(bed), ranges); }

// Its walls go down to the ground without a gap, and the load hides its floor.
DrawnBed full_block() {
  DrawnBed bed;
  bed.floor = bed.ground + 0.05;
  bed.load = bed.top - 0.4;
  return bed;
}

TruckRangeSet shipped() { return read_truck_ranges(BERM_TRUCK_RANGES); }

TEST(BedHeight, IsThatOfTheWallsFootUnderALoad) {
  for (const double top : {1.4, 1.6, 1.75}) {
    DrawnBed bed;
    bed.top = top;
    bed.load = top - 0.2;
    const BedHeight height = height_of(bed, shipped());
    EXPECT_NEAR(height.height, bed.top - bed.floor, 0.04) << top;
    EXPECT_LT(height.deviation, 0.04) << top;
  }
}

TEST(BedHeight, IsThatOfTheFootOverWhatCarriesTheBed) {
  DrawnBed bed;
  bed.carrier = true;  // in the planes of its walls, 0.1 m below their feet
  const BedHeight height = height_of(bed, shipped());
  EXPECT_NEAR(height.height, bed.top - bed.floor, 0.04);
  EXPECT_LT(height.deviation, 0.04);
}

// Of the returns that lie between sides and ends alone.
std::vector<Ray> rays_into(const DrawnBed& bed) {
  const Placing place(known(bed).pose);
  std::vector<Ray> inside;
  for (const Ray& ray : rays_to(bed)) {
    const Eigen::Vector3d at = place.of(ray.at);
    if (std::abs(at.x()) < bed.length / 2 && std::abs(at.y()) < bed.width / 2) inside.push_back(ray);
  }
  return inside;
}

TEST(BedHeight, IsThatOfTheFloorWhereThatAloneIsSeen) {
  DrawnBed bed;
  bed.y = 5.0;
  const BedHeight height = bed_height(known(bed), rays_into(bed), shipped());
  EXPECT_NEAR(height.height, bed.top - bed.floor, 1.96 * height.deviation);
  EXPECT_LT(height.deviation, 0.1) << "a flat load may look the same";
}

TEST(BedHeight, IsOfTheClassesWhereNothingShowsIt) {
  const DrawnBed bed = full_block();
  TruckRangeSet ranges = shipped();
  const SizeRange all = ranges.hull(&TruckRanges::wall_height);
  const BedHeight wide = height_of(bed, ranges);
  EXPECT_GT(wide.deviation, 0.15);
  EXPECT_LT(wide.deviation, (all[1] - all[0]) / 2);
  for (TruckRanges& c : ranges.classes) c.wall_height = {1.3, 1.4};
  const BedHeight narrow = height_of(bed, ranges);
  EXPECT_NEAR(narrow.height, 1.35, 0.03);
  EXPECT_NEAR(narrow.deviation, 0.1 / std::sqrt(12.0), 0.02);
}

// The returns tell a height that no class has.
TEST(BedHeight, BeyondTheClassesIsTold) {
  for (const double high : {0.62, 0.75, 2.05, 2.25}) {
    DrawnBed bed;
    bed.floor = bed.top - high;
    bed.ground = bed.floor - 1.0;
    const BedHeight height = height_of(bed, shipped());
    EXPECT_GT(height.beyond, 0.99) << high;
    EXPECT_NEAR(height.height, high, 0.04);
    EXPECT_LT(height.deviation, 0.05) << high;
    EXPECT_LT(height.half_pipe, 0.5);
  }
  EXPECT_LT(height_of({}, shipped()).beyond, 0.01);
}

// A class's slack is for the errors of one sweep.
TEST(BedHeight, WithinTheSlackIsOfTheClass) {
  for (const double high : {1.0 - 0.05, 1.75 + 0.05, 1.0 - 0.2, 1.75 + 0.2}) {
    DrawnBed bed;
    bed.floor = bed.top - high;
    TruckRangeSet ranges = shipped();
    ranges.classes.resize(1);
    const BedHeight height = height_of(bed, ranges);
    EXPECT_NEAR(height.height, high, 0.04);
    if (high > 0.9 && high < 1.85) EXPECT_LT(height.beyond, kLikelyNone) << high;
    else EXPECT_GT(height.beyond, kLikelyNone) << high;
  }
}

// What is level within is steel, by how flat it is: a load is not as flat, so it is the floor.
TEST(BedHeight, IsThatOfALevelPlaneWithinWhereThatIsTooFlatForALoad) {
  ReturnsWithin returns;
  for (int k = 0; k < 60; ++k) returns.floors.push_back(k % 2 == 0 ? 1.04 : 1.06);
  const auto at = [](double depth) { return static_cast<std::size_t>((depth - kShallowest) / kStep + 0.5); };
  const auto floor_before_load = [&](double flatness) {
    const DepthWeights w = weigh_box_inside(returns, flatness);
    return w[at(1.05)] - w[at(1.5)];
  };
  EXPECT_NEAR(floor_before_load(3.0) - floor_before_load(0.0), 3.0, 0.1);
  EXPECT_NEAR(floor_before_load(20.0) - floor_before_load(0.0), 10.0, 0.1) << "not all soil is as rough";
  EXPECT_NEAR(floor_before_load(-3.0), floor_before_load(0.0), 1e-9);
  // Of few returns a load that lies flat is possible too.
  DrawnBed bed;
  bed.y = 5.0, bed.floor = bed.top - 1.05;
  const std::vector<Ray> few = every(rays_into(bed), 20);
  const BedHeight rough = bed_height(known(bed), few, shipped()), flat = bed_height(known(bed), few, shipped(), 3.0);
  EXPECT_LT(flat.deviation, rough.deviation);
}

// No ray shows floor or foot: what is possible beyond the classes stays as rare as it is.
TEST(BedHeight, BeyondTheClassesIsNotTakenWhereNothingShowsIt) {
  EXPECT_LT(height_of(full_block(), shipped()).beyond, kHardlyNone);
  const BedHeight blind = bed_height(known({}), {}, shipped());
  EXPECT_LT(blind.beyond, kHardlyNone);
  EXPECT_GT(blind.deviation, 0.15);
}

// A rear that was taken for open, with its wall in the end's plane: that is no floor's edge from far up on.
TEST(BedHeight, IsThatOfTheFootOfAWallWhereAnOpenEndWasThought) {
  DrawnBed bed;
  bed.yaw = 1.57;
  bed.load = bed.top - 0.1;  // nothing else is seen of it
  FittedBed fit = known(bed);
  fit.pose.open_end = -1;
  fit.pose.length += bed.thickness;
  fit.pose.middle.y() -= bed.thickness / 2;
  const BedHeight height = bed_height(fit, rays_near(make_fans(sweep_of(bed), drawn_viewpoint), fit.pose, 2.5), shipped());
  EXPECT_NEAR(height.height, bed.top - bed.floor, 0.06);
  EXPECT_LT(height.beyond, kHardlyNone);
}

// The plane of the tops is as uncertain as the fit says, and so is what is measured from it.
TEST(BedHeight, IsNoBetterKnownThanTheTops) {
  const DrawnBed bed;
  FittedBed fit = known(bed);
  fit.covariance(2, 2) = 0.05 * 0.05;
  EXPECT_GT(bed_height(fit, rays_to(bed), shipped()).deviation, 0.05);
}

}  // namespace
}  // namespace berm::app
