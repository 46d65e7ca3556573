// Which classes a bed may be of, and which of these it is said to be of.
#include "recognition/bed_class.hpp"

#include <gtest/gtest.h>

#include "recognition/bed_ground.hpp"

namespace berm::app {
namespace {

FittedBed bed_of_sizes(double length, double width, double thickness, double length_deviation = 0.01) {
  FittedBed fit;
  fit.converged = true;
  fit.pose.length = length, fit.pose.width = width, fit.pose.thickness = thickness;
  fit.covariance(6, 6) = length_deviation * length_deviation;
  return fit;
}

BedHeight as_high(double height, bool half_pipe = false) { return {height, 0.02, 0.0, half_pipe ? 1.0 : 0.0}; }

std::string told(const FittedBed& fit, const BedHeight& height) { return class_told(fit, height, classes_of(fit, read_truck_ranges(BERM_TRUCK_RANGES))).name; }

TEST(BedClass, IsTheOneThatFitsBest) {
  EXPECT_EQ(told(bed_of_sizes(5.0, 2.4, 0.1), as_high(1.4)), "box");
  EXPECT_EQ(told(bed_of_sizes(5.0, 2.4, 0.1), as_high(1.4, true)), "half_round");
  EXPECT_EQ(told(bed_of_sizes(4.34, 2.4, 0.1), as_high(1.4)), "crawler") << "0.06 m shorter than a box";
  EXPECT_EQ(told(bed_of_sizes(4.38, 2.4, 0.1), as_high(1.4)), "box") << "nearer to the box";
  EXPECT_EQ(told(bed_of_sizes(4.38, 2.4, 0.1), as_high(1.85)), "crawler") << "as high as no box";
}

// No canopy is seen, which tells nothing, for an occluder may hide it: of two boxes that both fit the first is named, in the file's order.
TEST(BedClass, WhatNoRayTellsApartIsTheFirstInTheFile) {
  TruckRangeSet turned = read_truck_ranges(BERM_TRUCK_RANGES);
  std::swap(turned.classes[0], turned.classes[2]);
  const FittedBed fit = bed_of_sizes(5.0, 2.4, 0.1);
  EXPECT_EQ(class_told(fit, as_high(1.4), classes_of(fit, turned)).name, "canopy");
  EXPECT_EQ(class_told(fit, as_high(1.05), classes_of(fit, turned)).name, "box") << "too low for a canopy's";
}

TEST(BedClass, WithACanopyIsOneThatHasIt) {
  const TruckRangeSet all = read_truck_ranges(BERM_TRUCK_RANGES);
  const FittedBed fit = bed_of_sizes(5.0, 2.4, 0.1), longer = bed_of_sizes(5.65, 2.4, 0.1);
  EXPECT_EQ(class_told(fit, as_high(1.4), classes_of(fit, all), true).name, "canopy");
  EXPECT_EQ(class_told(longer, as_high(1.4), classes_of(longer, all), true).name, "canopy") << "longer by 0.05 m, within the slack";
  EXPECT_EQ(class_told(fit, as_high(1.4, true), classes_of(fit, all), true).name, "half_round") << "the shape goes before it";
  const FittedBed longest = bed_of_sizes(5.9, 2.4, 0.1);
  EXPECT_EQ(class_told(longest, as_high(1.4), classes_of(longest, all), true).name, "box") << "too long for the one with a canopy";
}

TEST(BedClass, StandsAsHighOverTheGroundAsTheClass) {
  const TruckRangeSet all = classes_of(bed_of_sizes(5.0, 2.4, 0.1), read_truck_ranges(BERM_TRUCK_RANGES));
  ASSERT_EQ(all.classes.size(), 3U);
  const auto standing = [&](double deep) { return standing_on(std::vector<double>(100, deep), all).classes.size(); };
  EXPECT_EQ(standing(2.8), 3U);
  EXPECT_EQ(standing(2.2), 1U) << "of a box alone";
  EXPECT_EQ(standing(1.9), 0U);
  EXPECT_EQ(standing_on({}, all).classes.size(), 3U) << "where no return lies, none says otherwise";
}

TEST(BedClass, AHeightOfNoClassIsRefusedWithTheHeightAndTheClasses) {
  const TruckRangeSet all = classes_of(bed_of_sizes(5.0, 2.4, 0.1), read_truck_ranges(BERM_TRUCK_RANGES));
  EXPECT_EQ(refusal_of_height({0.66, 0.02, kLikelyNone, 0.0}, all), "");
  EXPECT_EQ(refusal_of_height({0.66, 0.02, 0.95, 0.0}, all),
            "its walls are 0.66 m high (standard deviation 0.02), outside every class with its other sizes: box 1.00 to 1.75 m, half_round 1.30 to 1.80 m of a half pipe, canopy 1.10 to 1.70 m");
}

}  // namespace
}  // namespace berm::app
