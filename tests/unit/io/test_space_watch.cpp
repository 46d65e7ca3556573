// Free space as the kernel feeds it: rays, learning, and the part of a truck zone that is watched.
#include "io/space_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "io/workspace_watch.hpp"
#include "mini_machine.hpp"

namespace berm::kernel::test {
namespace {

constexpr std::int64_t kSecond = 1000000;
const sk_point kHead{0, 0, 3000};

berm_parameters watching_parameters() {
  berm_parameters p = berm::test::demo_parameters();
  p.workspace_watched = 1;
  p.workspace_radius_mm = 12000;
  p.workspace_foreign = 4;
  p.workspace_learn_us = 10 * kSecond;
  p.dig_zones = p.truck_zones = p.ground_zones = 0;
  p.pass_over_mm = 800;
  p.lanes = 1;
  p.lane[0] = {-15000, 6000, 15000, 9000};
  return p;
}

class SpaceWatchTest : public testing::Test {
 protected:
  SpaceWatchTest() { make(); }
  void make() { watch = std::make_unique<SpaceWatch>(parameters); }
  int flag(std::int32_t x, std::int32_t y, std::int32_t z) const {
    const sk_voxel v = sk_voxel_of(x, y, z);
    return watch->space().voxel[v.level][v.jy][v.jx];
  }
  // An upright board facing the head, its points 75 mm from one another.
  void board(std::int32_t x, std::int32_t y, std::int32_t width, std::int32_t high, bool learning) {
    for (std::int32_t a = -width / 2; a <= width / 2; a += 75)
      for (std::int32_t z = 75; z <= high; z += 75) watch->take(kHead, {x, y + a, z}, learning, now_us);
  }
  berm_parameters parameters = watching_parameters();
  std::int64_t now_us = kSecond;
  std::unique_ptr<SpaceWatch> watch;
  sk_monitor_cell where{};
};

// verifies: SK-FS-10
TEST_F(SpaceWatchTest, ARayFreesWhatItPassesButNotWhatItMeets) {
  watch->take(kHead, {9000, 0, 0}, true, now_us);
  int passed = 0, steps = 0;
  for (std::int32_t x = 200; x <= 8600; x += 25, ++steps) passed += flag(x, 0, 3000 - x / 3) == SK_VOXEL_FREE ? 1 : 0;
  EXPECT_GT(passed, 0.9 * steps) << "all but corners";
  EXPECT_EQ(flag(8900, 0, 75), SK_VOXEL_UNKNOWN) << "too near the surface";
  EXPECT_EQ(flag(9000, 0, 0), SK_VOXEL_SOLID);
  EXPECT_EQ(flag(9300, 0, -100), SK_VOXEL_UNKNOWN);
}

// verifies: SK-FS-3, SK-FS-4, SK-FS-7
TEST_F(SpaceWatchTest, SomebodyBesideAWallIsFoundUntilHeHasLeft) {
  board(9000, 0, 6000, 2700, true);
  for (std::int32_t gap : {500, 700, 1000}) {
    board(9000 - gap, 0, 450, 1100, false);
    ASSERT_TRUE(watch->find(where)) << gap;
    EXPECT_EQ(where.ix, sk_map_index(9000 - gap)) << gap;
    EXPECT_NEAR(where.iy, sk_map_index(0), 1) << gap;
    EXPECT_NEAR(watch->foreign_height_mm(where), 1000, 100) << gap;
    board(9000, 0, 6000, 2700, false);
    EXPECT_FALSE(watch->find(where)) << gap;
  }
}

// Whose upper half was met by rays that look up: from the sky none of them comes back when he has gone.
// verifies: SK-FS-14
TEST_F(SpaceWatchTest, WhatNoRayFreesAnyMoreIsFreeWhenRaysPassLow) {
  const std::int64_t lately = 2 * std::int64_t{parameters.workspace_period_us} + 1, wait = parameters.workspace_wait_us;
  board(9000, 0, 6000, 2700, true);
  const auto comes = [&](std::int32_t y) {
    board(8000, y, 450, 1100, false);
    ASSERT_TRUE(watch->find(where));
  };
  comes(0);
  const sk_monitor_cell at{sk_map_index(0), sk_map_index(8000)}, beside{sk_map_index(1), sk_map_index(8000 + SK_CELL_MM)};
  ASSERT_GT(watch->space().foreign[at.iy][at.ix], 3);
  const auto foreign = [&] { return watch->space().foreign[at.iy][at.ix]; };
  watch->pass_low(at, -2000, now_us);
  now_us += lately;
  watch->pass_low(at, -2000, now_us);
  now_us += wait - 1;
  watch->pass_low(at, -2000, now_us);
  EXPECT_GT(foreign(), 3) << "too soon";
  comes(0);
  now_us += lately;
  watch->pass_low(at, -2000, now_us);
  now_us += 1;
  watch->pass_low(at, -2000, now_us);
  EXPECT_GT(foreign(), 3) << "he was met between";
  now_us += wait;
  comes(750);
  watch->pass_low(at, -2000, now_us);
  EXPECT_GT(foreign(), 3) << "somebody is beside it";
  now_us += lately;
  watch->pass_low(beside, -2000, now_us), watch->pass_low({-1, 0}, -2000, now_us), watch->pass_low({0, SK_MAP_CELLS}, -2000, now_us);
  const std::uint16_t next = watch->space().foreign[sk_map_index(550)][at.ix];
  ASSERT_GT(next, 3);
  watch->pass_low(at, -2000, now_us);
  EXPECT_EQ(foreign(), 0);
  EXPECT_EQ(flag(7950, 0, 675), SK_VOXEL_FREE);
  EXPECT_EQ(watch->space().foreign[sk_map_index(550)][at.ix], next) << "of another cell";
  EXPECT_TRUE(watch->find(where)) << "who is beside it";
}

// Of what is lower than the rays they say nothing.
// verifies: SK-FS-14
TEST_F(SpaceWatchTest, LowRaysFreeWhatReachesAboveTheHigherOfThem) {
  const std::int64_t lately = 2 * std::int64_t{parameters.workspace_period_us} + 1;
  board(9000, 0, 6000, 2700, true);
  board(8000, 0, 450, 1100, false);
  const sk_monitor_cell at{sk_map_index(0), sk_map_index(8000)};
  now_us += lately;
  watch->pass_low(at, 700, now_us);
  now_us += parameters.workspace_wait_us;
  watch->pass_low(at, 300, now_us);
  EXPECT_EQ(flag(7950, 0, 825), SK_VOXEL_FREE);
  EXPECT_EQ(flag(7950, 0, 675), SK_VOXEL_FREE) << "it reaches above the higher";
  EXPECT_EQ(flag(7950, 0, 525), SK_VOXEL_FOREIGN);
  watch->pass_low(at, 300, now_us);
  now_us += parameters.workspace_wait_us;
  watch->pass_low(at, 300, now_us);
  EXPECT_EQ(flag(7950, 0, 525), SK_VOXEL_FREE);
}

// verifies: SK-FS-12
TEST_F(SpaceWatchTest, OfATruckZoneTheTruckIsLeftOut) {
  parameters.truck_zones = 1;
  parameters.truck_zone[0] = {3000, 3000, 9000, 5700, 2000};
  make();
  const auto watched = [&](std::int32_t x, std::int32_t y) { return watch->watched(sk_map_index(y), sk_map_index(x)); };
  watch->watch(false, false);
  EXPECT_FALSE(watched(3100, 3100));
  EXPECT_FALSE(watched(6000, 4500));
  watch->watch(false, true);
  EXPECT_TRUE(watched(6000, 4500)) << "nothing stands there";
  for (std::int32_t z : {0, 500, 1500}) {
    watch->take({6000, 0, 3000}, {4650, 3950, z}, true, now_us);
    watch->take({6000, 0, 3000}, {7350, 4850, z}, true, now_us);
  }
  watch->take({6000, 0, 3000}, {3100, 3100, 600}, true, now_us);
  watch->watch(false, true);
  EXPECT_FALSE(watched(6000, 4500)) << "within the box round it";
  EXPECT_FALSE(watched(4650, 4850));
  EXPECT_TRUE(watched(4350, 4500));
  EXPECT_TRUE(watched(6000, 3650));
  EXPECT_TRUE(watched(3100, 3100)) << "no higher than may be passed over";
}

class DugSpaceTest : public SpaceWatchTest {
 protected:
  DugSpaceTest() {
    parameters.dig_zones = 1;
    parameters.dig_zone[0] = {3000, -3000, 9000, 3000, -2000, 1100};
    parameters.workspace_histogram = 1;
    make();
  }
  bool watched(std::int32_t x, std::int32_t y) const { return watch->watched(sk_map_index(y), sk_map_index(x)); }
  void step(bool stirred, bool heights_learned, bool held = false) {
    watch->dig({{dug, 0.0, 0.0, 1.1, stirred, false, -1}, {other, 0.0, 0.0, 1.1, false, false, -1}}, heights_learned, held);
  }
  bool may_be_soil(std::int32_t x, std::int32_t z) const { return watch->may_be_soil({x, 0, z}); }
  const sk_monitor_cell dug{sk_map_index(0), sk_map_index(6000)}, other{sk_map_index(0), sk_map_index(7000)};
};

// verifies: SK-FS-15
TEST_F(DugSpaceTest, WhereTheBucketHasBeenSoilMayLieUpToTheCeiling) {
  EXPECT_TRUE(watched(6000, 0));
  EXPECT_FALSE(may_be_soil(6000, -1500));
  step(true, true, true);
  EXPECT_FALSE(may_be_soil(6000, -1500)) << "somebody is in the region, and may be here";
  step(true, true);
  EXPECT_TRUE(may_be_soil(6000, -1500));
  EXPECT_TRUE(may_be_soil(6000, 1100));
  EXPECT_FALSE(may_be_soil(6000, 1101));
  EXPECT_FALSE(may_be_soil(7000, -1500));
  EXPECT_FALSE(watch->may_be_soil({-40000, 0, 0}) || watch->may_be_soil({0, 40000, 0}));
  EXPECT_TRUE(watched(6000, 0)) << "who is higher";
  step(false, true);
  EXPECT_TRUE(may_be_soil(6000, 1100)) << "it lies there";
  step(false, true, true);
  EXPECT_TRUE(may_be_soil(6000, 1100));
  watch->meet({6000, 0, 0}, true, now_us);
  watch->begin();
  EXPECT_FALSE(may_be_soil(6000, 1100));
}

// verifies: SK-FS-15
TEST_F(DugSpaceTest, NobodyIsWatchedWhereNobodyTellsOfTheBucket) {
  parameters.workspace_histogram = 0;
  make();
  EXPECT_FALSE(watched(6000, 0));
}

// verifies: SK-FS-15
TEST_F(DugSpaceTest, WhileHeightsAreLearnedSoilComesToRest) {
  step(true, false);
  EXPECT_TRUE(may_be_soil(6000, 1100));
  step(false, false);
  EXPECT_FALSE(may_be_soil(6000, 1100)) << "nobody else watches there";
  step(true, false);
  step(false, true);
  EXPECT_TRUE(may_be_soil(6000, 1100)) << "heights are learned, and watch it";
}

class WatchedSpaceTest : public testing::Test {
 protected:
  WatchedSpaceTest() {
    std::int32_t angle[4] = {1570796, 0, 0, 0};
    joints.push(1, angle);
    watch = std::make_unique<WorkspaceWatch>(parameters);
  }
  // Scanlines of a board across y, from the left scanner: dense enough that their rays pass through every voxel before it.
  void see_board(std::int32_t y, std::int32_t half_width, std::int32_t z_high) {
    for (std::int32_t x = -half_width; x <= half_width; x += 75) see(x, y, -3000, z_high);
  }
  void see(std::int32_t x, std::int32_t y, std::int32_t z_low, std::int32_t z_high) {
    blocks->count = 1;
    berm_scan_block& block = blocks->block[0];
    block = berm_scan_block{};
    block.scanline = ++scanline;
    block.time_us = now;
    for (std::int32_t z = z_low; z <= z_high && block.count < BERM_SCAN_BLOCK_SAMPLES; z += 75) {
      block.used[block.count] = 1;
      block.point_mm[block.count][0] = x;
      block.point_mm[block.count][1] = y;
      block.point_mm[block.count][2] = z;
      ++block.count;
    }
    watch->take(*blocks, joints, now);
  }
  bool pass(std::int64_t time_us) {
    now += time_us;
    return watch->step(now);
  }
  berm_parameters parameters = watching_parameters();
  JointHistory joints;
  std::unique_ptr<WorkspaceWatch> watch;
  std::unique_ptr<ScanBlocks> blocks = std::make_unique<ScanBlocks>();
  std::uint32_t scanline = 0;
  std::int64_t now = 5 * kSecond;
};

// verifies: SK-FS-10
TEST_F(WatchedSpaceTest, TheHeadIsWhereTheSwingPlacesIt) {
  const berm_scanner_mount& mount = parameters.scanner[0];
  see(0, 9000, 0, 0);
  // Near the head, which a quarter turn has placed at (-y, x).
  const double f = 0.2;
  const auto along = [f](double from, double to) { return static_cast<std::int32_t>(std::lround(from + f * (to - from))); };
  const sk_voxel v = sk_voxel_of(along(-mount.y_mm, 0), along(mount.x_mm, 9000), along(mount.z_mm, 0));
  EXPECT_EQ(watch->space().space().voxel[v.level][v.jy][v.jx], SK_VOXEL_FREE);
}

// verifies: SK-FS-5, SK-FS-11, SK-FS-13
TEST_F(WatchedSpaceTest, WhatComesAfterTheGroundWasLearnedStopsTheMachine) {
  see_board(9000, 4000, 2700);
  EXPECT_FALSE(pass(0));
  see(0, 7000, 300, 1500);
  EXPECT_FALSE(pass(9 * kSecond)) << "learned with the ground";
  watch->begin();
  see_board(9000, 4000, 2700);
  EXPECT_FALSE(pass(10000));
  EXPECT_FALSE(pass(10 * kSecond));
  see(0, 5000, 300, 1500);
  EXPECT_TRUE(pass(10000));
  std::int32_t x, y, z;
  ASSERT_TRUE(watch->place(x, y, z));
  EXPECT_NEAR(x, 0, 300);
  EXPECT_NEAR(y, 5000, 300);
  EXPECT_NEAR(z, 1425, 80);
  EXPECT_TRUE(pass(60 * kSecond)) << "nothing tells that he has left";
  see_board(9000, 4000, 2700);
  EXPECT_TRUE(pass(10000)) << "dwells";
  EXPECT_FALSE(pass(parameters.workspace_dwell_us));
}

// verifies: SK-FS-11
TEST_F(WatchedSpaceTest, ALaneIsLearnedAnewWhenATruckHasParked) {
  see_board(9000, 4000, 2700);
  pass(0);
  EXPECT_FALSE(pass(11 * kSecond));
  watch->trucks(true, true, now);
  see_board(7000, 4000, 1500);
  EXPECT_FALSE(pass(10000)) << "the truck";
  EXPECT_FALSE(pass(11 * kSecond));
  see_board(7000, 4000, 1500);
  EXPECT_FALSE(pass(10000));
  see(0, 6400, 300, 1500);
  EXPECT_TRUE(pass(10000)) << "somebody beside it";
}

// verifies: SK-FS-11
TEST_F(WatchedSpaceTest, ALaneIsLearnedForThreeSecondsThoughItsHeightsAreForLonger) {
  for (const bool too_soon : {true, false}) {
    watch = std::make_unique<WorkspaceWatch>(parameters);
    see_board(9000, 4000, 2700);
    pass(0);
    EXPECT_FALSE(pass(11 * kSecond));
    watch->trucks(true, true, now);
    see_board(7000, 4000, 1500);
    EXPECT_FALSE(pass(too_soon ? 3 * kSecond - 1 : 3 * kSecond));
    see(0, 6400, 300, 1500);
    EXPECT_EQ(pass(10000), !too_soon);
    EXPECT_TRUE(watch->learns_lanes()) << "its heights";
  }
}

// verifies: SK-FS-12
TEST_F(WatchedSpaceTest, ATrucksZoneIsWatchedRoundWhatIsSeenOfItWhileItsHeightsAreLearned) {
  parameters.truck_zones = 1;
  parameters.truck_zone[0] = {-3000, 6300, 3000, 8700, 2000};
  watch = std::make_unique<WorkspaceWatch>(parameters);
  const auto watched = [&](std::int32_t y) { return watch->space().watched(sk_map_index(y), sk_map_index(0)); };
  see_board(9000, 4000, 2700);
  pass(0);
  EXPECT_FALSE(pass(11 * kSecond));
  watch->trucks(true, true, now);
  see_board(7400, 2000, 1500);
  EXPECT_FALSE(pass(3 * kSecond - 1));
  EXPECT_FALSE(watched(6750)) << "nobody knows yet what stands there";
  EXPECT_FALSE(pass(1));
  EXPECT_TRUE(watched(6750)) << "beside it";
  EXPECT_FALSE(watched(7400));
  EXPECT_TRUE(watched(8200)) << "behind it";
  see_board(8200, 2000, 1800);
  EXPECT_FALSE(pass(kSecond / 2));
  EXPECT_TRUE(watched(8200));
  EXPECT_FALSE(pass(kSecond / 2));
  EXPECT_FALSE(watched(8200)) << "more of it";
  EXPECT_FALSE(watched(7800)) << "between";
  EXPECT_TRUE(watched(6750));
  see(0, 6750, 300, 1500);
  EXPECT_TRUE(pass(10000)) << "somebody beside it";
  see_board(6600, 2000, 1800);
  EXPECT_TRUE(pass(kSecond));
  EXPECT_TRUE(watched(6750)) << "nothing more is left out while he is there";
  EXPECT_TRUE(watch->learns_lanes());
  EXPECT_TRUE(pass(5 * kSecond - 10000)) << "heights have been learned: he is there";
  EXPECT_FALSE(watch->learns_lanes());
  watch->begin();
  see_board(7400, 2000, 1500);
  EXPECT_FALSE(pass(0));
  EXPECT_FALSE(watched(6750));
  EXPECT_FALSE(pass(4 * kSecond));
  EXPECT_TRUE(watched(6750)) << "learned anew with the truck there";
  EXPECT_FALSE(watched(7400));
  watch->trucks(true, false, now);
  EXPECT_FALSE(watched(6750)) << "an open lane";
}

// verifies: SK-FS-15
TEST_F(WatchedSpaceTest, SoilThatTheBucketMovesIsNobodyNorWhenItHasGone) {
  parameters.dig_zones = 1;
  parameters.dig_zone[0] = {3000, -3000, 9000, 3000, -2000, 1100};
  parameters.workspace_histogram = 1;
  std::int32_t ahead[4] = {0, 0, 0, 0};
  joints.push(2, ahead);
  const JointAngles digging{0.0, 0.35, -1.2, -1.05}, carrying{0.0, 0.79, -1.57, -1.2};
  const auto x = static_cast<std::int32_t>(1e3 * Kinematics(parameters).implements(digging).link[2].pin.x());
  const auto begin = [&] {
    watch = std::make_unique<WorkspaceWatch>(parameters);
    for (std::int32_t y = -4000; y <= 4000; y += 75) see(9300, y, -3000, 2700);
    EXPECT_FALSE(pass(0));
    EXPECT_FALSE(pass(4 * kSecond));
    EXPECT_TRUE(watch->learns()) << "its heights";
  };
  begin();
  see(x, 0, 75, 1050);
  EXPECT_TRUE(pass(10000)) << "somebody: the bucket was not there";
  const auto heap_up = [&] {
    begin();
    watch->dig(digging, false, now);
    see(x, 0, 75, 1050);
    EXPECT_FALSE(pass(10000));
  };
  heap_up();
  see(x, 0, 75, 1800);
  EXPECT_TRUE(pass(10000)) << "somebody: no soil is so high";
  heap_up();
  watch->dig(carrying, false, now);
  now += 3 * kSecond;
  watch->dig(carrying, false, now);
  EXPECT_FALSE(watch->space().may_be_soil({x, 0, 75})) << "it lies";
  see(x, 0, 75, 1050);
  EXPECT_FALSE(pass(10000)) << "it is where it was";
  see(x + 900, 0, 75, 1050);
  EXPECT_TRUE(pass(10000)) << "somebody: the bucket has gone";
}

}  // namespace
}  // namespace berm::kernel::test
