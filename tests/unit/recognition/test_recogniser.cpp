// Whole sweeps: a bed is found where it stands, and nothing else is one.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "drawn_bed.hpp"
#include "recognition/truck_recogniser.hpp"

namespace berm::app {
namespace {

RecognisedTruck answer_to(const DrawnBed& bed) {
  return recognise_truck(sweep_of(bed), drawn_viewpoint, read_truck_ranges(BERM_TRUCK_RANGES));
}

void expect_refused(const DrawnBed& bed, const std::string& reason) {
  const RecognisedTruck truck = answer_to(bed);
  EXPECT_FALSE(truck.found);
  EXPECT_NE(truck.reason.find(reason), std::string::npos) << truck.reason;
}

TEST(TruckRecogniser, FindsTheBed) {
  const DrawnBed bed;
  const RecognisedTruck truck = answer_to(bed);
  ASSERT_TRUE(truck.found) << truck.reason;
  EXPECT_NEAR(truck.length, bed.length, 0.06);
  EXPECT_NEAR(truck.width, bed.width, 0.06);
  EXPECT_NEAR(std::remainder(truck.yaw - bed.yaw, 2 * 3.14159265358979), 0.0, 0.01) << "towards the cab";
  EXPECT_FALSE(truck.open_rear);
  EXPECT_GT(truck.milliseconds, 0.0);
}

// Where the walls' outer faces go on to the ground only the inside tells how high they are.
TEST(TruckRecogniser, TellsTheWallsHeightWithAndWithoutTheirFoot) {
  DrawnBed bed;
  for (const bool carrier : {false, true}) {
    bed.carrier = carrier;
    const RecognisedTruck truck = answer_to(bed);
    ASSERT_TRUE(truck.found) << truck.reason;
    EXPECT_NEAR(truck.height, bed.top - bed.floor, 0.05) << carrier;
    EXPECT_LT(std::abs(truck.height - (bed.top - bed.floor)), 3.0 * truck.height_deviation) << carrier;
  }
}

TEST(TruckRecogniser, FindsABedWithoutATailgate) {
  DrawnBed bed;
  bed.yaw = -0.4;
  bed.rear_wall = false;
  const RecognisedTruck truck = answer_to(bed);
  ASSERT_TRUE(truck.found) << truck.reason;
  EXPECT_NEAR(truck.length, bed.length, 0.2) << "the rear lies between two scanlines";
  EXPECT_NEAR(std::remainder(truck.yaw - bed.yaw, 2 * 3.14159265358979), 0.0, 0.01);
  EXPECT_TRUE(truck.open_rear);
}

TEST(TruckRecogniser, FindsABedThatIsSeenFromItsOpenRear) {
  for (const double aside : {-0.25, 0.0, 0.2}) {
    DrawnBed bed;
    bed.yaw = std::numbers::pi / 2 + aside;
    bed.rear_wall = false;
    const RecognisedTruck truck = answer_to(bed);
    ASSERT_TRUE(truck.found) << truck.reason;
    EXPECT_NEAR(truck.length, bed.length, 0.1);
    EXPECT_NEAR(truck.width, bed.width, 0.06);
    EXPECT_NEAR(std::remainder(truck.yaw - bed.yaw, 2 * std::numbers::pi), 0.0, 0.01);
    EXPECT_TRUE(truck.open_rear);
  }
}

// From before its cab, whose front hides the bed's front wall and agrees as that wall with more rays than the bed does.
TEST(TruckRecogniser, FindsABedBehindItsCab) {
  struct View { double y, top, load, aside; };
  for (const View& v : {View{8.5, 1.3, -0.3, -0.3}, View{8.5, 1.6, -0.1, 0.3}, View{8.5, 2.0, -0.1, -0.5}, View{8.5, 2.4, -0.3, -0.5}, View{9.5, 2.0, -0.3, 0.3}, View{9.5, 2.4, -0.3, -0.5}}) {
    DrawnBed bed;
    bed.x = 2.0, bed.y = v.y, bed.yaw = v.aside - std::numbers::pi / 2;
    bed.top = v.top, bed.floor = v.top - 1.4, bed.ground = v.top - 2.8, bed.load = v.top + v.load;
    const RecognisedTruck truck = answer_to(bed);
    SCOPED_TRACE(testing::Message() << v.y << " m away, tops at " << v.top << " m, " << v.aside << " rad aside");
    ASSERT_TRUE(truck.found) << truck.reason;
    EXPECT_NEAR(truck.length, bed.length, 0.06);
    EXPECT_LT((truck.pose.middle - Eigen::Vector3d(bed.x, bed.y, bed.top)).norm(), 0.05);
    EXPECT_NEAR(std::remainder(truck.yaw - bed.yaw, 2 * std::numbers::pi), 0.0, 0.01);
  }
}

// Wherever its end is thought to be.
TEST(TruckRecogniser, RefusesWhatEndsOutOfSightAndHasNoCab) {
  for (const double length : {9.0, 12.0, 16.0}) {
    DrawnBed container;
    container.cab = false;
    container.length = length;
    container.x = length / 2 - 2.5;
    container.yaw = 0.0;
    EXPECT_FALSE(answer_to(container).found) << length;
  }
}

// The sweep's sector cuts it off: the last scanline meets the corner's far side alone.
TEST(TruckRecogniser, RefusesWhatHasNoCabAndOneEndToSee) {
  for (const double x : {7.0, 7.5, 8.0, 8.5, 9.0}) {
    DrawnBed container;
    container.cab = false;
    container.length = 6.0;
    container.x = x;
    container.yaw = 0.0;
    SCOPED_TRACE(x);
    expect_refused(container, "an end of it is not seen");
  }
}

TEST(TruckRecogniser, RefusesABedWithoutACab) {
  DrawnBed bed;
  bed.cab = false;
  expect_refused(bed, "where its cab would stand");
}

TEST(TruckRecogniser, RefusesALid) {
  DrawnBed bed;
  bed.lid = true;
  expect_refused(bed, "closed on top");
}

// Too little like a bed of a truck's width, or outside every class: which, a few beams decide.
TEST(TruckRecogniser, RefusesOtherSizes) {
  DrawnBed wide, small;
  wide.width = 3.2;
  small.length = 3.0;
  small.width = 1.7;
  for (const DrawnBed& bed : {wide, small}) {
    const RecognisedTruck answer = answer_to(bed);
    EXPECT_FALSE(answer.found);
    EXPECT_TRUE(answer.reason.find("too little like one") != std::string::npos || answer.reason.find("outside every class") != std::string::npos) << answer.reason;
  }
}

// What is known of widths and walls is the classes', not that of the shipped ones.
TEST(TruckRecogniser, FindsTheTrucksOfOtherClasses) {
  TruckRangeSet ranges = read_truck_ranges(BERM_TRUCK_RANGES);
  for (TruckRanges& c : ranges.classes) c.inside_width = {3.0, 3.4}, c.wall_thickness = {0.15, 0.25};
  DrawnBed wide;
  wide.width = 3.2;
  wide.thickness = 0.2;
  const RecognisedTruck answer = recognise_truck(sweep_of(wide), drawn_viewpoint, ranges);
  ASSERT_TRUE(answer.found) << answer.reason;
  EXPECT_NEAR(answer.width, wide.width, 0.05);
  EXPECT_NEAR(answer.length, wide.length, 0.06);
  EXPECT_FALSE(answer_to(wide).found) << "of the shipped classes it is none";
}

TEST(TruckRecogniser, RefusesBareGroundAndNothing) {
  DrawnBed far;
  far.y = 60.0;
  expect_refused(far, "no upright wall");
  const RecognisedTruck truck = recognise_truck({}, drawn_viewpoint, read_truck_ranges(BERM_TRUCK_RANGES));
  EXPECT_FALSE(truck.found);
  EXPECT_FALSE(truck.reason.empty());
}

}  // namespace
}  // namespace berm::app
