// From scan packets to the map: chains across packets, spurious returns at packet borders, own returns, stale and replayed packets.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>

#include "io/scan_intake.hpp"
#include "mini_machine.hpp"

namespace berm::kernel {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::int64_t kNow = 1000000;

class ScanIntakeTest : public ::testing::Test {
 protected:
  void SetUp() override {
    sk_map_clear(map.get());
    const std::int32_t pose[4] = {0, 870000, -1570000, -700000};
    joints.push(kNow - 30000, pose);
    joints.push(kNow + 100000, pose);
  }

  // Samples of one scanline of the left scanner looking forward-left at this pan, on flat ground.
  berm_scan_packet ground(int first, int count, std::uint32_t sequence, std::uint32_t scanline = 1) const {
    berm_scan_packet p{};
    p.sequence = sequence;
    p.scanline = scanline;
    p.time_us = static_cast<std::uint64_t>(kNow - 10000);
    p.sample_period_ns = 83333;
    p.pan_start_urad = p.pan_end_urad = 600000;
    p.first_index = static_cast<std::uint16_t>(first);
    p.samples_per_revolution = 400;
    p.count = static_cast<std::uint16_t>(count);
    p.echoes_per_sample = 1;
    p.window_percent = 100;
    const double head = parameters.scanner[0].z_mm;
    for (int i = 0; i < count; ++i) {
      const double down = -std::sin(2 * kPi * (first + i) / 400);
      p.range[i][0] = down > 0.12 ? static_cast<std::uint16_t>(std::lround(head / down / BERM_SCAN_RANGE_LSB_MM)) : std::uint16_t{0};
    }
    return p;
  }
  bool take(const berm_scan_packet& p) { return intake.take(p, joints, kNow, *map, *blocks); }
  int observed() const {
    int count = 0;
    for (const auto& row : map->seen_us)
      for (const auto seen : row) count += seen >= 0 ? 1 : 0;
    return count;
  }

  berm_parameters parameters = berm::test::demo_parameters();
  ScanIntake intake{parameters};
  JointHistory joints;
  std::unique_ptr<sk_height_map> map = std::make_unique<sk_height_map>();
  std::unique_ptr<ScanBlocks> blocks = std::make_unique<ScanBlocks>();
};

// verifies: SK-CY-100
TEST_F(ScanIntakeTest, APacketWaitsForTheNextOfItsScanline) {
  ASSERT_TRUE(take(ground(320, 30, 1)));
  EXPECT_EQ(blocks->count, 0);
  ASSERT_TRUE(take(ground(350, 20, 2)));
  ASSERT_EQ(blocks->count, 1);
  EXPECT_EQ(blocks->block[0].first_index, 320);
  intake.flush(joints, kNow + ScanIntake::kWaitUs, *map, *blocks);
  EXPECT_EQ(blocks->count, 2);
}

// verifies: SK-CY-100
TEST_F(ScanIntakeTest, SplittingAScanlineIntoPacketsChangesNothing) {
  auto whole = std::make_unique<sk_height_map>();
  sk_map_clear(whole.get());
  ScanIntake other(parameters);
  berm_scan_packet line = ground(310, 80, 1);
  line.range[40][0] = static_cast<std::uint16_t>(line.range[40][0] / 2);  // a spurious one at a border
  for (const int border : {24, 48})  // and two in a row, one on each side
    for (const int i : {border - 1, border}) line.range[i][0] = static_cast<std::uint16_t>(line.range[i][0] * ((i < border) == (border == 24) ? 5 : 7) / 10);
  line.range[60][0] = 0;
  line.flags = BERM_SCAN_FLAG_LAST;
  ASSERT_TRUE(other.take(line, joints, kNow, *whole, *blocks));
  std::uint32_t sequence = 1;
  for (int first = 0; first < 80; first += 8) {
    berm_scan_packet part = line;
    part.sequence = sequence++;
    part.first_index = static_cast<std::uint16_t>(310 + first);
    part.count = 8;
    part.flags = first == 72 ? BERM_SCAN_FLAG_LAST : 0;
    std::memcpy(part.range, line.range[first], 8 * sizeof part.range[0]);
    ASSERT_TRUE(take(part));
  }
  EXPECT_EQ(std::memcmp(whole->height_mm, map->height_mm, sizeof map->height_mm), 0);
  EXPECT_EQ(std::memcmp(whole->seen_us, map->seen_us, sizeof map->seen_us), 0);
  EXPECT_EQ(other.points(), intake.points());
  EXPECT_GT(intake.points(), 50U);
  EXPECT_LT(intake.points(), 75U) << "the spurious and the missing one are not in it, nor far ground at a grazing angle";
}

// verifies: SK-CY-101
TEST_F(ScanIntakeTest, ALostPacketBreaksTheChain) {
  // two packets far apart on the ground; the cells between them were never seen
  ASSERT_TRUE(take(ground(330, 8, 1)));
  ASSERT_TRUE(take(ground(372, 8, 3)));
  intake.flush(joints, kNow + ScanIntake::kWaitUs, *map, *blocks);
  const int apart = observed();
  sk_map_clear(map.get());
  ScanIntake fresh(parameters);
  berm_scan_packet line = ground(330, 50, 1);
  line.flags = BERM_SCAN_FLAG_LAST;
  ASSERT_TRUE(fresh.take(line, joints, kNow, *map, *blocks));
  EXPECT_GT(observed(), apart + 5);
}

// Looking over the ground's edge: far ground, one return in the air, and noise just before the window.
// verifies: SK-GE-23
TEST_F(ScanIntakeTest, AReturnNearerThanTheLeastRangeSupportsNoOther) {
  for (const std::uint32_t near_mm : {0U, 300U, static_cast<std::uint32_t>(parameters.range_min_mm) - BERM_SCAN_RANGE_LSB_MM, 12000U}) {
    ScanIntake fresh(parameters);
    berm_scan_packet p = ground(380, 15, 1);
    p.flags = BERM_SCAN_FLAG_LAST;
    for (int i = 0; i < p.count; ++i) p.range[i][0] = static_cast<std::uint16_t>((i < 8 ? 14000 + 1000 * i : 0) / BERM_SCAN_RANGE_LSB_MM);
    p.range[8][0] = 16500 / BERM_SCAN_RANGE_LSB_MM;
    p.range[9][0] = static_cast<std::uint16_t>(near_mm / BERM_SCAN_RANGE_LSB_MM);
    blocks->count = 0;
    ASSERT_TRUE(fresh.take(p, joints, kNow, *map, *blocks));
    ASSERT_EQ(blocks->count, 1);
    EXPECT_EQ(blocks->block[0].used[8], near_mm == 12000U ? 1 : 0) << near_mm;
  }
}

// verifies: SK-CY-102
TEST_F(ScanIntakeTest, OwnReturnsDoNotEnterTheMap) {
  berm_scan_packet p = ground(330, 40, 1);
  p.flags = BERM_SCAN_FLAG_LAST;
  for (int i = 0; i < 40; ++i) p.range[i][0] = 1000 / BERM_SCAN_RANGE_LSB_MM;  // 1 m: on the own body
  ASSERT_TRUE(take(p));
  EXPECT_EQ(observed(), 0);
  EXPECT_EQ(intake.points(), 0U);
  ASSERT_EQ(blocks->count, 1);
  EXPECT_EQ(blocks->block[0].used[5], 0);
  EXPECT_EQ(blocks->block[0].range_mm[5], 1000U);
}

// The sweep before found a thing in every cell, this one only ground.
// verifies: SK-CY-105
TEST_F(ScanIntakeTest, WhatTheOwnReturnsHideKeepsItsHeight) {
  constexpr std::int32_t thing_mm = 1500;
  for (const bool own : {false, true}) {
    for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
        map->height_mm[iy][ix] = 0;
        map->previous_mm[iy][ix] = thing_mm;
        map->began_us[iy][ix] = map->seen_us[iy][ix] = kNow;
      }
    ScanIntake fresh(parameters);
    berm_scan_packet p = ground(330, 40, 1);
    p.flags = BERM_SCAN_FLAG_LAST;
    for (int i = 0; i < 40; ++i) p.range[i][0] = own ? 1000 / BERM_SCAN_RANGE_LSB_MM : 0;
    ASSERT_TRUE(fresh.take(p, joints, kNow, *map, *blocks));
    int kept = 0, near = 0;
    for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
        if (map->height_mm[iy][ix] != thing_mm) continue;
        ++kept;
        const double x = SK_MAP_ORIGIN_MM + SK_CELL_MM * (ix + 0.5), y = SK_MAP_ORIGIN_MM + SK_CELL_MM * (iy + 0.5);
        near += std::hypot(x - parameters.scanner[0].x_mm, y - parameters.scanner[0].y_mm) < 1000 - SK_CELL_MM ? 1 : 0;
      }
    EXPECT_EQ(kept > 20, own) << kept;
    EXPECT_EQ(kept == 0, !own) << kept;
    EXPECT_EQ(near, 0) << "before the return nothing is hidden";
  }
}

// verifies: SK-CY-103, IF-SC-11 (a packet of another time than the kernel's clock has is refused)
TEST_F(ScanIntakeTest, ReplayedLateAndDirtyPacketsAreRefused) {
  ASSERT_TRUE(take(ground(320, 20, 10)));
  EXPECT_FALSE(take(ground(340, 20, 10)));
  EXPECT_FALSE(take(ground(340, 20, 9)));
  berm_scan_packet late = ground(340, 20, 11);
  late.time_us = static_cast<std::uint64_t>(kNow - ScanHealth::kAgeMaxUs - 1);
  EXPECT_FALSE(take(late));
  berm_scan_packet early = ground(340, 20, 11);
  early.time_us = static_cast<std::uint64_t>(kNow + ScanHealth::kFutureMaxUs + 1);
  EXPECT_FALSE(take(early));
  for (const int flag : {BERM_SCAN_FLAG_WINDOW_DIRTY, BERM_SCAN_FLAG_HEAD_FAULT}) {
    berm_scan_packet bad = ground(340, 20, 11);
    bad.flags = static_cast<std::uint16_t>(flag);
    EXPECT_FALSE(take(bad));
  }
  EXPECT_TRUE(take(ground(340, 20, 11)));
}

// verifies: IF-SC-10
TEST_F(ScanIntakeTest, APacketOfADirtyWindowOrAFaultyHeadIsNoSignOfLife) {
  for (std::uint8_t scanner = 0; scanner < 2; ++scanner) {
    berm_scan_packet good = ground(320, 20, 1);
    good.scanner = scanner;
    ASSERT_TRUE(take(good));
  }
  intake.flush(joints, kNow + ScanIntake::kWaitUs, *map, *blocks);
  const int seen = observed();
  for (const int flag : {BERM_SCAN_FLAG_WINDOW_DIRTY, BERM_SCAN_FLAG_HEAD_FAULT}) {
    berm_scan_packet bad = ground(340, 20, flag == BERM_SCAN_FLAG_WINDOW_DIRTY ? 2 : 3);
    bad.flags = static_cast<std::uint16_t>(flag);
    EXPECT_FALSE(intake.take(bad, joints, kNow + 50000, *map, *blocks));
  }
  intake.flush(joints, kNow + 50000 + ScanIntake::kWaitUs, *map, *blocks);
  EXPECT_EQ(observed(), seen) << "nor are its ranges used";
  EXPECT_TRUE(intake.health().silent(kNow + 200001, 200000)) << "not heard since the good ones";
}

// verifies: SK-CY-16
TEST_F(ScanIntakeTest, SilenceCountsOnceBothScannersWereHeard) {
  ASSERT_TRUE(take(ground(320, 20, 1)));
  EXPECT_FALSE(intake.health().silent(kNow + 10000000, 200000));
  berm_scan_packet right = ground(320, 20, 1);
  right.scanner = 1;
  ASSERT_TRUE(take(right));
  EXPECT_FALSE(intake.health().silent(kNow + 200000, 200000));
  EXPECT_TRUE(intake.health().silent(kNow + 200001, 200000));
}

}  // namespace
}  // namespace berm::kernel
