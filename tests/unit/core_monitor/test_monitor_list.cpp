// The list of modified cells: none twice, none lost, also when there are more than it holds.
#include <gtest/gtest.h>

#include <set>

#include "core/monitor_list.h"
#include "monitor_scene.hpp"

namespace berm::core_test {
namespace {

std::set<std::pair<int, int>> listed(const sk_monitor& m) {
  std::set<std::pair<int, int>> cells;
  for (int k = 0; k < m.modified; ++k)
    EXPECT_TRUE(cells.emplace(static_cast<int>(m.modified_iy[k]), static_cast<int>(m.modified_ix[k])).second) << "twice";
  return cells;
}

// verifies: SK-WM-7
TEST(MonitorList, HasEachModifiedCellOnce) {
  MonitorScene scene(true);
  for (int round = 0; round < 3; ++round)
    for (int i = 0; i < SK_MAP_CELLS; ++i) scene.see(i, 103 - i, 10 * i);
  EXPECT_EQ(listed(*scene.monitor).size(), 104u);
  EXPECT_FALSE(scene.monitor->overflowed);
}

// verifies: SK-WM-7, SK-WM-30
TEST(MonitorList, WhatIsMergedLeavesAndWhatIsInProgressStays) {
  MonitorScene scene(true);
  for (int i = 0; i < 50; ++i) scene.see(i, i, 0);
  scene.step();
  for (int i = 0; i < 50; i += 2) scene.see(i, i, 0);
  scene.step();
  std::set<std::pair<int, int>> expected;
  for (int i = 0; i < 50; i += 2) expected.emplace(i, i);
  EXPECT_EQ(listed(*scene.monitor), expected);
  scene.step();
  EXPECT_EQ(scene.monitor->modified, 0);
}

// verifies: SK-WM-7
TEST(MonitorList, RemovalKeepsAllOthersWhateverIsRemoved) {
  for (int removed = 0; removed < 5; ++removed) {
    MonitorScene scene(true);
    for (int i = 0; i < 5; ++i) sk_list_add(scene.monitor.get(), i, 2 * i);
    sk_list_remove(scene.monitor.get(), removed);
    std::set<std::pair<int, int>> expected;
    for (int i = 0; i < 5; ++i)
      if (i != removed) expected.emplace(i, 2 * i);
    EXPECT_EQ(listed(*scene.monitor), expected);
    for (int k = 0; k < 4; ++k) EXPECT_EQ(scene.monitor->place[scene.monitor->modified_iy[k]][scene.monitor->modified_ix[k]], static_cast<unsigned>(k));
  }
}

// verifies: SK-WM-7, SK-WM-41
TEST(MonitorList, AFullListLosesNoObstacle) {
  for (const bool continuous : {true, false}) {
    MonitorScene scene(continuous);
    scene.ground(0);
    for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (int ix = 0; ix < SK_MAP_CELLS; ++ix) scene.see(iy, ix, iy == 100 && ix == 100 ? 1700 : 0);
    EXPECT_TRUE(scene.monitor->overflowed);
    EXPECT_EQ(scene.monitor->modified, SK_MODIFIED_MOST);
    EXPECT_FALSE(scene.step());
    EXPECT_TRUE(scene.monitor->overflowed) << "all are put off, so the list overflows again";
    EXPECT_TRUE(scene.step());
    EXPECT_EQ(scene.accumulated(100, 100).flag, SK_FLAG_OBSTACLE);
    EXPECT_EQ(scene.where.iy, 100);
    EXPECT_EQ(scene.where.ix, 100);
    EXPECT_FALSE(scene.monitor->overflowed);
    EXPECT_EQ(scene.monitor->modified, 0);
  }
}

}  // namespace
}  // namespace berm::core_test
