// The file of truck classes: what stands in it, and what it refuses.
#include <gtest/gtest.h>

#include <string>

#include "config/strict_table.hpp"
#include "recognition/truck_ranges.hpp"
#include "refused_edit.hpp"

namespace berm::app {
namespace {

std::string error_with(const std::string& from, const std::string& to) {
  return test::refused_edit<config::ConfigError>(BERM_TRUCK_RANGES, from, to, read_truck_ranges);
}

std::string names(const TruckRangeSet& set) {
  std::string all;
  for (const TruckRanges& c : set.classes) all += (all.empty() ? "" : " ") + c.name;
  return all;
}

TEST(TruckRanges, ShippedFileHasItsClasses) {
  const TruckRangeSet set = read_truck_ranges(BERM_TRUCK_RANGES);
  ASSERT_EQ(set.classes.size(), 4U);
  EXPECT_EQ(set.hull(&TruckRanges::inside_length), (SizeRange{4.05, 6.4}));
  EXPECT_EQ(names(set.taking_in({4.1, 2.4, 0.1, false, 0.0})), "crawler");
  EXPECT_FALSE(set.classes[0].half_round);
  EXPECT_TRUE(set.classes[1].half_round);
  EXPECT_EQ(names(set.taking_in({7.0, 2.4, 0.1, false, 0.0})), "");
  EXPECT_EQ(names(set.taking_in({5.0, 1.9, 0.1, false, 0.0})), "");
}

// Every size by itself, just within the slack and just beyond it.
TEST(TruckRanges, AClassTakesInABedByEachOfItsSizes) {
  TruckRangeSet set = read_truck_ranges(BERM_TRUCK_RANGES);
  EXPECT_EQ(names(set.taking_in({5.0, 2.4, 0.1, true, 0.0})), "box half_round canopy");
  EXPECT_EQ(names(set.taking_in({5.67, 2.4, 0.1, true, 0.0})), "box half_round canopy");
  EXPECT_EQ(names(set.taking_in({5.69, 2.4, 0.1, true, 0.0})), "box half_round");
  EXPECT_EQ(names(set.taking_in({6.09, 2.4, 0.1, true, 0.0})), "half_round");
  EXPECT_EQ(names(set.taking_in({6.09, 2.4, 0.1, true, 0.02})), "box half_round") << "a length that is open";
  EXPECT_EQ(names(set.taking_in({5.0, 2.54, 0.1, true, 0.0})), "box canopy");
  EXPECT_EQ(names(set.taking_in({5.0, 2.4, 0.21, true, 0.0})), "box canopy") << "too thick for a half pipe";
  EXPECT_EQ(names(set.taking_in({5.0, 2.4, 0.23, true, 0.0})), "");
  set.classes[0].open_rear = false;
  EXPECT_EQ(names(set.taking_in({5.0, 2.4, 0.1, true, 0.0})), "half_round canopy");
  EXPECT_EQ(names(set.taking_in({5.0, 2.4, 0.1, false, 0.0})), "box half_round canopy");
}

// Both keys or none.
TEST(TruckRanges, ACanopyIsAClassesOwn) {
  TruckRangeSet set = read_truck_ranges(BERM_TRUCK_RANGES);
  EXPECT_EQ(set.canopy_hull(&TruckRanges::canopy_length), (SizeRange{0.6, 1.3}));
  EXPECT_EQ(set.canopy_hull(&TruckRanges::canopy_rise), (SizeRange{0.05, 0.45}));
  set.classes.erase(set.classes.begin() + 2);
  EXPECT_FALSE(set.canopy_hull(&TruckRanges::canopy_length));
  EXPECT_NE(error_with("canopy_length = [0.60, 1.30]", "").find("canopy_length"), std::string::npos);
  EXPECT_NE(error_with("canopy_rise = [0.05, 0.45]", "").find("canopy_rise"), std::string::npos);
  EXPECT_NE(error_with("canopy_rise = [0.05, 0.45]", "canopy_rise = [0.45, 0.05]").find("canopy_rise"), std::string::npos);
}

TEST(TruckRanges, RefusesWhatIsWrong) {
  EXPECT_NE(error_with("inside_width = [2.30, 2.50]", "inside_width = [2.50, 2.30]").find("inside_width"), std::string::npos);
  EXPECT_NE(error_with("slack = 0.08", "slack = 2.0").find("slack"), std::string::npos);
  EXPECT_NE(error_with("slack = 0.08", "slack = 0.08\nslope = 1").find("slope"), std::string::npos);
  EXPECT_NE(error_with("bed = \"half_round\"", "bed = \"round\"").find("bed"), std::string::npos);
  EXPECT_NE(error_with("open_rear = true", "").find("open_rear"), std::string::npos);
  EXPECT_NE(error_with("\"crawler\"", "\"box\"").find("twice"), std::string::npos);
  EXPECT_EQ(error_with("slack = 0.08", "slack = 0.10"), "");
}

}  // namespace
}  // namespace berm::app
