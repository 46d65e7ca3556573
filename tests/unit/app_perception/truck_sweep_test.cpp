#include <gtest/gtest.h>

#include "perception/truck_sweep.hpp"

namespace {

using namespace berm::app;

berm_scan_block block(std::uint8_t scanner, std::uint32_t scanline, int samples) {
  berm_scan_block b{};
  b.scanner = scanner;
  b.scanline = scanline;
  b.count = static_cast<std::uint16_t>(samples);
  b.time_us = 2'000'000;
  b.sample_period_ns = 100'000;
  for (int i = 0; i < samples && i < BERM_SCAN_BLOCK_SAMPLES; ++i) {
    b.used[i] = 1;
    b.echoes[i] = 1;
    b.point_mm[i][0] = 1000 + i;
    b.point_mm[i][2] = -500;
  }
  return b;
}

TEST(TruckSweep, KeepsWhatOneScannerSawWhileItIsRecorded) {
  TruckSweep sweep;
  sweep.take(block(0, 1, 5));
  EXPECT_TRUE(sweep.points().empty());
  sweep.begin(0);
  sweep.take(block(1, 1, 5));
  EXPECT_TRUE(sweep.points().empty()) << "of the other scanner";
  sweep.take(block(0, 7, 5));
  sweep.end();
  sweep.take(block(0, 8, 5));
  ASSERT_EQ(sweep.points().size(), 5u);
  EXPECT_FLOAT_EQ(sweep.points()[3].x, 1.003F);
  EXPECT_FLOAT_EQ(sweep.points()[3].z, -0.5F);
  EXPECT_NEAR(sweep.points()[3].time_s, 2.0003, 1e-9);
  sweep.begin(1);
  EXPECT_TRUE(sweep.points().empty());
}

TEST(TruckSweep, LeavesOutWhatTheKernelDidNotTakeForGround) {
  TruckSweep sweep;
  sweep.begin(0);
  berm_scan_block b = block(0, 1, 3);
  b.used[1] = 0;
  sweep.take(b);
  ASSERT_EQ(sweep.points().size(), 2u);
  EXPECT_FLOAT_EQ(sweep.points()[1].x, 1.002F);
}

TEST(TruckSweep, NumbersScanlinesFromNoughtAlsoWhereTheirNumbersWrap) {
  TruckSweep sweep;
  sweep.begin(0);
  for (const std::uint32_t line : {0xFFFFFFFEu, 0xFFFFFFFEu, 0xFFFFFFFFu, 0u, 2u}) sweep.take(block(0, line, 1));
  std::vector<std::uint32_t> lines;
  for (const ScanPoint& p : sweep.points()) lines.push_back(p.scanline);
  EXPECT_EQ(lines, (std::vector<std::uint32_t>{0, 0, 1, 2, 3}));
}

TEST(TruckSweep, TellsTheShareOfReturnsWithSeveralEchoes) {
  TruckSweep sweep;
  sweep.begin(0);
  EXPECT_EQ(sweep.several_echoes(), 0.0);
  berm_scan_block b = block(0, 1, 4);
  b.echoes[0] = 2;
  b.echoes[3] = 0;
  sweep.take(b);
  EXPECT_NEAR(sweep.several_echoes(), 1.0 / 3.0, 1e-12);
}

TEST(TruckSweep, ACountBeyondTheBlockIsCutAndSoIsASweepWithoutEnd) {
  TruckSweep sweep;
  sweep.begin(0);
  berm_scan_block b = block(0, 1, BERM_SCAN_BLOCK_SAMPLES);
  b.count = 65535;
  sweep.take(b);
  EXPECT_EQ(sweep.points().size(), static_cast<std::size_t>(BERM_SCAN_BLOCK_SAMPLES));
  for (int i = 0; i < 3000; ++i) sweep.take(b);
  EXPECT_EQ(sweep.points().size(), TruckSweep::most_points);
}

}  // namespace
