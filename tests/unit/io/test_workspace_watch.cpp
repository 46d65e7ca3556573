// What the Workspace Monitor is fed, and when a lane is watched.
#include "io/workspace_watch.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "core/height_map.h"
#include "mini_machine.hpp"

namespace berm::kernel::test {
namespace {

constexpr std::int64_t kNow = 1000000;

class WorkspaceWatchTest : public testing::Test {
 protected:
  WorkspaceWatchTest() {
    parameters = berm::test::demo_parameters();
    parameters.workspace_watched = 1;
    parameters.dig_zones = parameters.truck_zones = 0;
    parameters.lanes = 1;
    parameters.lane[0] = {-15000, 6000, 15000, 9000};
    watch = std::make_unique<WorkspaceWatch>(parameters);
  }
  // Returns of one scanline, the first with this number.
  void see(std::initializer_list<sk_point> points, int first, std::uint32_t scanline = 7, int dropped = -1) {
    blocks->count = 1;
    berm_scan_block& block = blocks->block[0];
    block = berm_scan_block{};
    block.scanline = scanline;
    block.first_index = static_cast<std::uint16_t>(first);
    for (const sk_point& p : points) {
      block.used[block.count] = block.count == dropped ? 0 : 1;
      block.point_mm[block.count][0] = p.x_mm;
      block.point_mm[block.count][1] = p.y_mm;
      block.point_mm[block.count][2] = p.z_mm;
      ++block.count;
    }
    watch->take(*blocks, joints, kNow);
  }
  int flag(std::int32_t x_mm, std::int32_t y_mm) const { return watch->monitor().temporary_flag[sk_map_index(y_mm)][sk_map_index(x_mm)]; }
  int height(std::int32_t x_mm, std::int32_t y_mm) const { return watch->monitor().highest_mm[sk_map_index(y_mm)][sk_map_index(x_mm)]; }
  bool watched(std::int32_t x_mm, std::int32_t y_mm) const { return watch->rules().watched[sk_map_index(y_mm)][sk_map_index(x_mm)] != 0; }

  berm_parameters parameters{};
  JointHistory joints;
  std::unique_ptr<WorkspaceWatch> watch;
  std::unique_ptr<ScanBlocks> blocks = std::make_unique<ScanBlocks>();
};

// verifies: SK-WM-52
TEST_F(WorkspaceWatchTest, ReturnsAndTheLineBetweenThoseThatFollowOneAnother) {
  see({{5050, 3050, 0}, {8050, 3050, 1000}}, 100);
  EXPECT_EQ(flag(5050, 3050), SK_FLAG_SET);
  EXPECT_EQ(flag(8050, 3050), SK_FLAG_SET);
  for (std::int32_t x = 5350; x < 8000; x += 300) {
    EXPECT_EQ(flag(x, 3050), SK_FLAG_INTERPOLATED) << x;
    EXPECT_NEAR(height(x, 3050), (x - 5050) / 3.0, 60) << x;
  }
  EXPECT_EQ(flag(8350, 3050), SK_FLAG_EMPTY);
  EXPECT_EQ(flag(4750, 3050), SK_FLAG_EMPTY);
  see({{8050, 5950, 1000}}, 102);
  EXPECT_EQ(flag(8050, 4500), SK_FLAG_INTERPOLATED) << "across blocks";
}

// verifies: SK-WM-52
TEST_F(WorkspaceWatchTest, NoLineOverADroppedReturnNorFromAnotherScanlineOrScanner) {
  see({{5050, 3050, 0}, {6000, 3050, 0}, {8050, 3050, 0}}, 100, 7, 1);
  EXPECT_EQ(flag(6050, 3050), SK_FLAG_EMPTY) << "what is not in the height map is not fed, and cuts the line";
  see({{5050, 5050, 0}}, 103, 8);
  EXPECT_EQ(flag(6550, 4050), SK_FLAG_EMPTY) << "another scanline";
  blocks->block[0].scanner = 1;
  blocks->block[0].first_index = 104;
  blocks->block[0].point_mm[0][0] = 9050;
  watch->take(*blocks, joints, kNow);
  EXPECT_EQ(flag(7050, 5050), SK_FLAG_EMPTY) << "another scanner";
  EXPECT_EQ(flag(9050, 5050), SK_FLAG_SET);
}

// verifies: SK-WM-53
TEST_F(WorkspaceWatchTest, ALaneChangesOnlyOnAFreshWord) {
  EXPECT_FALSE(watched(4050, 7050)) << "open from the start";
  EXPECT_TRUE(watched(4050, 5050));
  see({{4050, 7050, 0}, {4050, 5050, 0}}, 100);
  watch->trucks(false, true, kNow);
  EXPECT_FALSE(watched(4050, 7050));
  EXPECT_EQ(flag(4050, 7050), SK_FLAG_SET);
  watch->trucks(true, true, kNow);
  EXPECT_TRUE(watched(4050, 7050));
  EXPECT_EQ(flag(4050, 7050), SK_FLAG_EMPTY) << "forgotten";
  EXPECT_EQ(flag(4050, 5050), SK_FLAG_SET) << "beside it nothing is";
  see({{4050, 7050, 0}}, 200);
  watch->trucks(true, true, kNow);
  EXPECT_EQ(flag(4050, 7050), SK_FLAG_SET) << "said again, nothing is forgotten again";
  watch->trucks(false, false, kNow);
  EXPECT_TRUE(watched(4050, 7050)) << "a spotter who fell silent opens nothing";
  watch->trucks(true, false, kNow);
  EXPECT_FALSE(watched(4050, 7050));
}

// verifies: SK-WM-74, SK-WM-75
TEST_F(WorkspaceWatchTest, ItLearnsFromTheBeginAndALaneFromWhenATruckHasParked) {
  EXPECT_TRUE(watch->learns()) << "before the first step";
  EXPECT_FALSE(watch->learns_lanes());
  watch->step(kNow);
  watch->step(kNow + parameters.workspace_learn_us - 1);
  EXPECT_TRUE(watch->learns());
  watch->step(kNow + parameters.workspace_learn_us);
  EXPECT_FALSE(watch->learns());
  const std::int64_t parked = kNow + 2 * std::int64_t{parameters.workspace_learn_us};
  watch->trucks(true, true, parked);
  EXPECT_TRUE(watch->learns_lanes());
  EXPECT_FALSE(watch->learns());
  watch->step(parked + parameters.workspace_learn_us - 1);
  EXPECT_TRUE(watch->learns_lanes());
  watch->step(parked + parameters.workspace_learn_us);
  EXPECT_FALSE(watch->learns_lanes());
  watch->trucks(true, false, parked + parameters.workspace_learn_us);
  EXPECT_FALSE(watch->learns_lanes()) << "open";
  watch->begin();
  EXPECT_TRUE(watch->learns()) << "anew";
}

// verifies: SK-WM-62, SK-WM-63
TEST_F(WorkspaceWatchTest, WithHistogramsTheGroundIsLearnedThenThreePointsStopIt) {
  EXPECT_EQ(watch->histogram(), nullptr);
  parameters.workspace_histogram = 1;
  watch = std::make_unique<WorkspaceWatch>(parameters);
  watch->begin();
  for (int i = 0; i < SK_HISTOGRAM_ENOUGH; ++i) see({{4050, 3050, 0}}, 100);
  see({{4050, 3050, 1600}}, 100);
  EXPECT_FALSE(watch->step(kNow)) << "learning";
  EXPECT_FALSE(watch->step(kNow + parameters.workspace_learn_us));
  EXPECT_EQ(watch->monitor().modified, 0) << "one of the two is fed";
  see({{4050, 3050, 1600}}, 100);
  EXPECT_FALSE(watch->step(kNow + parameters.workspace_learn_us)) << "lone";
  see({{4050, 3050, 1500}}, 100);
  EXPECT_FALSE(watch->step(kNow + parameters.workspace_learn_us)) << "two";
  see({{4050, 3050, 1700}}, 100);
  EXPECT_TRUE(watch->step(kNow + parameters.workspace_learn_us));
  std::int32_t x = 0, y = 0, height = 0;
  ASSERT_TRUE(watch->place(x, y, height));
  EXPECT_EQ(x, 4050);
  EXPECT_EQ(y, 3150);
  EXPECT_EQ(height, 1700);
}

// verifies: SK-WM-63, SK-WM-66
TEST_F(WorkspaceWatchTest, WithHistogramsALaneIsForgottenAndALineIsNoObservation) {
  parameters.workspace_histogram = 1;
  watch = std::make_unique<WorkspaceWatch>(parameters);
  watch->begin();
  const auto cell = [this](auto& of, int x_mm, int y_mm) { return of[sk_map_index(y_mm)][sk_map_index(x_mm)]; };
  see({{4050, 7050, 0}, {4050, 3050, 0}}, 100);
  const sk_monitor_histogram& h = *watch->histogram();
  EXPECT_EQ(cell(h.observed, 4050, 7050), 1U);
  EXPECT_EQ(cell(h.observed, 4050, 5050), 0U);
  EXPECT_GT(cell(h.lines, 4050, 5050), 0);
  watch->step(kNow);
  watch->step(kNow + parameters.workspace_learn_us);
  EXPECT_EQ(cell(h.state, 4050, 7050), SK_CELL_CLEAR);
  watch->trucks(true, true, kNow + parameters.workspace_learn_us);
  EXPECT_EQ(cell(h.state, 4050, 7050), SK_CELL_LEARNING);
  EXPECT_EQ(cell(h.observed, 4050, 7050), 0U);
  EXPECT_EQ(cell(h.state, 4050, 3050), SK_CELL_CLEAR);
  EXPECT_EQ(cell(h.observed, 4050, 3050), 1U);
  watch->step(kNow + 2 * parameters.workspace_learn_us);
  EXPECT_EQ(cell(h.state, 4050, 7050), SK_CELL_CLEAR);
}

// A truck that comes while the map is learned, as after every bench move, is learned as long as any other. Two lanes side by side and one across them.
// verifies: SK-WM-55
TEST_F(WorkspaceWatchTest, ATruckThatComesWhileTheMapIsLearnedIsLearnedToItsEnd) {
  parameters.workspace_histogram = 1;
  parameters.lanes = 3;
  parameters.lane[1] = {-15000, -9000, -6000, -6000};
  parameters.lane[2] = {3010, -9000, 6000, 12000};
  watch = std::make_unique<WorkspaceWatch>(parameters);
  watch->begin();
  watch->step(kNow);
  const std::int64_t came = kNow + parameters.workspace_learn_us / 2;
  watch->trucks(true, true, came);
  const sk_monitor_histogram& h = *watch->histogram();
  const auto expect = [&](std::int64_t now, int in_lanes) {
    watch->step(now);
    for (std::int32_t iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (std::int32_t ix = 0; ix < SK_MAP_CELLS; ++ix) {
        bool lane = false;
        for (int i = 0; i < parameters.lanes; ++i)
          lane = lane || sk_is_touched(iy, ix, parameters.lane[i].x_low_mm, parameters.lane[i].y_low_mm, parameters.lane[i].x_high_mm, parameters.lane[i].y_high_mm);
        ASSERT_EQ(h.state[iy][ix], lane ? in_lanes : SK_CELL_CLEAR) << iy << ' ' << ix << " at " << now;
      }
  };
  expect(kNow + parameters.workspace_learn_us, SK_CELL_LEARNING);
  expect(came + parameters.workspace_learn_us - 1, SK_CELL_LEARNING);
  expect(came + parameters.workspace_learn_us, SK_CELL_CLEAR);
}

// The plain version's rims, as well.
// verifies: SK-WM-55
TEST_F(WorkspaceWatchTest, OfATruckThatComesWhileTheMapIsLearnedNothingIsSettledBefore) {
  watch->begin();
  watch->step(kNow);
  const std::int64_t came = kNow + parameters.workspace_learn_us / 2;
  watch->trucks(true, true, came);
  auto& flags = const_cast<sk_monitor&>(watch->monitor()).accumulated_flag;
  const auto at = [&flags](std::int32_t x_mm, std::int32_t y_mm) -> auto& { return flags[sk_map_index(y_mm)][sk_map_index(x_mm)]; };
  at(4050, 7050) = at(4050, 3050) = SK_FLAG_CHANGED;
  watch->step(kNow + parameters.workspace_learn_us);
  EXPECT_EQ(at(4050, 3050), SK_FLAG_SET);
  EXPECT_EQ(at(4050, 7050), SK_FLAG_CHANGED);
  watch->step(came + parameters.workspace_learn_us);
  EXPECT_EQ(at(4050, 7050), SK_FLAG_SET);
}

}  // namespace
}  // namespace berm::kernel::test
