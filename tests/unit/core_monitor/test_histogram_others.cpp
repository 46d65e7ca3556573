// The histograms of heights: what other sensors know of a cell, and what was met beside it.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <utility>

#include "histogram_scene.hpp"

namespace berm::core_test {
namespace {

// verifies: SK-WM-68
TEST_F(MonitorHistogram, WhereTooLittleWasSeenWhatOthersKnowCounts) {
  const auto others = std::make_unique<sk_monitor_histogram>();
  const auto departs = [&](std::int32_t z_mm) {
    return sk_histogram_insert(h.get(), sk_histogram_known(others.get(), 50, 50), false, rules.get(), 50, 50, z_mm, now_us);
  };
  sk_histogram_begin(others.get());
  settle();
  for (int i = 0; i < SK_HISTOGRAM_ENOUGH; ++i) sk_histogram_insert(others.get(), SK_NOBODY_KNOWS, false, rules.get(), 50, 50, 0, now_us);
  EXPECT_FALSE(departs(900)) << "the others are learning";
  sk_histogram_begin(h.get());
  settle();
  sk_histogram_settle(others.get(), kLow, kLow, kHigh, kHigh);
  EXPECT_FALSE(departs(400)) << "no rise";
  EXPECT_EQ(h->observed[50][50], 0U) << "higher than what the others know";
  EXPECT_FALSE(departs(100));
  EXPECT_EQ(h->observed[50][50], 1U);
  EXPECT_TRUE(departs(900));
  EXPECT_TRUE(departs(800));
  EXPECT_FALSE(somebody(50, 50)) << "two points";
  EXPECT_TRUE(departs(700));
  EXPECT_TRUE(somebody(50, 50));
  sk_histogram_begin(h.get());
  see(50, 50, 1000, SK_HISTOGRAM_ENOUGH);
  settle();
  EXPECT_FALSE(departs(1000)) << "enough of its own";
}

// Nine points of one beam that met the foot of a slope, and one of its top, were all that was known of a cell; the next at its top were somebody.
// verifies: SK-WM-71
TEST_F(MonitorHistogram, WhereNotManyWereSeenWhatOthersKnowExplains) {
  settle();
  see(50, 50, -1500, 9);
  const int high = 4;  // bin of -4500
  const auto bin_of = [](std::int32_t z_mm) { return (z_mm - SK_HISTOGRAM_FLOOR_MM) / SK_HISTOGRAM_BIN_MM; };
  const auto departs = [&](std::int32_t z_mm, std::int32_t known) { return sk_histogram_insert(h.get(), known, false, rules.get(), 50, 50, z_mm, now_us); };
  EXPECT_TRUE(departs(-800, SK_NOBODY_KNOWS));
  EXPECT_TRUE(departs(-800, high)) << "known lower";
  EXPECT_TRUE(departs(-800, bin_of(-800 - kHeightThreshold))) << "its bin begins lower than a rise below the point";
  EXPECT_FALSE(departs(-800, bin_of(-800 - kHeightThreshold) + 1));
  EXPECT_FALSE(departs(-800, bin_of(-300)));
  EXPECT_TRUE(departs(600, bin_of(-300))) << "higher than any of them knows";
  see(50, 50, -1500, SK_HISTOGRAM_WELL);
  EXPECT_EQ(h->observed[50][50], static_cast<std::uint32_t>(SK_HISTOGRAM_WELL));
  EXPECT_TRUE(departs(-800, bin_of(-300))) << "many of its own";
}

// A lidar's lines led past a cab's corner to the ground beyond; the first three points of the corner itself, which the scanners knew, were somebody.
// verifies: SK-WM-71
TEST_F(MonitorHistogram, LinesYieldToWhatIsWorthMoreAndToNothingElse) {
  settle();
  for (int i = 0; i < SK_LINES_ENOUGH; ++i) sk_histogram_line(h.get(), 50, 50, -700);
  const int as_high = 38, lower = 33;  // bins of 600 and -150
  const auto departs = [&](std::int32_t z_mm, std::int32_t known, bool over_lines) {
    return sk_histogram_insert(h.get(), known, over_lines, rules.get(), 50, 50, z_mm, now_us);
  };
  EXPECT_FALSE(departs(445, as_high, true));
  EXPECT_EQ(h->observed[50][50], 0U) << "nor is what the lines are too low for counted";
  EXPECT_TRUE(departs(445, as_high, false));
  EXPECT_TRUE(departs(445, lower, true)) << "higher than is known by a rise";
  EXPECT_TRUE(departs(600 + kHeightThreshold + 1, as_high, true));
  see(50, 50, -700, SK_HISTOGRAM_ENOUGH);
  EXPECT_FALSE(departs(445, as_high, false)) << "points of its own, and few";
}

// verifies: SK-WM-71
TEST_F(MonitorHistogram, WhatIsKnownOfACellIsTheSecondHighest) {
  const auto known = [this](int iy = 50, int ix = 50) { return sk_histogram_known(h.get(), iy, ix); };
  settle();
  see(50, 50, 0, SK_HISTOGRAM_ENOUGH - 1);
  EXPECT_EQ(known(), SK_NOBODY_KNOWS) << "too little";
  see(50, 50, 0);
  EXPECT_EQ(known(), 34);
  sk_histogram_begin(h.get());
  see(50, 50, 0, SK_HISTOGRAM_ENOUGH);
  see(50, 50, 1500);
  EXPECT_EQ(known(), SK_NOBODY_KNOWS) << "learning";
  settle();
  EXPECT_EQ(known(), 34) << "a stray one above it";
  sk_histogram_begin(h.get());
  see(50, 50, 0, SK_HISTOGRAM_ENOUGH);
  see(50, 50, 1500);
  see(50, 50, 900);
  settle();
  EXPECT_EQ(known(), 40);
  for (const auto& [iy, ix] : {std::pair{-1, 50}, {50, -1}, {SK_MAP_CELLS, 50}, {50, SK_MAP_CELLS}}) EXPECT_EQ(known(iy, ix), SK_NOBODY_KNOWS);
}

// verifies: SK-WM-67
TEST_F(MonitorHistogram, WhatIsMetBesideACellExplainsButIsNoPointOfIt) {
  const std::uint32_t most = SK_HISTOGRAM_WELL;
  for (std::uint32_t i = 0; i < most + 5; ++i) sk_histogram_beside(h.get(), 50, 50, 0);
  EXPECT_EQ(h->seen[50][50][34], 255 / 2 + 5) << "a full bin halves";
  EXPECT_EQ(h->observed[50][50], 0U);
  sk_histogram_beside(h.get(), 50, 50, SK_HISTOGRAM_TOP_MM);
  EXPECT_EQ(h->seen[50][50][SK_HISTOGRAM_BINS - 1], 0) << "too high";
  settle();
  const auto before = std::make_unique<sk_monitor_histogram>(*h);
  sk_histogram_beside(h.get(), 50, 50, 300);
  for (const int off : {-1, SK_MAP_CELLS}) sk_histogram_beside(h.get(), off, 50, 0), sk_histogram_beside(h.get(), 50, off, 0);
  EXPECT_EQ(std::memcmp(before.get(), h.get(), sizeof *h), 0) << "learning no longer, or outside the map";
  EXPECT_EQ(sk_histogram_known(h.get(), 50, 50), SK_NOBODY_KNOWS);
  EXPECT_EQ(sk_histogram_met(h.get(), 50, 50), 34) << "met it was";
  for (const int off : {-1, SK_MAP_CELLS}) EXPECT_EQ(sk_histogram_met(h.get(), 50, off), SK_NOBODY_KNOWS);
  EXPECT_FALSE(see(50, 50, 800)) << "nothing is known of the cell itself";
  sk_histogram_begin(h.get());
  for (int i = 0; i < 2; ++i) sk_histogram_beside(h.get(), 50, 50, 1500);
  see(50, 50, 0, SK_HISTOGRAM_ENOUGH);
  settle();
  EXPECT_FALSE(see(50, 50, 1900)) << "the edge of what stands beside it";
  EXPECT_TRUE(see(50, 50, 2300));
}

}  // namespace
}  // namespace berm::core_test
