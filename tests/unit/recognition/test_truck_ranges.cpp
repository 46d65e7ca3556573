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

TEST(TruckRanges, ShippedFileHasItsClasses) {
  const TruckRangeSet set = read_truck_ranges(BERM_TRUCK_RANGES);
  ASSERT_EQ(set.classes.size(), 4U);
  EXPECT_EQ(set.hull(&TruckRanges::inside_length), (SizeRange{4.05, 6.4}));
  ASSERT_NE(set.find(4.1, 2.4, false), nullptr);
  EXPECT_EQ(set.find(4.1, 2.4, false)->name, "crawler");
  EXPECT_FALSE(set.classes[0].half_round);
  EXPECT_TRUE(set.classes[1].half_round);
  EXPECT_EQ(set.find(7.0, 2.4, false), nullptr);
  EXPECT_EQ(set.find(5.0, 1.9, false), nullptr);
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
