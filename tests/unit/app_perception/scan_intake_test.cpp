#include <gtest/gtest.h>

#include <random>

#include "app_bench/bench_machine.hpp"
#include "drawn_scan.hpp"
#include "perception/scan_intake.hpp"

namespace {

using namespace berm::app;

// Both scanners look straight ahead; the segment's machine stands.
struct Bench {
  Bench() : machine(berm::app_bench::zx200()), intake(machine), bed(berm::app_bench::bench_bed()) { segment.run_to(2.05); }

  int take() { return intake.take(*segment.at, terrain, &bed, sweep); }

  // A whole turn's end down to straight ahead, over ground at this height; at time_us.
  berm_scan_block ground(double z, std::uint32_t scanline, std::int64_t time_us) const {
    berm_scan_block b = drawn::block(0, scanline, 40);
    b.first_index = 360;
    b.time_us = time_us;
    for (int i = 0; i < 40; ++i) {
      const double down = 2.0 * std::numbers::pi * (40 - i) / 400.0;
      b.range_mm[i] = static_cast<std::uint32_t>(std::lround(1e3 * (machine.scanner[0].z - z) / std::sin(down)));
    }
    return b;
  }

  drawn::Segment segment;
  MachineModel machine;
  ScanIntake intake;
  TerrainMap terrain;
  BedMap bed;
  TruckSweep sweep;
};

constexpr double ahead_x = 8.0, ahead_y = 1.35;  // under the left scanner's beam

TEST(ScanIntake, TakesEachBlockOnce) {
  Bench b;
  b.segment.publish(b.ground(-1.0, 1, 2'000'000));
  EXPECT_GT(b.take(), 20);
  EXPECT_EQ(b.take(), 0);
  ASSERT_TRUE(b.terrain.height(ahead_x, ahead_y));
  EXPECT_NEAR(*b.terrain.height(ahead_x, ahead_y), -1.0, 0.01);
  EXPECT_FALSE(b.terrain.height(ahead_x, -5.0));
}

TEST(ScanIntake, ABlockWaitsForTheStateAfterIt) {
  Bench b;
  b.segment.publish(b.ground(-1.0, 1, 2'060'000));
  b.segment.publish(b.ground(-1.0, 2, 2'020'000));
  EXPECT_EQ(b.take(), 0);
  b.segment.run_to(2.07);
  EXPECT_GT(b.take(), 20);
  EXPECT_EQ(b.intake.counts().blocks_refused, 0u);
}

// verifies: IF-CT-15 (a reader: a block that is being written)
TEST(ScanIntake, ATornBlockIsLeftOut) {
  Bench b;
  b.segment.publish(b.ground(-1.0, 1, 2'000'000));
  b.segment.at->scan[0].sequence = 1;  // being written
  EXPECT_EQ(b.take(), 0);
  EXPECT_EQ(b.intake.counts().blocks_missed, 1u);
}

// verifies: IF-CT-15 (a reader: what was overwritten)
TEST(ScanIntake, CountsWhatWasOverwritten) {
  Bench b;
  b.segment.publish(b.ground(-1.0, 1, 2'000'000));
  b.take();
  for (std::uint32_t i = 0; i < BERM_SCAN_RING + 10; ++i) b.segment.publish(b.ground(-1.0, 2 + i, 2'000'000));
  EXPECT_GT(b.take(), 20 * BERM_SCAN_RING);
  EXPECT_EQ(b.intake.counts().blocks_missed, 10u);
}

// Whatever stands in the segment: nothing of a malformed block comes into the maps, and those after it do.
TEST(ScanIntake, AMalformedBlockIsRefusedAndTheNextTaken) {
  Bench b;
  berm_scan_block many = b.ground(5.0, 1, 2'000'000), beyond = b.ground(5.0, 2, 900'000'000'000), before = b.ground(5.0, 3, -5);
  many.count = 65535;
  b.segment.publish(many);
  b.segment.publish(beyond);
  b.segment.publish(before);
  b.segment.publish(b.ground(-1.0, 4, 2'000'000));
  EXPECT_GT(b.take(), 20);
  EXPECT_EQ(b.intake.counts().blocks_refused, 3u);
  EXPECT_NEAR(*b.terrain.height(ahead_x, ahead_y), -1.0, 0.01);
}

TEST(ScanIntake, RandomBytesDoNoHarm) {
  std::mt19937_64 random(17);
  Bench b;
  for (int k = 0; k < 2000; ++k) {
    berm_scan_block block = b.ground(-1.0, static_cast<std::uint32_t>(k), 2'000'000);
    auto* bytes = reinterpret_cast<unsigned char*>(&block);
    for (int n = 0; n < 1 + k % 40; ++n) bytes[random() % (k % 2 == 0 ? 40 : sizeof block)] = static_cast<unsigned char>(random());
    b.segment.publish(block);
    b.take();
  }
  for (double x = -14.9; x < 15.0; x += 0.2)
    for (double y = -14.9; y < 15.0; y += 0.2)
      if (const auto z = b.terrain.height(x, y)) {
        EXPECT_TRUE(std::isfinite(*z));
      }
  EXPECT_GT(b.intake.counts().blocks_refused, 100u);
  EXPECT_GT(b.intake.counts().returns, 1000u);
}

TEST(ScanIntake, DustBeforeTheGroundComesIntoNoMap) {
  Bench b;
  b.segment.publish(b.ground(-1.0, 1, 2'000'000));
  b.take();
  b.segment.run_to(3.0);
  berm_scan_block dusty = b.ground(-1.0, 2, 2'990'000);
  int put = 0;
  for (int i = 5; i < 40; i += 8, ++put) dusty.range_mm[i] /= 2;  // lone, in the air
  b.segment.publish(dusty);
  b.take();
  EXPECT_GE(b.intake.counts().flagged, static_cast<std::uint64_t>(put));
  b.segment.run_to(6.0);  // nor where it is there again, as noise beside a bucket that stands
  dusty.scanline = 80;
  dusty.time_us = 5'990'000;
  b.segment.publish(dusty);
  b.take();
  EXPECT_EQ(b.intake.counts().confirmed, 0u);
  for (double x = 3.0; x < 14.0; x += 0.2)
    if (const auto z = b.terrain.height(x, ahead_y)) {
      EXPECT_NEAR(*z, -1.0, 0.01) << x;
    }
}

// Ground that is seen through dust by every beam: its second sweep brings it into the map, and not the first.
TEST(ScanIntake, GroundBehindDustIsBelievedAtItsSecondSweep) {
  Bench b;
  const auto dusty = [&](std::uint32_t scanline, std::int64_t time_us) {
    berm_scan_block block = b.ground(-1.0, scanline, time_us);
    std::fill_n(block.echoes, 40, std::uint8_t{2});
    return block;
  };
  b.segment.publish(dusty(1, 2'000'000));
  EXPECT_EQ(b.take(), 0);
  EXPECT_FALSE(b.terrain.height(ahead_x, ahead_y));
  b.segment.run_to(5.0);
  b.segment.publish(dusty(90, 4'990'000));
  EXPECT_GT(b.take(), 5);
  ASSERT_TRUE(b.terrain.height(ahead_x, ahead_y));
  EXPECT_NEAR(*b.terrain.height(ahead_x, ahead_y), -1.0, 0.01);
}

}  // namespace
