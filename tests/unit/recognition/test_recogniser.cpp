// Whole sweeps: a bed is found where it stands, and nothing else is one.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "drawn_bed.hpp"
#include "recognition/truck_recogniser.hpp"

namespace berm::app {
namespace {

RecognisedTruck answer_to(const DrawnBed& bed) {
  return recognise_truck(sweep_of(bed), drawn_viewpoint, read_truck_ranges(BERM_TRUCK_RANGES));
}

TEST(TruckRecogniser, FindsTheBed) {
  const DrawnBed bed;
  const RecognisedTruck truck = answer_to(bed);
  ASSERT_TRUE(truck.found) << truck.reason;
  EXPECT_NEAR(truck.length, bed.length, 0.06);
  EXPECT_NEAR(truck.width, bed.width, 0.06);
  EXPECT_NEAR(std::remainder(truck.yaw - bed.yaw, 3.14159265358979), 0.0, 0.01);
  EXPECT_GT(truck.milliseconds, 0.0);
}

void expect_refused(const DrawnBed& bed, const std::string& reason) {
  const RecognisedTruck truck = answer_to(bed);
  EXPECT_FALSE(truck.found);
  EXPECT_NE(truck.reason.find(reason), std::string::npos) << truck.reason;
}

TEST(TruckRecogniser, RefusesALid) {
  DrawnBed bed;
  bed.lid = true;
  expect_refused(bed, "inner faces of its far walls");
}

TEST(TruckRecogniser, RefusesOtherSizes) {
  DrawnBed wide, small;
  wide.width = 3.2;
  small.length = 3.0;
  small.width = 1.7;
  expect_refused(wide, "inner faces of its far walls");
  expect_refused(small, "outside every class");
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
