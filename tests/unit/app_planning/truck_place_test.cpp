#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planning/truck_place.hpp"

namespace {

using namespace berm::app;

TruckBed bed_at(double x, double y, double yaw) {
  TruckBed bed;
  bed.centre_x = x, bed.centre_y = y, bed.yaw = yaw;
  return bed;
}

const std::vector<TruckZone> zone{{-3.0, 4.0, 5.0, 9.0}};  // x -3..5, y 4..9

TEST(TruckPlace, TheZoneHoldsTheBedAsFarAsItReachesAlongIt) {
  TruckBed bed = bed_at(1.0, 6.0, 0.0);
  limit_to_zones(bed, zone);
  EXPECT_NEAR(bed.zone_low, -4.0, 0.011);
  EXPECT_NEAR(bed.zone_high, 4.0, 0.011);
  bed = bed_at(2.0, 6.0, std::numbers::pi);  // the cab the other way
  limit_to_zones(bed, zone);
  EXPECT_NEAR(bed.zone_low, -3.0, 0.011);
  EXPECT_NEAR(bed.zone_high, 5.0, 0.011);
  bed = bed_at(1.0, 6.0, std::numbers::pi / 6);
  limit_to_zones(bed, zone);
  EXPECT_NEAR(bed.zone_high, 4.0 / std::cos(std::numbers::pi / 6), 0.011);
  EXPECT_NEAR(bed.zone_low, -2.0 / std::sin(std::numbers::pi / 6), 0.011);
}

TEST(TruckPlace, TwoZonesThatTouchAreOne) {
  TruckBed bed = bed_at(1.0, 6.0, 0.0);
  limit_to_zones(bed, {{-3.0, 4.0, 2.0, 9.0}, {2.0, 4.0, 6.5, 9.0}});
  EXPECT_NEAR(bed.zone_high, 5.5, 0.011);
}

TEST(TruckPlace, WithoutZonesNothingIsHeldBackAndOutsideOfThemEverything) {
  TruckBed bed = bed_at(1.0, 6.0, 0.0);
  limit_to_zones(bed, {});
  EXPECT_TRUE(std::isinf(bed.zone_low) && std::isinf(bed.zone_high));
  EXPECT_TRUE(stands_in_zone(bed, {}));
  EXPECT_TRUE(stands_in_zone(bed, zone));
  bed = bed_at(6.0, 6.0, 0.0);
  EXPECT_FALSE(stands_in_zone(bed, zone));
  limit_to_zones(bed, zone);
  EXPECT_EQ(bed.zone_low, 0.0);
  EXPECT_EQ(bed.zone_high, 0.0);
}

TEST(TruckPlace, TheLowestOfTheZonesAlongTheBedIsItsCeiling) {
  TruckBed bed = bed_at(1.0, 6.0, 0.0);
  bed.length = 4.8;
  limit_to_zones(bed, {});
  EXPECT_TRUE(std::isinf(bed.ceiling));
  limit_to_zones(bed, {{-3.0, 4.0, 6.0, 9.0, 1.0}});
  EXPECT_EQ(bed.ceiling, 1.0);
  limit_to_zones(bed, {{-3.0, 4.0, 2.0, 9.0, 1.0}, {1.9, 4.0, 6.5, 9.0, 0.6}});
  EXPECT_EQ(bed.ceiling, 0.6);
  limit_to_zones(bed, {{-3.0, 4.0, 6.0, 9.0, 1.0}, {-3.0, 4.0, 6.0, 9.0, 0.6}});
  EXPECT_EQ(bed.ceiling, 1.0) << "where two zones lie over each other the higher counts, as in the kernel";
}

}  // namespace
