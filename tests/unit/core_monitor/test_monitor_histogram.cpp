// The histograms of heights: bins, what departs, who is somebody.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <memory>

#include "histogram_scene.hpp"

namespace berm::core_test {
namespace {

// verifies: SK-WM-60
TEST_F(MonitorHistogram, APointIsInTheBinOfItsHeight) {
  settle();
  const std::int32_t least = std::numeric_limits<std::int32_t>::min();
  for (const std::int32_t z : {least, -5101, -5100, -4951, -4950, 0, 149, 150, 4349, 4350, 4499}) {
    sk_histogram_begin(h.get());
    see(50, 50, z);
    const int expected = z < -4950 ? 0 : (z >= 4350 ? 63 : (z + 5100) / 150);
    for (int b = 0; b < SK_HISTOGRAM_BINS; ++b) ASSERT_EQ(h->seen[50][50][b], b == expected ? 1 : 0) << z << " bin " << b;
  }
}

// Two spurious returns of beams that look up, one after the other, were somebody seven metres up.
// verifies: SK-WM-70
TEST_F(MonitorHistogram, WhatIsTooHighIsNobodyAndCountsForNothing) {
  ground();
  const auto before = std::make_unique<sk_monitor_histogram>(*h);
  for (const std::int32_t z : {4500, 7000, std::numeric_limits<std::int32_t>::max()})
    for (int i = 0; i < 3; ++i) EXPECT_FALSE(see(50, 50, z)) << z;
  EXPECT_EQ(std::memcmp(before.get(), h.get(), sizeof *h), 0);
  EXPECT_FALSE(step());
  EXPECT_TRUE(see(50, 50, 4499, 3));
  EXPECT_TRUE(step());
}

// verifies: SK-WM-60
TEST_F(MonitorHistogram, AFullBinHalvesAllOfItsCell) {
  see(50, 50, 0, 255);
  see(50, 50, 1500, 7);
  see(50, 50, 3000, 1);
  EXPECT_EQ(h->seen[50][50][34], 255);
  see(50, 50, 0);
  EXPECT_EQ(h->seen[50][50][34], 128);
  EXPECT_EQ(h->seen[50][50][44], 3);
  EXPECT_EQ(h->seen[50][50][54], 0) << "a stray one goes";
}

// verifies: SK-WM-61, SK-WM-62
TEST_F(MonitorHistogram, ThreePointsInACellStopInTheSameStep) {
  ground();
  EXPECT_FALSE(step());
  EXPECT_TRUE(see(50, 50, 1500));
  EXPECT_FALSE(step()) << "a lone one";
  EXPECT_TRUE(see(50, 50, 1400));
  EXPECT_FALSE(step()) << "two spurious ones, one after the other";
  EXPECT_TRUE(see(50, 50, 1500));
  EXPECT_TRUE(step());
  EXPECT_EQ(where.iy, 50);
  EXPECT_EQ(where.ix, 50);
  EXPECT_EQ(h->departed_mm[50][50], 1500);
}

// verifies: SK-WM-62
TEST_F(MonitorHistogram, ThreeInACellAndBesideItDoTwoDoNot) {
  ground();
  see(49, 49, 1500);
  see(50, 50, 1500);
  EXPECT_FALSE(step());
  see(49, 51, 1500);
  EXPECT_FALSE(step()) << "two cells apart from the first";
  see(50, 49, 1500);
  EXPECT_TRUE(step());
  EXPECT_TRUE(somebody(50, 49));
}

// verifies: SK-WM-62
TEST_F(MonitorHistogram, TwoOfOneNeighbourCountTwiceAndMoreNoMore) {
  ground();
  see(51, 51, 1500, 2);
  EXPECT_FALSE(step());
  see(50, 50, 1500);
  EXPECT_TRUE(somebody(50, 50));
  EXPECT_FALSE(somebody(51, 51));
}

// verifies: SK-WM-62
TEST_F(MonitorHistogram, OnlyWithinTheWindow) {
  ground();
  see(50, 50, 1500, 2);
  now_us += 2 * kPeriod + 1;
  see(50, 50, 1500);
  EXPECT_FALSE(step());
  now_us += 2 * kPeriod;
  see(50, 50, 1500);
  EXPECT_FALSE(step()) << "with the one before it two";
  see(50, 50, 1500);
  EXPECT_TRUE(step());
}

// verifies: SK-WM-61
TEST_F(MonitorHistogram, NothingDepartsWhereTooLittleWasSeen) {
  settle();
  see(50, 50, 0, SK_HISTOGRAM_ENOUGH - 1);
  EXPECT_FALSE(see(50, 50, 2000)) << "it is counted";
  EXPECT_TRUE(see(50, 50, 3000)) << "one stray below, the others at 0";
}

// verifies: SK-WM-61
TEST_F(MonitorHistogram, WhereTooLittleWasSeenALineIsTheGround) {
  settle();
  const auto line = [this](std::int32_t z_mm) { sk_histogram_line(h.get(), 50, 50, z_mm); };
  line(100);
  line(200);
  EXPECT_FALSE(see(50, 50, 100)) << "two lines";
  line(100);
  EXPECT_EQ(h->observed[50][50], 1U) << "a line is no observation";
  EXPECT_FALSE(see(50, 50, 600)) << "not by more than the rise";
  EXPECT_EQ(h->observed[50][50], 1U) << "and above the lines: not counted";
  EXPECT_TRUE(see(50, 50, 1600));
  EXPECT_TRUE(see(50, 50, 1000)) << "600 is no ground of his";
  EXPECT_FALSE(see(50, 50, 120));
  EXPECT_EQ(h->observed[50][50], 2U) << "of a bin that reaches down to the lines";
  line(-4000);
  EXPECT_EQ(h->line_mm[50][50], 100) << "one to a spurious return";
  EXPECT_FALSE(see(50, 50, 1800)) << "and now too few agree";
}

// verifies: SK-WM-61
TEST_F(MonitorHistogram, OfLinesTheHeightIsTakenThatMostAgreeOn) {
  const auto line = [this](std::int32_t z_mm) { sk_histogram_line(h.get(), 50, 50, z_mm); };
  line(-5000);
  line(100);
  EXPECT_EQ(h->lines[50][50], 0);
  for (int i = 0; i < 20; ++i) line(100 + 10 * i);
  EXPECT_EQ(h->line_mm[50][50], 290);
  EXPECT_EQ(h->lines[50][50], SK_LINES_MOST);
  for (int i = 0; i < SK_LINES_MOST; ++i) line(3000);
  EXPECT_EQ(h->line_mm[50][50], 290);
  line(3000);
  EXPECT_EQ(h->line_mm[50][50], 3000);
  EXPECT_EQ(h->line_mm[50][51], 0);
}

// verifies: SK-WM-61
TEST_F(MonitorHistogram, TwoHeightsInACellAreBothItsGroundAStrayOneIsNot) {
  ground();
  sk_histogram_begin(h.get());
  see(50, 50, 1300, 20);
  see(50, 50, 2600, 2);
  see(51, 51, 1300, 20);
  see(51, 51, 2600, 1);
  settle();
  EXPECT_FALSE(see(50, 50, 2600));
  EXPECT_FALSE(see(50, 50, 3000));
  EXPECT_TRUE(see(51, 51, 2600));
}

// verifies: SK-WM-61
TEST_F(MonitorHistogram, TheRiseIsOverTheLowSideOfWhatWasSeen) {
  ground(140);  // bin from 0 to 150
  EXPECT_FALSE(see(50, 50, kHeightThreshold));
  EXPECT_TRUE(see(50, 50, kHeightThreshold + 1));
  EXPECT_FALSE(see(50, 50, -3000)) << "what has sunk is ground";
}

// verifies: SK-WM-62, SK-WM-63
TEST_F(MonitorHistogram, WhoIsScannedFromTheFeetUpwardsIsNotHisOwnGround) {
  for (const bool downwards : {false, true}) {
    sk_histogram_begin(h.get());
    ground();
    for (int z = 0; z <= 1800; z += 30) see(50, 50, downwards ? 1800 - z : z);
    EXPECT_TRUE(step());
  }
}

// verifies: SK-WM-63
TEST_F(MonitorHistogram, WhatIsALittleHigherIsCountedOnceInAWindow) {
  ground();
  EXPECT_FALSE(see(50, 50, 400, 5));
  EXPECT_EQ(h->seen[50][50][36], 1);
  now_us += 2 * kPeriod;
  EXPECT_FALSE(see(50, 50, 400));
  EXPECT_EQ(h->seen[50][50][36], 1);
  now_us += 1;
  EXPECT_FALSE(see(50, 50, 400, 3));
  EXPECT_EQ(h->seen[50][50][36], 4) << "seen twice, it is known";
  EXPECT_FALSE(see(50, 50, 800));
}

// verifies: SK-WM-61, SK-WM-64
TEST_F(MonitorHistogram, WhoStandsNeverBecomesTheGround) {
  ground();
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(see(50, 50, 1700));
  for (int b = 40; b < SK_HISTOGRAM_BINS; ++b) EXPECT_EQ(h->seen[50][50][b], 0);
  now_us += 100 * kDwell;
  EXPECT_TRUE(step()) << "time clears nobody";
}

// verifies: SK-WM-63
TEST_F(MonitorHistogram, LearningAndForgetting) {
  see(50, 50, 0, 10);
  EXPECT_FALSE(see(50, 50, 1700)) << "learning";
  sk_histogram_begin(h.get());
  ground();
  see(50, 50, 1700, 3);
  EXPECT_TRUE(step());
  const std::int32_t x = SK_MAP_ORIGIN_MM + 50 * SK_CELL_MM + 150;
  sk_histogram_forget(h.get(), x, x, x, x);
  EXPECT_EQ(h->state[50][50], SK_CELL_LEARNING);
  EXPECT_EQ(h->state[50][51], SK_CELL_CLEAR);
  EXPECT_FALSE(see(50, 50, 1700, 100));
  sk_histogram_settle(h.get(), x, x, x, x);
  EXPECT_FALSE(see(50, 50, 1700)) << "a truck has parked";
  EXPECT_TRUE(see(50, 50, 2400));
}

// verifies: SK-WM-65
TEST_F(MonitorHistogram, UnwatchedCellsStopNothingWildStatesDo) {
  ground();
  rules->watched[50][50] = 0;
  see(50, 50, 1700, 3);
  EXPECT_FALSE(step());
  h->state[45][45] = SK_CELL_CLEAR ^ 4;
  EXPECT_TRUE(step());
  EXPECT_EQ(where.iy, 45);
}

// verifies: SK-WM-65
TEST_F(MonitorHistogram, RulesThatDoNotFitAndNegativeTimesStop) {
  ground();
  EXPECT_FALSE(step());
  const auto before = std::make_unique<sk_monitor_histogram>(*h);
  now_us = -1;
  EXPECT_TRUE(step());
  EXPECT_FALSE(see(50, 50, 1700, 2));
  now_us = 1'000'000;
  rules->period_us = 0;
  EXPECT_TRUE(step());
  EXPECT_FALSE(see(-1, 50, 0));
  EXPECT_FALSE(see(50, 104, 0));
  EXPECT_EQ(std::memcmp(before.get(), h.get(), sizeof *h), 0);
}

}  // namespace
}  // namespace berm::core_test
