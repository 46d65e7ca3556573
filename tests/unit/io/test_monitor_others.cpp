// Histograms of several sensors: what one knows of a cell stands for what another has seen too little of, and no wrong height goes from one to the next.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>

#include "io/low_rays.hpp"
#include "io/monitor_watch.hpp"
#include "lidar_ring.hpp"
#include "watched_ring.hpp"

namespace berm::kernel::test {
namespace {

constexpr std::int32_t kFoot = -1500, kTop = -800;  // mm, of a slope in one cell
constexpr std::int32_t kX = 9000, kY = 2550;
constexpr std::int32_t kGround = 20;

class MonitorOthersTest : public testing::Test {
 protected:
  MonitorOthersTest() {
    parameters.workspace_histogram = 1;
    begin();
  }
  // All of them, by the parameters as they are now, with nothing known and nothing to learn.
  void begin() {
    for (auto& monitor : monitors) {
      monitor = std::make_unique<MonitorWatch>(parameters, parameters.workspace_wait_us, parameters.workspace_period_us);
      monitor->change_lanes(parameters, false);  // a truck stands there, and the lane is watched
      settle(*monitor);
    }
  }
  static void settle(MonitorWatch& monitor) { monitor.settle({SK_MAP_ORIGIN_MM, SK_MAP_ORIGIN_MM, -SK_MAP_ORIGIN_MM, -SK_MAP_ORIGIN_MM}); }
  MonitorWatch::Others others_of(std::size_t number) const {
    MonitorWatch::Others others;
    for (std::size_t other = 0; other < monitors.size(); ++other)
      if (other != number) others.monitor[others.count++] = monitors[other].get();
    if (number != 0) others.scanners = monitors[0].get();
    return others;
  }
  // A ray of this sensor that passes the cell at that height and meets the ground 3 m beyond, twice with the wait between.
  void pass(std::size_t number, std::int32_t z_mm) {
    for (int time = 0; time < 2; ++time, now_us += parameters.workspace_wait_us)
      pass_low(*monitors[number], others_of(number), nullptr, {kX - 12000, kY, kGround + 5 * (z_mm - kGround)}, {kX + 3000, kY, kGround}, now_us);
  }
  // Each has seen the ground here and round it; the one of that number somebody then.
  void somebody_of(std::size_t number) {
    begin();
    for (std::size_t each = 0; each < monitors.size(); ++each)
      for (std::int32_t y = kY - 600; y <= kY + 600; y += SK_CELL_MM)
        for (std::int32_t x = kX - 600; x <= kX + 600; x += SK_CELL_MM)
          for (int i = 0; i < 10; ++i) monitors[each]->insert({x, y, kGround}, now_us, others_of(each));
    EXPECT_TRUE(see(number, kGround + 1700, 3));
    now_us += 2 * parameters.workspace_period_us + 1;
  }
  bool holds(std::size_t number) {
    monitors[number]->step(now_us);
    std::int32_t x = 0, y = 0, height = 0;
    return monitors[number]->place(x, y, height);
  }
  // Whether the machine must stand for what this sensor saw.
  bool see(std::size_t number, std::int32_t z_mm, int points) {
    const MonitorWatch::Others others = others_of(number);
    for (int i = 0; i < points; ++i) monitors[number]->insert({kX, kY, z_mm}, now_us, others);
    return monitors[number]->step(now_us);
  }
  std::uint32_t observed(std::size_t number) const { return monitors[number]->histogram()->observed[sk_map_index(kY)][sk_map_index(kX)]; }

  berm_parameters parameters = watched_ring();
  std::int64_t now_us = 1'000'000;
  std::array<std::unique_ptr<MonitorWatch>, 3> monitors;
};

// verifies: SK-WM-71
TEST_F(MonitorOthersTest, TheTopOfASlopeThatAnotherSensorKnowsIsNobody) {
  EXPECT_FALSE(see(0, kFoot, 10));
  EXPECT_FALSE(see(1, kFoot, 10));
  EXPECT_FALSE(see(2, kFoot, SK_HISTOGRAM_ENOUGH));
  EXPECT_FALSE(see(2, kFoot + 450, 1));
  now_us += 2'000'000;
  EXPECT_FALSE(see(2, kFoot + 450, 1)) << "the one that saw more of it, in steps of less than a rise";
  now_us += 2'000'000;
  EXPECT_FALSE(see(2, kTop, 1));
  now_us += 2'000'000;
  EXPECT_FALSE(see(2, kTop, 1));
  for (const std::size_t number : {0U, 1U}) EXPECT_FALSE(see(number, kTop + 300, 9)) << number;
  for (const std::size_t number : {0U, 1U}) EXPECT_TRUE(see(number, kTop + 700, 3)) << number << ": higher than any of them knows";
}

// Whom one sensor saw while the machine swung, and cannot see any more where it stands, another sees to be gone.
// verifies: SK-WM-73
TEST_F(MonitorOthersTest, ThatHeHasLeftAnotherSensorMaySee) {
  for (const std::size_t seen_by : {0U, 1U, 2U})
    for (const std::size_t passed_by : {1U, 2U}) {
      somebody_of(seen_by);
      pass(passed_by, kGround + 1000);
      EXPECT_TRUE(holds(seen_by)) << seen_by << ", " << passed_by << ": over his head";
      pass(passed_by, kGround + 300);
      EXPECT_FALSE(holds(seen_by)) << seen_by << ", " << passed_by;
    }
}

// verifies: SK-WM-73
TEST_F(MonitorOthersTest, NoSensorClearsForAnotherWhereItKnowsOfSomebodyAbout) {
  somebody_of(1);
  for (int i = 0; i < 3; ++i) monitors[2]->insert({kX, kY + SK_CELL_MM, kGround + 1700}, now_us, others_of(2));
  now_us += 2 * parameters.workspace_period_us + 1;
  ASSERT_TRUE(holds(2));
  pass(2, kGround + 300);
  EXPECT_TRUE(holds(1)) << "he may stand between the two cells";
}

// verifies: SK-WM-73
TEST_F(MonitorOthersTest, NorWhileTheOtherSeesHim) {
  somebody_of(1);
  for (int time = 0; time < 10; ++time) {
    see(1, kGround + 1700, 1);
    pass_low(*monitors[2], others_of(2), nullptr, {kX - 12000, kY, kGround + 1500}, {kX + 3000, kY, kGround}, now_us);
    now_us += parameters.workspace_wait_us / 2;
  }
  EXPECT_TRUE(holds(1));
}

// Met in a point a turn he is nobody to that sensor; his cells are no free passage for it either.
// verifies: SK-WM-73
TEST_F(MonitorOthersTest, NorWhileItMeetsHimItselfNowAndThen) {
  const std::int64_t turn = 2 * std::int64_t{parameters.workspace_period_us} + 1;
  const auto pass_once = [&] { pass_low(*monitors[2], others_of(2), nullptr, {kX - 12000, kY, kGround + 1500}, {kX + 3000, kY, kGround}, now_us); };
  somebody_of(1);
  for (int time = 0; time < 10; ++time, now_us += turn) {
    monitors[2]->insert({kX, kY + SK_CELL_MM, kGround + 1700}, now_us, others_of(2));
    ASSERT_FALSE(holds(2));
    pass_once();
  }
  EXPECT_TRUE(holds(1));
  now_us += parameters.workspace_wait_us + 2 * std::int64_t{parameters.workspace_period_us};
  pass_once();
  now_us += parameters.workspace_wait_us;
  pass_once();
  EXPECT_FALSE(holds(1)) << "gone";
}

// Where nothing is known, and while it is learned, nothing departs, and any height would be low.
// verifies: SK-FS-14, SK-WM-73
TEST_F(MonitorOthersTest, OverGroundThatNobodyKnowsOrThatIsLearnedNoRayFreesASpace) {
  const auto space = std::make_unique<SpaceWatch>(parameters);
  space->begin();
  const auto board = [&](std::int32_t x, std::int32_t half_width, std::int32_t high, bool learning) {
    for (std::int32_t y = kY - half_width; y <= kY + half_width; y += 75)
      for (std::int32_t z = 75; z <= high; z += 75) space->take({0, kY, 2000}, {x, y, z}, learning, now_us);
  };
  board(kX + 1000, 2000, 2700, true);
  board(kX, 225, 1100, false);
  const auto foreign = [&] { return space->space().foreign[sk_map_index(kY)][sk_map_index(kX)]; };
  ASSERT_GT(foreign(), 3);
  now_us += 2 * parameters.workspace_period_us + 1;
  const auto passes = [&](std::int32_t z_mm) {
    for (int time = 0; time < 2; ++time, now_us += parameters.workspace_wait_us)
      pass_low(*monitors[2], others_of(2), space.get(), {kX - 12000, kY, kGround + 5 * (z_mm - kGround)}, {kX + 3000, kY, kGround}, now_us);
  };
  passes(kGround + 300);
  EXPECT_GT(foreign(), 3);
  monitors[2]->begin();
  for (int i = 0; i < SK_HISTOGRAM_ENOUGH; ++i) monitors[2]->insert({kX, kY, kGround}, now_us, others_of(2));
  passes(kGround + 300);
  EXPECT_GT(foreign(), 3) << "it is learned";
  monitors[2]->begin();
  settle(*monitors[2]);
  for (int i = 0; i < SK_HISTOGRAM_ENOUGH; ++i) monitors[1]->insert({kX, kY, kGround}, now_us, others_of(1));
  passes(kGround + 300);
  EXPECT_LE(foreign(), 2) << "another sensor knows the ground there";
}

// There somebody may have been learned by the sensor that passes.
// verifies: SK-WM-73
TEST_F(MonitorOthersTest, NorWhereCellsAreLearnedAnew) {
  parameters.lanes = 1;
  parameters.lane[0] = {kX - 3000, kY - 1500, kX + 1500, kY + 1500};
  somebody_of(1);
  pass(2, kGround + 300);
  EXPECT_TRUE(holds(1));
  pass(1, kGround + 300);
  EXPECT_FALSE(holds(1)) << "its own rays";
}

// verifies: SK-WM-71
TEST_F(MonitorOthersTest, WithNoOtherWhoKnowsItIsSomebody) {
  EXPECT_FALSE(see(0, kFoot, 10));
  EXPECT_TRUE(see(0, kTop, 3));
}

// verifies: SK-WM-71
TEST_F(MonitorOthersTest, WhoHasSeenManyNeedsNoOther) {
  EXPECT_FALSE(see(1, kTop, SK_HISTOGRAM_ENOUGH)) << "its only knowledge";
  EXPECT_FALSE(see(0, kFoot, SK_HISTOGRAM_WELL));
  EXPECT_TRUE(see(0, kTop, 3));
}

// Run through while the bucket was near, a lidar had learned a child of a dig zone's cells: to the scanners, which knew the ground alone, he was excused.
// Of a truck a lidar may have met a few points at the foot alone while it was learned, for the machine hardly swung; the scanners swept all of it.
// verifies: SK-WM-71
TEST_F(MonitorOthersTest, WhereCellsAreLearnedAnewTheScannersExcuseATruckToALidarAndNobodyElse) {
  // One learned what stood there, another the ground, and then that one meets it.
  const auto excused = [this](std::size_t learner, std::size_t other, int seen) {
    begin();
    EXPECT_FALSE(see(learner, kFoot + 1000, 20));
    EXPECT_FALSE(see(other, kFoot, seen));
    return !see(other, kFoot + 1000, 3);
  };
  const auto expect = [&excused](bool by_lidars, bool by_scanners, const char* where) {
    EXPECT_EQ(excused(2, 0, 10), by_lidars) << where << ": the scanners meet what a lidar learned";
    EXPECT_EQ(excused(1, 2, 10), by_lidars) << where << ": a lidar, what the other learned";
    for (const std::size_t lidar : {1U, 2U}) {
      for (const int seen : {SK_HISTOGRAM_ENOUGH, 10, SK_HISTOGRAM_WELL - 1})
        EXPECT_EQ(excused(0, lidar, seen), by_scanners) << where << ": lidar " << lidar << " with " << seen << ", what the scanners learned";
      EXPECT_FALSE(excused(0, lidar, SK_HISTOGRAM_WELL)) << where << ": knows the cell itself";
    }
  };
  expect(true, true, "elsewhere");
  const berm_dig_zone digs{kX + 200, kY - 500, kX + 900, kY + 500, -3000, 1000};
  parameters.dig_zone[0] = digs;
  expect(false, false, "the cell touches a dig zone");
  parameters.lanes = 1;
  parameters.lane[0] = {kX - 900, kY - 500, kX, kY + 500};
  expect(false, false, "the cell touches a dig zone and a lane");
  parameters.dig_zones = 0;
  expect(false, true, "the cell touches a lane");
}

// Of the corner of a cab a lidar had met nothing yet, and its lines lay on the ground beyond (replayed).
// verifies: SK-WM-71
TEST_F(MonitorOthersTest, InALaneALidarsLinesYieldToWhatTheScannersKnow) {
  const auto stops = [this](std::size_t learner, std::size_t other) {
    begin();
    EXPECT_FALSE(see(learner, kFoot + 1000, 20));
    for (int i = 0; i < SK_LINES_ENOUGH; ++i) monitors[other]->interpolate({kX - 600, kY, kFoot}, {kX + 600, kY, kFoot}, MonitorWatch::Over::kUnmeasured, now_us);
    return see(other, kFoot + 1000, 3);
  };
  const auto expect = [&stops](bool yields, const char* where) {
    for (const std::size_t lidar : {1U, 2U}) {
      EXPECT_EQ(stops(0, lidar), !yields) << where << ": to the scanners, lidar " << lidar;
      EXPECT_TRUE(stops(lidar, 0)) << where << ": the scanners', to lidar " << lidar;
      EXPECT_TRUE(stops(3 - lidar, lidar)) << where << ": to the other lidar, lidar " << lidar;
    }
  };
  expect(false, "elsewhere");
  parameters.lanes = 1;
  parameters.lane[0] = {kX - 900, kY - 500, kX, kY + 500};
  expect(true, "the cell touches a lane");
  parameters.dig_zone[0] = {kX + 200, kY - 500, kX + 900, kY + 500, -3000, 1000};
  parameters.dig_zones = 1;
  expect(false, "the cell touches a dig zone and a lane");
}

// verifies: SK-WM-68
TEST_F(MonitorOthersTest, WhereCellsAreLearnedAnewALidarAsksTheScannersAlone) {
  parameters.dig_zone[0] = {kX - 500, kY - 500, kX + 500, kY + 500, -3000, 1000};
  begin();
  EXPECT_FALSE(see(2, kFoot + 1000, 20)) << "it learned somebody";
  EXPECT_FALSE(see(1, kFoot + 1000, 3)) << "nobody it asks knows better";
  EXPECT_FALSE(see(0, kFoot, 20)) << "it asks nobody";
  monitors[1]->begin();
  settle(*monitors[1]);
  EXPECT_TRUE(see(1, kFoot + 1000, 3));
}

// A trench's side of which the scanners met the foot, half a cell beside; its upper edge, 0.9 m higher, was somebody (replayed).
// verifies: SK-WM-67, SK-WM-68
TEST_F(MonitorOthersTest, WhatWasMetBesideACellOfADigIsNotItsGroundAndNobodyIsMuchHigher) {
  const std::int32_t edge_x = SK_MAP_ORIGIN_MM + SK_CELL_MM * sk_map_index(kX);  // of the cell, towards the one before
  const auto beside = [&](std::size_t number) {
    for (auto& monitor : monitors) monitor = std::make_unique<MonitorWatch>(parameters, parameters.workspace_wait_us, parameters.workspace_period_us);
    for (int i = 0; i < 20; ++i) monitors[number]->insert({edge_x - 20, kY, kFoot}, now_us, others_of(number));
    for (auto& monitor : monitors) settle(*monitor);
  };
  parameters.dig_zone[0] = {kX - 900, kY - 900, kX + 900, kY + 900, -3000, 1000};
  for (const std::size_t number : {0U, 1U}) {
    beside(number);
    for (const std::int32_t edge : {300, 1100, 1550}) {  // at most a rise over seven bins more
      beside(number);
      EXPECT_FALSE(see(number, kFoot + edge, 3)) << number << ": " << edge;
    }
    beside(number);
    EXPECT_TRUE(see(number, kFoot + 1551, 3)) << number << ": higher than a slope rises in a cell";
    EXPECT_EQ(observed(number), 0U);
  }
  beside(0);
  EXPECT_FALSE(see(0, kFoot + 1000, 3));
  EXPECT_TRUE(see(0, kFoot + 1551, 3)) << "nor is he, met from the feet upwards";
  EXPECT_EQ(observed(0), 3U);
  begin();  // settled with nothing met
  EXPECT_FALSE(see(0, kFoot, 2));
  EXPECT_TRUE(see(0, kFoot + 1551, 3)) << "higher than a slope rises over the first two met";
  beside(0);
  EXPECT_FALSE(see(2, kFoot, 20));
  EXPECT_TRUE(see(0, kFoot + 1100, 3)) << "where a lidar knows the ground he is somebody, though what it knows excuses nobody";
  parameters.dig_zones = 0;
  beside(0);
  EXPECT_FALSE(see(0, kFoot + 1900, 3)) << "elsewhere other sensors tell, and none knows";
}

// Somebody whom a sensor meets that never saw the ground there would else be its ground, and his own excuse before the others.
// verifies: SK-WM-68, SK-WM-71
TEST_F(MonitorOthersTest, WhoStandsWhereOneKnowsTheGroundIsTheGroundOfNone) {
  for (const std::size_t knows : {0U, 1U, 2U}) {
    begin();
    EXPECT_FALSE(see(knows, kFoot, 20));
    for (std::size_t number = 0; number < monitors.size(); ++number) {
      EXPECT_TRUE(see(number, kFoot + 1100, 20)) << number << ", known to " << knows;
      EXPECT_EQ(observed(number), number == knows ? 20U : 0U);
    }
  }
}

// The whole of the watch: two lidars over level ground, and the panning scanners, of which one return is told at a time.
class WatchedRingTest : public MonitorOthersTest {
 protected:
  static constexpr int kRow = 60;  // a row of cells to the left of the machine
  void learn() {
    parameters.workspace_learn_us = 1'000'000;
    ring = std::make_unique<Ring>(parameters);
    while (ring->time_s() < 0.9) ASSERT_FALSE(ring->step()) << ring->where();
  }
  void settle_all() {
    while (ring->time_s() < 1.5) ASSERT_FALSE(ring->step()) << ring->where();
  }
  // The farthest watched column with so many points of either lidar, its neighbours watched too; -1: none.
  int column(bool met) const {
    for (int ix = SK_MAP_CELLS - 2; ix > SK_MAP_CELLS / 2; --ix) {
      const std::uint32_t most = std::max(ring->watch.histogram(1)->observed[kRow][ix], ring->watch.histogram(2)->observed[kRow][ix]);
      if (ring->watch.rules(0).watched[kRow][ix + 1] != 0 && (met ? most >= SK_HISTOGRAM_ENOUGH : most == 0)) return ix;
    }
    return -1;
  }
  static std::int32_t middle(int index) { return SK_MAP_ORIGIN_MM + SK_CELL_MM * index + SK_CELL_MM / 2; }
  void scanners_see(int iy, int ix, std::int32_t z_mm, int points) {
    ScanBlocks blocks{};
    blocks.count = 1;
    blocks.block[0].count = blocks.block[0].used[0] = 1;
    blocks.block[0].point_mm[0][0] = middle(ix);
    blocks.block[0].point_mm[0][1] = middle(iy);
    blocks.block[0].point_mm[0][2] = z_mm;
    for (int i = 0; i < points; ++i) ring->watch.take(blocks, ring->joints, ring->cycle * 10'000);
  }
  std::unique_ptr<Ring> ring;
};

// verifies: SK-WM-68
TEST_F(WatchedRingTest, TheScannersHaveTheLidarsGround) {
  learn();
  settle_all();
  const int ix = column(true);
  ASSERT_GE(ix, 0);
  scanners_see(kRow, ix, 1100, 3);
  EXPECT_TRUE(ring->watch.step(ring->cycle * 10'000));
}

// What stands on ground that the scanners know to lie lower than the lidars' lines is no rise over those lines.
// verifies: SK-WM-68
TEST_F(WatchedRingTest, TheLidarsHaveTheScannersGroundInDigZonesToo) {
  for (const bool known : {true, false}) {
    for (const bool zone : {false, true}) {
      if (zone) parameters.dig_zone[0] = {SK_MAP_ORIGIN_MM, SK_MAP_ORIGIN_MM, -SK_MAP_ORIGIN_MM, -SK_MAP_ORIGIN_MM, -3000, 1000};
      learn();
      const int ix = column(false);
      ASSERT_GE(ix, 0);
      for (int y = kRow - 1; known && y <= kRow + 1; ++y)
        for (int x = ix - 1; x <= ix + 1; ++x) scanners_see(y, x, -1500, SK_HISTOGRAM_ENOUGH);
      settle_all();
      ring->scene.people = {{middle(ix) * 1e-3 + 0.15, middle(kRow) * 1e-3, 0.25, 0.4, ring->time_s()}};
      bool stops = false;
      for (int i = 0; i < 50 && !stops; ++i) stops = ring->step();
      EXPECT_EQ(stops, known) << "in a dig zone: " << zone;
    }
  }
}

}  // namespace
}  // namespace berm::kernel::test
