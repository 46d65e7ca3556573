// Cells that are emptied, because their ground is known to have become another one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <utility>

#include "core/monitor_forget.h"
#include "monitor_scene.hpp"

namespace berm::core_test {
namespace {

class MonitorForget : public testing::TestWithParam<bool> {
 protected:
  MonitorForget() : scene(GetParam()) { scene.ground(0); }
  bool forget(int iy, int ix) { return sk_monitor_forget(scene.monitor.get(), iy, ix); }
  bool see_and_settle(int iy, int ix, int z_mm) {
    scene.see(iy, ix, z_mm);
    return scene.settle();
  }
  MonitorScene scene;
};

const MonitorCell kForgotten{SK_FLAG_EMPTY, -20000, -20000};

// verifies: SK-WM-8
TEST_P(MonitorForget, WhatStandsInAForgottenCellIsItsGround) {
  ASSERT_TRUE(see_and_settle(50, 60, 2500)) << "a truck came";
  ASSERT_EQ(scene.accumulated(50, 60).flag, SK_FLAG_OBSTACLE);
  EXPECT_TRUE(forget(50, 60));
  EXPECT_EQ(scene.accumulated(50, 60), kForgotten);
  EXPECT_TRUE(see_and_settle(50, 60, 2500)) << "until the dwell has passed";
  EXPECT_EQ(scene.where.iy, -1);
  EXPECT_EQ(scene.accumulated(50, 60).flag, SK_FLAG_SET);
  EXPECT_EQ(scene.accumulated(50, 60).height_mm, 2500);
  scene.now_us += kDwell;
  EXPECT_FALSE(see_and_settle(50, 60, 2500));
  EXPECT_TRUE(see_and_settle(50, 60, 2500 + kHeightThreshold + 1)) << "and what rises over the truck is an obstacle";
  EXPECT_EQ(scene.where.iy, 50);
  EXPECT_EQ(scene.where.ix, 60);
}

// verifies: SK-WM-8
TEST_P(MonitorForget, NoOtherCellAndNothingElseChanges) {
  for (const auto& [iy, ix] : std::initializer_list<std::pair<int, int>>{{0, 0}, {0, 103}, {103, 0}, {103, 103}, {50, 51}, {51, 50}}) {
    for (int j = 0; j < SK_MAP_CELLS; ++j)
      for (int i = j % 5; i < SK_MAP_CELLS; i += 5) scene.temporary(j, i, SK_FLAG_SET, 10 * i - j);
    const auto expected = std::make_unique<sk_monitor>(*scene.monitor);
    expected->temporary_flag[iy][ix] = SK_FLAG_EMPTY;
    expected->highest_mm[iy][ix] = expected->second_mm[iy][ix] = SK_NO_HEIGHT;
    expected->accumulated_flag[iy][ix] = SK_FLAG_EMPTY;
    expected->height_mm[iy][ix] = expected->obstacle_height_mm[iy][ix] = -20000;
    EXPECT_TRUE(forget(iy, ix));
    EXPECT_EQ(std::memcmp(scene.monitor.get(), expected.get(), sizeof *expected), 0) << iy << " " << ix;
  }
}

// verifies: SK-WM-8
TEST_P(MonitorForget, OfARectangleEveryCellThatItTouchesAndNoOther) {
  struct { std::int32_t x_low, y_low, x_high, y_high; } rectangles[] = {{-3000, 600, 900, 1500}, {-2999, 601, 899, 1499}, {5, 5, 6, 6}, {-15600, -15600, 15600, 15600},
                                                                       {20000, 0, 30000, 300}};
  for (const auto& r : rectangles) {
    scene.ground(0);
    const auto before = std::make_unique<sk_monitor>(*scene.monitor);
    sk_forget_rectangle(scene.monitor.get(), r.x_low, r.y_low, r.x_high, r.y_high);
    for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
        const std::int32_t x = -15600 + 300 * ix, y = -15600 + 300 * iy;
        const bool touches = std::max(x, r.x_low) <= std::min(x + 300, r.x_high) && std::max(y, r.y_low) <= std::min(y + 300, r.y_high);
        ASSERT_EQ(scene.accumulated(iy, ix), (touches ? kForgotten : MonitorCell{before->accumulated_flag[iy][ix], before->height_mm[iy][ix],
                                                                                 before->obstacle_height_mm[iy][ix]}))
            << r.x_low << " " << iy << " " << ix;
      }
  }
}

// verifies: SK-WM-8
TEST_P(MonitorForget, OutsideTheMapNothingChanges) {
  scene.see(0, 0, 1000);
  scene.see(103, 103, 1000);
  const auto before = std::make_unique<sk_monitor>(*scene.monitor);
  constexpr int kLow = std::numeric_limits<std::int32_t>::min(), kHigh = std::numeric_limits<std::int32_t>::max();
  for (const int out : {kLow, -1, SK_MAP_CELLS, kHigh})
    for (const int in : {0, 103}) {
      EXPECT_FALSE(forget(out, in)) << out;
      EXPECT_FALSE(forget(in, out)) << out;
    }
  EXPECT_FALSE(forget(kLow, kHigh));
  EXPECT_EQ(std::memcmp(scene.monitor.get(), before.get(), sizeof *before), 0);
}

// verifies: SK-WM-8, SK-WM-30
TEST_P(MonitorForget, TheEntryThatStaysInTheListDoesNothingAndLeaves) {
  scene.see(20, 20, 1700);
  scene.see(30, 30, 1700);
  scene.see(40, 40, 1700);
  EXPECT_TRUE(forget(30, 30));
  EXPECT_EQ(scene.monitor->modified, 3);
  scene.step();
  EXPECT_EQ(scene.monitor->modified, 2);
  EXPECT_TRUE(scene.step());
  EXPECT_EQ(scene.monitor->modified, 0);
  EXPECT_EQ(scene.accumulated(20, 20).flag, SK_FLAG_OBSTACLE);
  EXPECT_EQ(scene.accumulated(30, 30), kForgotten);
  EXPECT_EQ(scene.accumulated(40, 40).flag, SK_FLAG_OBSTACLE);
}

// verifies: SK-WM-8
TEST_P(MonitorForget, SeenAgainBeforeTheUpdateItIsListedOnceAndDatedAnew) {
  scene.see(30, 30, 1700);
  EXPECT_TRUE(forget(30, 30));
  scene.now_us += 7;
  scene.see(30, 30, 300, 1);
  EXPECT_EQ(scene.monitor->modified, 1);
  EXPECT_EQ(scene.monitor->began_us[30][30], scene.now_us);
  scene.settle();
  EXPECT_EQ(scene.accumulated(30, 30).flag, SK_FLAG_SET);
  EXPECT_EQ(scene.accumulated(30, 30).height_mm, 300) << "and no point from before counts";
}

// As after motion of the base: the whole map, with more cells modified than the list holds.
// verifies: SK-WM-7, SK-WM-8
TEST_P(MonitorForget, TheWholeMapIsLearntAnewAndTheStopDwells) {
  ASSERT_TRUE(see_and_settle(10, 10, 1700));
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) scene.see(iy, ix, 100);
  ASSERT_TRUE(scene.monitor->overflowed);
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) ASSERT_TRUE(forget(iy, ix));
  EXPECT_TRUE(scene.step()) << "dwells";
  EXPECT_FALSE(scene.monitor->overflowed);
  EXPECT_EQ(scene.monitor->modified, 0);
  scene.now_us += kDwell;
  EXPECT_FALSE(scene.step());
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
      ASSERT_EQ(scene.accumulated(iy, ix), kForgotten) << iy << " " << ix;
      scene.see(iy, ix, 2000);
    }
  EXPECT_FALSE(scene.settle()) << "other ground is no obstacle";
  EXPECT_TRUE(see_and_settle(50, 50, 2000 + kHeightThreshold + 1)) << "who comes then is one";
}

// What the requirements warn of: EMPTY neighbours excuse a rise (SK-WM-13).
// verifies: SK-WM-13
TEST_P(MonitorForget, BesideTwoForgottenCellsARiseIsNoObstacle) {
  EXPECT_TRUE(forget(50, 50));
  EXPECT_TRUE(forget(50, 52));
  see_and_settle(50, 51, 1700);
  EXPECT_EQ(scene.accumulated(50, 51).flag, SK_FLAG_CHANGED);
  EXPECT_TRUE(see_and_settle(60, 51, 1700));
}

INSTANTIATE_TEST_SUITE_P(Versions, MonitorForget, testing::Bool(), [](const auto& version) { return version.param ? "Figure7" : "Figure8"; });

}  // namespace
}  // namespace berm::core_test
