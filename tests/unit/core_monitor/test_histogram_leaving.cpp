// The histograms of heights: when somebody has left.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <memory>
#include <tuple>

#include "histogram_scene.hpp"

namespace berm::core_test {
namespace {

// verifies: SK-WM-64
TEST_F(MonitorHistogram, HeLeavesWhenTheGroundIsSeenTwiceAWaitApartAndTheDwellIsOver) {
  ground();
  see(50, 50, 1700, 3);
  EXPECT_TRUE(step());
  see(50, 50, 0, 5);
  EXPECT_TRUE(somebody(50, 50)) << "his feet, or what is beside him";
  now_us += 2 * kPeriod + 1;
  see(50, 50, 0);
  EXPECT_TRUE(somebody(50, 50)) << "once";
  now_us += kWait - 1;
  see(50, 50, 0);
  EXPECT_TRUE(somebody(50, 50)) << "too soon";
  see(50, 50, 1700);
  now_us += 2 * kPeriod + 1;
  see(50, 50, 0);
  EXPECT_TRUE(somebody(50, 50)) << "he was seen between";
  now_us += kWait;
  EXPECT_TRUE(step());
  see(50, 50, 0);
  EXPECT_FALSE(somebody(50, 50));
  EXPECT_TRUE(step()) << "the dwell";
  now_us += kDwell - 1;
  EXPECT_TRUE(step());
  now_us += 1;
  EXPECT_FALSE(step());
}

// A lidar at rest never meets the ground between its rings: who has left from there is known to have by what passes.
// verifies: SK-WM-72
TEST_F(MonitorHistogram, HeLeavesWhenRaysPassAsLowAsTheGroundTwice) {
  const auto pass = [this](std::int32_t z_mm, int iy = 50, int ix = 50) { sk_histogram_pass(h.get(), SK_NOBODY_KNOWS, rules.get(), iy, ix, z_mm, now_us); };
  ground();
  const std::int32_t low = 250, high = 1200;
  const auto departs = [this](int iy, int ix, std::int32_t z_mm) { return sk_histogram_departs(h.get(), SK_NOBODY_KNOWS, rules.get(), iy, ix, z_mm); };
  EXPECT_TRUE(departs(45, 45, high) && !departs(45, 45, low) && !departs(-1, 45, high) && !departs(45, SK_MAP_CELLS, high));
  ASSERT_FALSE(see(45, 45, low)) << "no rise";
  see(50, 50, 1700, 3);
  ASSERT_TRUE(see(45, 45, high)) << "a rise";
  now_us += 2 * kPeriod + 1;
  pass(low);
  EXPECT_TRUE(somebody(50, 50)) << "once";
  now_us += kWait - 1;
  pass(low);
  EXPECT_TRUE(somebody(50, 50)) << "too soon";
  see(50, 50, 1700);
  pass(low);
  now_us += 2 * kPeriod + 1;
  for (int i = 0; i < 5; ++i, now_us += kWait) pass(high);
  EXPECT_TRUE(somebody(50, 50)) << "over his head";
  pass(low, 50, 51), now_us += kWait, pass(low, 50, 51);
  EXPECT_TRUE(somebody(50, 50)) << "beside him";
  pass(low);
  see(51, 51, 1700);
  now_us += kWait;
  see(51, 51, 1700);
  pass(low);
  EXPECT_TRUE(somebody(50, 50)) << "he may be beside it";
  now_us += 2 * kPeriod + 1;
  pass(low);
  now_us += kWait;
  pass(low);
  EXPECT_FALSE(somebody(50, 50));
}

// verifies: SK-WM-72
TEST_F(MonitorHistogram, WhatPassesCountsForNothingElse) {
  ground();
  see(50, 50, 1700, 3);
  sk_histogram_forget_cell(h.get(), 45, 45);
  const auto before = std::make_unique<sk_monitor_histogram>(*h);
  now_us += kWait;
  for (const auto& [iy, ix, z, at_us] : {std::tuple{45, 45, 100, now_us}, {46, 46, 100, now_us}, {-1, 50, 100, now_us}, {50, SK_MAP_CELLS, 100, now_us}, {50, 50, 100, std::int64_t{-1}},
                                         {50, 50, 4500, now_us}, {50, 50, std::numeric_limits<std::int32_t>::max(), now_us}})
    sk_histogram_pass(h.get(), SK_NOBODY_KNOWS, rules.get(), iy, ix, z, at_us);
  EXPECT_EQ(std::memcmp(h.get(), before.get(), sizeof *h), 0);
}

// verifies: SK-WM-64
TEST_F(MonitorHistogram, NobodyLeavesWhileSomethingDepartsBeside) {
  ground();
  see(50, 50, 1700, 3);
  now_us += 2 * kPeriod + 1;
  see(51, 51, 1700);
  see(50, 50, 0);
  now_us += kWait;
  see(50, 50, 0);
  EXPECT_TRUE(somebody(50, 50));
}

}  // namespace
}  // namespace berm::core_test
