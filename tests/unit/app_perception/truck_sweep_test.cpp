#include <gtest/gtest.h>

#include "perception/truck_sweep.hpp"

namespace {

using namespace berm::app;

ScanlinePart part(std::size_t scanner, std::uint32_t scanline, int samples) {
  ScanlinePart p;
  p.scanner = scanner;
  p.scanline = scanline;
  p.count = samples;
  for (int i = 0; i < samples; ++i) {
    ScanReturn& s = p.sample[static_cast<std::size_t>(i)];
    s.range = 5.0;
    s.x = 1.0 + 0.001 * i;
    s.z = -0.5;
    s.time_s = 2.0 + 0.0001 * i;
  }
  return p;
}

TEST(TruckSweep, KeepsWhatOneScannerSawWhileItIsRecorded) {
  TruckSweep sweep;
  sweep.take(part(0, 1, 5));
  EXPECT_TRUE(sweep.points().empty());
  sweep.begin(0);
  sweep.take(part(1, 1, 5));
  EXPECT_TRUE(sweep.points().empty()) << "of the other scanner";
  sweep.take(part(0, 7, 5));
  sweep.end();
  sweep.take(part(0, 8, 5));
  ASSERT_EQ(sweep.points().size(), 5u);
  EXPECT_FLOAT_EQ(sweep.points()[3].x, 1.003F);
  EXPECT_FLOAT_EQ(sweep.points()[3].z, -0.5F);
  EXPECT_NEAR(sweep.points()[3].time_s, 2.0003, 1e-9);
  sweep.begin(1);
  EXPECT_TRUE(sweep.points().empty());
}

TEST(TruckSweep, LeavesOutTheMachineItselfAndWhatHangsInTheAir) {
  TruckSweep sweep;
  sweep.begin(0);
  ScanlinePart p = part(0, 1, 4);
  p.sample[0].own = true;
  p.sample[1].lone = true;
  p.sample[2].range = 0.0;
  sweep.take(p);
  ASSERT_EQ(sweep.points().size(), 1u);
  EXPECT_FLOAT_EQ(sweep.points()[0].x, 1.003F);
}

TEST(TruckSweep, NumbersScanlinesFromNoughtAlsoWhereTheirNumbersWrap) {
  TruckSweep sweep;
  sweep.begin(0);
  for (const std::uint32_t line : {0xFFFFFFFEu, 0xFFFFFFFEu, 0xFFFFFFFFu, 0u, 2u}) sweep.take(part(0, line, 1));
  std::vector<std::uint32_t> lines;
  for (const ScanPoint& p : sweep.points()) lines.push_back(p.scanline);
  EXPECT_EQ(lines, (std::vector<std::uint32_t>{0, 0, 1, 2, 3}));
}

TEST(TruckSweep, KeepsReturnsWithSeveralEchoesAndTellsTheirShare) {
  TruckSweep sweep;
  sweep.begin(0);
  EXPECT_EQ(sweep.several_echoes(), 0.0);
  ScanlinePart p = part(0, 1, 4);
  p.sample[1].several_echoes = true;
  p.sample[3].range = 0.0;
  sweep.take(p);
  EXPECT_NEAR(sweep.several_echoes(), 1.0 / 3.0, 1e-12);
  ASSERT_EQ(sweep.points().size(), 3u);
  EXPECT_FALSE(sweep.flagged(0));
  EXPECT_TRUE(sweep.flagged(1));
}

TEST(TruckSweep, AScanlineIsWholeWhenItsTurnEndsOrTheNextBegins) {
  TruckSweep sweep;
  sweep.begin(0);
  ScanlinePart first = part(0, 1, 5), rest = part(0, 1, 3);
  first.samples_per_revolution = rest.samples_per_revolution = 8;
  rest.first_index = 5;
  sweep.take(first);
  EXPECT_EQ(sweep.whole(), 0u);
  sweep.take(rest);
  EXPECT_EQ(sweep.whole(), 8u) << "its turn has ended";
  first.scanline = 2;
  sweep.take(first);
  EXPECT_EQ(sweep.whole(), 8u);
  first.scanline = 3;
  sweep.take(first);
  EXPECT_EQ(sweep.whole(), 13u) << "a block of it was lost, but the next has begun";
  sweep.end();
  EXPECT_EQ(sweep.whole(), 18u);
}

TEST(TruckSweep, KnowsWhereTheMachineStoodForEachScanline) {
  TruckSweep sweep;
  sweep.begin(0);
  for (const auto& [line, swing] : {std::pair{5u, 0.30}, {5u, 0.29}, {6u, 0.28}, {7u, 0.25}}) {
    ScanlinePart p = part(0, line, line == 6u ? 0 : 2);
    p.swing = swing;
    sweep.take(p);
  }
  ASSERT_EQ(sweep.points().size(), 6u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(sweep.swing_of(sweep.points()[i]), 0.30);
  for (std::size_t i = 4; i < 6; ++i) EXPECT_EQ(sweep.swing_of(sweep.points()[i]), 0.25) << "the one before is empty";
}

TEST(TruckSweep, ASweepWithoutEndIsCut) {
  TruckSweep sweep;
  sweep.begin(0);
  const ScanlinePart p = part(0, 1, BERM_SCAN_BLOCK_SAMPLES);
  for (int i = 0; i < 3000; ++i) sweep.take(p);
  EXPECT_EQ(sweep.points().size(), TruckSweep::most_points);
}

}  // namespace
