// What counts as a look at a sector, and how long the Workspace Monitor takes to tell of somebody.
#include "io/sector_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "io/workspace_watch.hpp"
#include "mini_machine.hpp"

namespace berm::kernel::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::int64_t kNow = 5'000'000;

class SectorWatchTest : public testing::Test {
 protected:
  SectorWatchTest() {
    parameters.workspace_watched = 1;
    parameters.workspace_separation = BERM_SEPARATION_REPORTED;
    parameters.dig_zones = parameters.truck_zones = parameters.lanes = 0;
    begin();
  }
  void begin() { watch = std::make_unique<SectorWatch>(parameters); }
  std::int64_t seen(int sector) const { return watch->sectors().sector[sector].seen_us; }
  int sectors_seen() const {
    const sk_sector* all = watch->sectors().sector;
    return static_cast<int>(std::count_if(all, all + SK_SECTORS, [](const sk_sector& s) { return s.seen_us >= 0; }));
  }

  berm_parameters parameters = berm::test::demo_parameters();
  std::unique_ptr<SectorWatch> watch;
};

// verifies: SK-SD-4
TEST_F(SectorWatchTest, EveryPlaceIsInTheSectorOfItsBearing) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<std::int32_t> place(-SK_COORD_MAX_MM, SK_COORD_MAX_MM);
  for (int n = 0; n < 200'000; ++n) {
    const std::int32_t x = place(random), y = place(random);
    if (x == 0 && y == 0) continue;
    const double bearing = std::atan2(y, x) * 180.0 / kPi, turn = bearing < 0 ? bearing + 360.0 : bearing;
    const std::int32_t sector = watch->sector_of(x, y);
    ASSERT_GE(turn, sector - 1e-4) << x << ", " << y;
    ASSERT_LE(turn, sector + 1 + 1e-4) << x << ", " << y;
  }
  EXPECT_EQ(watch->sector_of(1, 0), 0);
  EXPECT_EQ(watch->sector_of(0, 1), 90);
  EXPECT_EQ(watch->sector_of(-1, 0), 180);
  EXPECT_EQ(watch->sector_of(0, -1), 270);
  EXPECT_EQ(watch->sector_of(30'000, -1), 359);
}

// verifies: SK-SD-4
TEST_F(SectorWatchTest, ALookCountsFromHalfTheRadiusToAQuarterBeyondIt) {
  const std::int32_t r = parameters.workspace_radius_mm;
  watch->see(r / 2 - 1, 0, kNow);
  watch->see(r * 5 / 4 + 1, 0, kNow);
  watch->see(0, 0, kNow);
  watch->see(INT32_MIN, INT32_MAX, kNow);
  EXPECT_EQ(sectors_seen(), 0);
  watch->see(r / 2, 0, kNow);
  EXPECT_EQ(seen(0), kNow);
  watch->see(0, r * 5 / 4, kNow + 1);
  EXPECT_EQ(seen(90), kNow + 1);
  EXPECT_EQ(sectors_seen(), 2);
  watch->begin();
  EXPECT_EQ(sectors_seen(), 0) << "the monitor begins anew";
}

// verifies: SK-SD-4
TEST_F(SectorWatchTest, WhatIsTakenForTheOwnMachineIsNoLook) {
  const auto blocks = std::make_unique<ScanBlocks>();
  blocks->count = 1;
  berm_scan_block& block = blocks->block[0] = berm_scan_block{};
  block.count = 2;
  block.point_mm[0][0] = 10'000;
  block.point_mm[1][1] = 10'000;
  block.used[1] = 1;
  watch->take(*blocks, kNow);
  EXPECT_EQ(seen(0), -1);
  EXPECT_EQ(seen(90), kNow);
}

// verifies: SK-SD-4, SK-SD-9
TEST_F(SectorWatchTest, WhereThereAreLidarsTheirLooksAloneCountAndTheirMonitorsTell) {
  const auto blocks = std::make_unique<ScanBlocks>();
  blocks->count = 1;
  berm_scan_block& block = blocks->block[0] = berm_scan_block{};
  block.count = 1;
  block.point_mm[0][0] = 10'000;
  block.used[0] = 1;
  const auto returns = std::make_unique<LidarReturns>();
  returns->count = 2;
  returns->hit[0] = {{0, 0, 1000}, {0, 10'000, 0}, false};
  returns->hit[1] = {{0, 0, 1000}, {0, -2'000, 0}, true};  // too near
  parameters.workspace_wait_us = 2'000'000;
  parameters.workspace_period_us = 500'000;
  parameters.workspace_lidar_wait_us = 100'000;
  parameters.workspace_lidar_period_us = 50'000;
  for (const int lidars : {0, 1, 2}) {
    parameters.lidars = lidars;
    begin();
    watch->take(*blocks, kNow);
    watch->take(*returns, kNow + 1);
    EXPECT_EQ(seen(0), lidars == 0 ? kNow : -1);
    EXPECT_EQ(seen(90), lidars == 0 ? -1 : kNow + 1);
    EXPECT_EQ(sectors_seen(), 1);
    EXPECT_EQ(watch->rules().detect_us, lidars == 0 ? 140'000 + 2'520'000 : 103'000 + 170'000) << lidars << " lidars";
  }
}

// verifies: SK-SD-7
TEST_F(SectorWatchTest, NothingIsEvaluatedWhereNobodyWatchesOrItIsNotAskedFor) {
  EXPECT_TRUE(watch->evaluated());
  EXPECT_FALSE(watch->enforced());
  parameters.workspace_separation = BERM_SEPARATION_ENFORCED;
  begin();
  EXPECT_TRUE(watch->enforced());
  parameters.workspace_watched = 0;
  begin();
  EXPECT_FALSE(watch->evaluated() || watch->enforced());
  watch->see(10'000, 0, kNow);
  EXPECT_EQ(sectors_seen(), 0);
  parameters.workspace_watched = 1;
  parameters.workspace_separation = BERM_SEPARATION_NONE;
  begin();
  EXPECT_FALSE(watch->evaluated() || watch->enforced());
}

// verifies: SK-SD-8
TEST_F(SectorWatchTest, TheTailIsAHazardWhereTheImplementsReachLess) {
  for (int k = 0; k < SK_SECTORS; ++k) {
    const double bearing = (k + 0.5) * kPi / 180.0;
    watch->see(static_cast<std::int32_t>(11'000 * std::cos(bearing)), static_cast<std::int32_t>(11'000 * std::sin(bearing)), kNow);
  }
  EXPECT_EQ(sectors_seen(), SK_SECTORS);
  EXPECT_EQ(watch->left(0, kNow).stop_us, watch->left(parameters.tail_radius_mm, kNow).stop_us);
  EXPECT_GT(watch->left(0, kNow).stop_us, watch->left(parameters.tail_radius_mm + 100, kNow).stop_us);
  EXPECT_EQ(watch->left(parameters.workspace_radius_mm, kNow).stop_us, -1);
}

// Somebody, met by two returns a look, appears at any time between the updates; the looks that follow come at any interval, or never. The stop comes
// within what the rules say, less the sensors' own delay.
// verifies: SK-SD-9
TEST_F(SectorWatchTest, TheMonitorTellsOfSomebodyWithinItsLatency) {
  std::mt19937_64 random(11);
  const auto one_of = [&random](std::initializer_list<std::int32_t> of) { return of.begin()[random() % of.size()]; };
  const JointHistory joints{};
  parameters.workspace_foreign = 0;  // free space tells sooner
  double latest_share = 0.0;
  for (int trial = 0; trial < 400; ++trial) {
    parameters.workspace_wait_us = one_of({0, 100'000, 200'000, 730'000, 2'000'000});
    parameters.workspace_period_us = one_of({10'000, 100'000, 215'000, 500'000});
    begin();
    WorkspaceWatch monitor(parameters);
    const auto blocks = std::make_unique<ScanBlocks>();
    const auto look = [&](std::int32_t x_mm, std::int32_t y_mm, std::int32_t z_mm, std::int64_t now_us) {
      blocks->count = 1;
      berm_scan_block& block = blocks->block[0] = berm_scan_block{};
      block.count = 2;
      for (int i = 0; i < 2; ++i) {
        block.point_mm[i][0] = x_mm;
        block.point_mm[i][1] = y_mm;
        block.point_mm[i][2] = z_mm;
        block.used[i] = 1;
      }
      block.scanline = static_cast<std::uint32_t>(random());
      monitor.take(*blocks, joints, now_us);
    };
    std::int64_t now_us = 1'000'000;
    const std::int64_t learned_us = now_us + 3 * (parameters.workspace_wait_us + parameters.workspace_period_us);
    for (; now_us < learned_us; now_us += 10'000) {
      for (int n = 0; n < 81; ++n) look(9'150 + 300 * (n % 9 - 4), 150 + 300 * (n / 9 - 4), 0, now_us);
      ASSERT_FALSE(monitor.step(now_us));
    }
    now_us += 10'000 * static_cast<std::int64_t>(random() % 100);
    monitor.step(now_us);
    const std::int64_t every_us = one_of({10'000, 100'000, 330'000, 900'000, 600'000'000});
    const std::int64_t came_us = now_us + 10'000 * (1 + static_cast<std::int64_t>(random() % 60));
    const std::int64_t latency_us = std::int64_t{watch->rules().detect_us} - watch->sight_us() - parameters.cycle_us;
    for (bool told = false; !told;) {
      now_us += 10'000;
      if (now_us >= came_us && (now_us - came_us) % every_us == 0) look(9'150, 150, 1'750, now_us);
      told = monitor.step(now_us);
      ASSERT_TRUE(!told || now_us >= came_us) << "before he came";
      ASSERT_TRUE(told || now_us < came_us + latency_us) 
          << "wait " << parameters.workspace_wait_us << " period " << parameters.workspace_period_us << " looks every " << every_us;
    }
    latest_share = std::max(latest_share, static_cast<double>(now_us - came_us) / static_cast<double>(latency_us));
  }
  EXPECT_GT(latest_share, 0.95) << "the latency is not a bound from far above";
}

}  // namespace
}  // namespace berm::kernel::test
