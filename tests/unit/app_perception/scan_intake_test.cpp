#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "app_bench/bench_machine.hpp"
#include "perception/scan_intake.hpp"

namespace {

using namespace berm::app;

struct Segment {
  Segment() : at(std::make_unique<berm_state_segment>()) { std::memset(static_cast<void*>(at.get()), 0, sizeof *at); }
  void block(std::int32_t x_mm, std::uint8_t used) {
    const std::uint32_t n = at->scan_head;
    berm_scan_block& b = at->scan[n % BERM_SCAN_RING];
    b = {};
    b.count = 1;
    b.used[0] = used;
    b.point_mm[0][0] = x_mm;
    b.point_mm[0][2] = -500;
    b.time_us = 1000000;
    b.sequence = 2 * n + 2;
    at->scan_head = n + 1;
  }
  std::unique_ptr<berm_state_segment> at;
};

TEST(ScanIntake, TakesEachBlockOnceAndOnlyUsedPoints) {
  Segment s;
  TerrainMap terrain;
  BedMap bed(berm::app_bench::bench_bed());
  TruckSweep sweep;
  ScanIntake intake;
  s.block(5000, 1);
  s.block(6000, 0);
  EXPECT_EQ(intake.take(*s.at, terrain, &bed, sweep), 1);
  EXPECT_EQ(intake.take(*s.at, terrain, &bed, sweep), 0);
  EXPECT_EQ(terrain.height(5.0, 0.0), -0.5);
  EXPECT_FALSE(terrain.height(6.0, 0.0));
}

TEST(ScanIntake, ATornBlockIsLeftOut) {
  Segment s;
  TerrainMap terrain;
  BedMap bed(berm::app_bench::bench_bed());
  TruckSweep sweep;
  ScanIntake intake;
  s.block(5000, 1);
  s.at->scan[0].sequence = 1;  // being written
  EXPECT_EQ(intake.take(*s.at, terrain, &bed, sweep), 0);
  EXPECT_EQ(intake.blocks_missed(), 1u);
  EXPECT_FALSE(terrain.height(5.0, 0.0));
}

TEST(ScanIntake, CountsWhatWasOverwritten) {
  Segment s;
  TerrainMap terrain;
  BedMap bed(berm::app_bench::bench_bed());
  TruckSweep sweep;
  ScanIntake intake;
  s.block(5000, 1);
  intake.take(*s.at, terrain, &bed, sweep);
  for (int i = 0; i < BERM_SCAN_RING + 10; ++i) s.block(5000, 1);
  EXPECT_EQ(intake.take(*s.at, terrain, &bed, sweep), BERM_SCAN_RING);
  EXPECT_EQ(intake.blocks_missed(), 10u);
}

TEST(ScanIntake, ACountBeyondTheBlockIsCut) {
  Segment s;
  TerrainMap terrain;
  BedMap bed(berm::app_bench::bench_bed());
  TruckSweep sweep;
  ScanIntake intake;
  s.block(5000, 1);
  s.at->scan[0].count = 65535;
  EXPECT_EQ(intake.take(*s.at, terrain, &bed, sweep), 1);
}

}  // namespace
