// Whole sweeps whose answer hangs on other ends being tried, and on which of them: scenes found by drawing many.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "drawn_bed.hpp"
#include "recognition/truck_recogniser.hpp"

namespace berm::app {
namespace {

RecognisedTruck answer_with_ends_tried(const DrawnBed& bed) { return recognise_truck(sweep_of(bed), drawn_viewpoint, read_truck_ranges(BERM_TRUCK_RANGES)); }

void expect_found_where_it_is(const DrawnBed& bed) {
  const RecognisedTruck truck = answer_with_ends_tried(bed);
  ASSERT_TRUE(truck.found) << truck.reason;
  EXPECT_NEAR(truck.length, bed.length, 0.06);
  EXPECT_LT((truck.pose.middle - Eigen::Vector3d(bed.x, bed.y, bed.top)).norm(), 0.06);
  EXPECT_NEAR(std::remainder(truck.yaw - bed.yaw, 2 * std::numbers::pi), 0.0, 0.02);
}

void expect_refused_for(const DrawnBed& bed, const std::string& reason) {
  const RecognisedTruck truck = answer_with_ends_tried(bed);
  EXPECT_FALSE(truck.found) << truck.length << " m long";
  EXPECT_NE(truck.reason.find(reason), std::string::npos) << truck.reason;
}

// Of what has no cab a part is a bed to the rules; with its true end they refuse it.
TEST(TruckRecogniserEnds, APartOfWhatIsNoneIsNotTaken) {
  expect_refused_for({.x = 0.445, .y = 8.839, .yaw = 0.134, .length = 5.166, .width = 2.374, .top = 1.634, .floor = 0.324, .ground = -1.029, .carrier = true, .cab = false}, "where its cab would stand");
}

// A place of the walls that moves came to is worth more than the fit that followed.
TEST(TruckRecogniserEnds, WhatMovesOfTheWallsCameToDecides) {
  expect_found_where_it_is({.x = 0.699, .y = 10.583, .yaw = 2.235, .length = 5.087, .width = 2.208, .top = 1.265, .floor = 0.360, .ground = -1.409, .rear_wall = false, .load = 1.128});
}

// Of many ends of what was refused one makes a bed of it by chance: it needs a cab, and this has none.
TEST(TruckRecogniserEnds, WithAnotherEndOfWhatWasRefusedABedNeedsACab) {
  expect_refused_for({.x = 4.150, .y = 9.617, .yaw = 0.879, .length = 5.329, .width = 2.233, .top = 0.902, .floor = -0.295, .ground = -1.916, .cab = false, .rear_wall = false, .load = 0.705}, "with another end it is like a bed, but has no cab");
}

}  // namespace
}  // namespace berm::app
