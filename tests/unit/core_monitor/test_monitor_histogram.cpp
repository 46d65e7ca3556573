// The histograms of heights: scenes, and random sequences beside a reference of other code.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <tuple>

#include "core/monitor_histogram.h"
#include "monitor_scene.hpp"
#include "reference_histogram.hpp"

namespace berm::core_test {
namespace {

constexpr std::uint64_t kSeed = 4711;
constexpr std::int32_t kLow = SK_MAP_ORIGIN_MM, kHigh = -SK_MAP_ORIGIN_MM;

class MonitorHistogram : public testing::Test {
 protected:
  MonitorHistogram() { sk_histogram_begin(h.get()); }
  bool see(int iy, int ix, std::int32_t z_mm, int points = 1) {
    bool departs = false;
    for (int i = 0; i < points; ++i) departs = sk_histogram_insert(h.get(), SK_NOBODY_KNOWS, SK_NOBODY_KNOWS, rules.get(), iy, ix, z_mm, now_us);
    return departs;
  }
  void ground(std::int32_t z_mm = 0) {
    for (int iy = 40; iy < 60; ++iy)
      for (int ix = 40; ix < 60; ++ix) see(iy, ix, z_mm, SK_HISTOGRAM_ENOUGH);
    settle();
  }
  void settle() { sk_histogram_settle(h.get(), kLow, kLow, kHigh, kHigh); }
  bool step() { return sk_histogram_step(h.get(), rules.get(), now_us, &where); }
  bool somebody(int iy, int ix) const { return h->state[iy][ix] == SK_CELL_SOMEBODY; }

  std::unique_ptr<sk_monitor_histogram> h = std::make_unique<sk_monitor_histogram>();
  std::unique_ptr<sk_monitor_rules> rules = monitor_rules(true);
  std::int64_t now_us = 1'000'000;
  sk_monitor_cell where{};
};

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

// verifies: SK-WM-68
TEST_F(MonitorHistogram, WhereTooLittleWasSeenWhatOthersKnowCounts) {
  const auto others = std::make_unique<sk_monitor_histogram>();
  const auto departs = [&](std::int32_t z_mm) {
    return sk_histogram_insert(h.get(), sk_histogram_known(others.get(), 50, 50), SK_NOBODY_KNOWS, rules.get(), 50, 50, z_mm, now_us);
  };
  sk_histogram_begin(others.get());
  settle();
  for (int i = 0; i < SK_HISTOGRAM_ENOUGH; ++i) sk_histogram_insert(others.get(), SK_NOBODY_KNOWS, SK_NOBODY_KNOWS, rules.get(), 50, 50, 0, now_us);
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
  const auto departs = [&](std::int32_t z_mm, std::int32_t known) { return sk_histogram_insert(h.get(), known, SK_NOBODY_KNOWS, rules.get(), 50, 50, z_mm, now_us); };
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
  const auto departs = [&](std::int32_t z_mm, std::int32_t known, std::int32_t swept) {
    return sk_histogram_insert(h.get(), known, swept, rules.get(), 50, 50, z_mm, now_us);
  };
  EXPECT_FALSE(departs(445, as_high, as_high));
  EXPECT_EQ(h->observed[50][50], 0U) << "nor is what the lines are too low for counted";
  EXPECT_TRUE(departs(445, as_high, SK_NOBODY_KNOWS));
  EXPECT_TRUE(departs(445, lower, lower)) << "higher than is known by a rise";
  EXPECT_TRUE(departs(600 + kHeightThreshold + 1, as_high, as_high));
  see(50, 50, -700, SK_HISTOGRAM_ENOUGH);
  EXPECT_FALSE(departs(445, as_high, SK_NOBODY_KNOWS)) << "points of its own, and few";
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

// All that can be said of a cell, of either.
void expect_same(const sk_monitor_histogram& h, const ReferenceHistogram& reference, int iy, int ix, int turn) {
  const ReferenceHistogram::Cell c = reference.cell({iy, ix});
  const int states[] = {SK_CELL_LEARNING, SK_CELL_CLEAR, SK_CELL_SOMEBODY};
  ASSERT_EQ(h.state[iy][ix], states[static_cast<int>(c.state)]) << turn << ": " << iy << " " << ix;
  ASSERT_EQ(h.observed[iy][ix], static_cast<std::uint32_t>(c.observed)) << turn;
  for (std::size_t back = 0; back < 2; ++back)
    ASSERT_EQ(h.departed_us[iy][ix][back], back < c.departed.size() ? c.departed[c.departed.size() - 1 - back] : -1) << turn << ": " << back;
  ASSERT_EQ(h.ground_us[iy][ix], c.ground < 0 ? SK_NO_GROUND : static_cast<std::uint64_t>(c.ground)) << turn;
  ASSERT_EQ(h.lines[iy][ix], c.votes) << turn;
  ASSERT_EQ(h.line_mm[iy][ix], c.line) << turn;
  for (int b = 0; b < SK_HISTOGRAM_BINS; ++b) {
    const auto found = c.seen.find(b);
    ASSERT_EQ(h.seen[iy][ix][b], found == c.seen.end() ? 0 : found->second) << turn << ": bin " << b;
  }
}

bool lower_half(ReferenceHistogram::Place at) { return at.first < 52; }

// verifies: SK-WM-60, SK-WM-61, SK-WM-62, SK-WM-63, SK-WM-64, SK-WM-65, SK-WM-67, SK-WM-68, SK-WM-71, SK-WM-72
TEST_F(MonitorHistogram, RandomSequencesAreAsTheReferenceHasThem) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  std::mt19937_64 random(kSeed);
  const auto below = [&random](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto others = std::make_unique<sk_monitor_histogram>();
  int departed = 0, stops = 0, left = 0, passed = 0;
  for (int sequence = 0; sequence < 30; ++sequence) {
    ReferenceHistogram reference, reference_of_others;
    sk_histogram_begin(h.get());
    sk_histogram_begin(others.get());
    now_us = below(1'000'000);
    rules->height_threshold_mm = 100 + below(900);
    rules->wait_us = sequence % 5 == 0 ? 0 : below(400'000);
    rules->period_us = 1 + below(100'000);
    rules->dwell_us = below(500'000);
    for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (int ix = 0; ix < SK_MAP_CELLS; ++ix) rules->watched[iy][ix] = lower_half({iy, ix}) ? 1 : 0;
    const ReferenceRules r{rules->height_threshold_mm, rules->wait_us, rules->period_us, rules->dwell_us};
    const int corner = sequence % 3 == 0 ? -1 : 50;  // at the map's border too
    for (int turn = 0; turn < 6000; ++turn) {
      const int iy = corner + below(4), ix = corner + below(4), what = below(1000);
      now_us += below(20) == 0 ? below(200'000) : below(2000);
      if (below(500) == 0) now_us -= below(300'000);
      if (now_us < 0) now_us = 0;
      const bool was = sk_is_in_map(iy, ix) && somebody(iy, ix);
      if (what < 2) {
        const std::int32_t x = SK_MAP_ORIGIN_MM + SK_CELL_MM * ix + below(500), y = SK_MAP_ORIGIN_MM + SK_CELL_MM * iy + below(500);
        sk_histogram_forget(h.get(), x, y, x + 200, y + 400);
        reference.forget(x, y, x + 200, y + 400);
      } else if (what < 6) {
        const std::int32_t x = SK_MAP_ORIGIN_MM + SK_CELL_MM * ix, y = SK_MAP_ORIGIN_MM + SK_CELL_MM * iy;
        sk_histogram_settle(h.get(), x - 600, y - 600, x + 600, y + 600);
        reference.settle(x - 600, y - 600, x + 600, y + 600);
      } else if (what < 40) {
        const std::int32_t z = below(3) > 0 ? below(200) : below(2000) - 500;
        sk_histogram_line(h.get(), iy, ix, z);
        reference.line({iy, ix}, z);
      } else if (what < 100) {
        const std::int32_t z = below(20) > 0 ? below(2500) - 500 : std::numeric_limits<std::int32_t>::max() - below(2);
        sk_histogram_beside(h.get(), iy, ix, z);
        reference.beside({iy, ix}, z);
      } else if (what < 300) {
        const std::int32_t z = below(5) > 0 ? below(400) : below(2500) - 500;
        const std::int64_t at_us = below(50) == 0 ? -1 : now_us;
        sk_histogram_pass(h.get(), sk_histogram_known(others.get(), iy, ix), rules.get(), iy, ix, z, at_us);
        reference.pass(r, reference_of_others, {iy, ix}, z, at_us);
        passed += was && !somebody(iy, ix) ? 1 : 0;
      } else {
        std::int32_t z = below(300);
        if (below(30) == 0) z = 500 + below(1500);
        if (below(300) == 0) z = below(2) == 0 ? -6000 : 7000;
        if (below(3000) == 0) z = below(2) == 0 ? std::numeric_limits<std::int32_t>::min() : std::numeric_limits<std::int32_t>::max();
        if (sequence % 2 == 0 && below(3) == 0) {  // what the others see
          sk_histogram_insert(others.get(), SK_NOBODY_KNOWS, SK_NOBODY_KNOWS, rules.get(), iy, ix, z, now_us);
          reference_of_others.insert(r, reference_of_others, false, {iy, ix}, z, now_us);
          continue;
        }
        if (below(20) == 0) {
          sk_histogram_settle(others.get(), kLow, kLow, kHigh, kHigh);
          reference_of_others.settle(kLow, kLow, kHigh, kHigh);
        }
        const std::int32_t known = sk_histogram_known(others.get(), iy, ix);
        const bool yields = below(2) == 0;
        const bool departs = sk_histogram_insert(h.get(), known, yields ? known : SK_NOBODY_KNOWS, rules.get(), iy, ix, z, now_us);
        ASSERT_EQ(departs, reference.insert(r, reference_of_others, yields, {iy, ix}, z, now_us)) << sequence << " " << turn << ": " << z << " mm";
        departed += departs ? 1 : 0;
        left += was && !somebody(iy, ix) ? 1 : 0;
      }
      if (sk_is_in_map(iy, ix)) expect_same(*h, reference, iy, ix, turn);
      if (HasFatalFailure()) return;
      if (turn % 7 != 0) continue;
      ReferenceHistogram::Place expected;
      const bool stop = reference.step(r, lower_half, now_us, expected);
      ASSERT_EQ(step(), stop) << sequence << " " << turn;
      ASSERT_EQ(where.iy, expected.first);
      ASSERT_EQ(where.ix, expected.second);
      stops += stop ? 1 : 0;
    }
    for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (int ix = 0; ix < SK_MAP_CELLS; ++ix) expect_same(*h, reference, iy, ix, -1);
  }
  std::printf("%d points departed, %d steps said stop, %d times somebody left, %d times more by what passed\n", departed, stops, left, passed);
  EXPECT_GT(departed, 1000);
  EXPECT_GT(stops, 100);
  EXPECT_GT(left, 10);
  EXPECT_GT(passed, 3);
}

}  // namespace
}  // namespace berm::core_test
