// The monitor as the kernel's cycle is to call it: points, steps, stop.
#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <functional>
#include <iostream>
#include <limits>

#include "monitor_scene.hpp"

namespace berm::core_test {
namespace {

class WorkspaceMonitor : public testing::TestWithParam<bool> {
 protected:
  WorkspaceMonitor() : scene(GetParam()) { sweep(); }
  // Everything is seen once, at this height, but the person.
  void sweep() {
    for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (int ix = 0; ix < SK_MAP_CELLS; ++ix) scene.see(iy, ix, person_iy == iy && person_ix == ix ? 1700 : 0);
    stop = scene.settle();
  }

  int person_iy = -1, person_ix = -1;
  bool stop = true;
  MonitorScene scene;
};

// verifies: SK-WM-21, SK-WM-41, SK-WM-42
TEST_P(WorkspaceMonitor, APersonWhoComesStopsAndOneWhoLeavesLetsGoAfterTheDwell) {
  EXPECT_FALSE(stop);
  person_iy = 30;
  person_ix = 40;
  sweep();
  EXPECT_TRUE(stop);
  EXPECT_EQ(scene.where.iy, 30);
  EXPECT_EQ(scene.where.ix, 40);
  sweep();
  EXPECT_TRUE(stop) << "stands still";
  person_ix = 41;
  sweep();
  EXPECT_TRUE(stop);
  EXPECT_EQ(scene.accumulated(30, 40).flag, SK_FLAG_SET) << "left this cell";
  EXPECT_EQ(scene.accumulated(30, 41).flag, SK_FLAG_OBSTACLE);
  const std::int64_t last_us = scene.now_us;
  person_iy = -1;
  sweep();
  EXPECT_TRUE(stop) << "dwells";
  EXPECT_EQ(scene.where.iy, -1);
  while (scene.step()) ASSERT_LT(scene.now_us, last_us + kPeriod + kDwell);
  EXPECT_EQ(scene.now_us, last_us + kPeriod + kDwell) << "seen last at the update before the merge";
}

// verifies: SK-WM-41
TEST_P(WorkspaceMonitor, OutsideTheRegionAnObstacleStopsNothing) {
  berm_parameters region{};
  region.own_body_radius_mm = 1'000;
  region.workspace_radius_mm = 5'000;
  sk_watch_region(scene.rules.get(), &region, true);
  person_iy = person_ix = 20;
  sweep();
  EXPECT_FALSE(stop);
  EXPECT_EQ(scene.accumulated(20, 20).flag, SK_FLAG_OBSTACLE);
  region.workspace_radius_mm = 15'000;
  sk_watch_region(scene.rules.get(), &region, true);
  EXPECT_TRUE(sk_monitor_step(scene.monitor.get(), scene.rules.get(), scene.now_us, &scene.where)) << "the region is asked at every step";
}

// verifies: SK-WM-43
TEST_P(WorkspaceMonitor, UpdatesWhenThePeriodHasPassedOrTimeRanBackwards) {
  scene.see(50, 50, 0);
  const auto flag_after = [&](std::int64_t now_us) {
    sk_monitor_step(scene.monitor.get(), scene.rules.get(), now_us, &scene.where);
    return scene.temporary_flag(50, 50);
  };
  EXPECT_EQ(flag_after(scene.now_us + kPeriod - 1), SK_FLAG_SET);
  EXPECT_EQ(flag_after(scene.now_us + kPeriod), SK_FLAG_NOT_VISITED);
  EXPECT_EQ(flag_after(scene.now_us), SK_FLAG_EMPTY);
}

// verifies: SK-WM-44
TEST_P(WorkspaceMonitor, RulesThatDoNotFitStopAndChangeNothing) {
  const sk_monitor_rules good = *scene.rules;
  const auto before = std::make_unique<sk_monitor>(*scene.monitor);
  const auto misfit = [&](const std::function<void(sk_monitor_rules&)>& spoil) {
    *scene.rules = good;
    spoil(*scene.rules);
    const bool stops = sk_monitor_step(scene.monitor.get(), scene.rules.get(), scene.now_us + kPeriod, &scene.where);
    return stops && std::memcmp(scene.monitor.get(), before.get(), sizeof *before) == 0;
  };
  for (const std::int32_t bad : {std::numeric_limits<std::int32_t>::min(), -1, 0, 20001, std::numeric_limits<std::int32_t>::max()}) {
    EXPECT_TRUE(misfit([bad](sk_monitor_rules& r) { r.height_threshold_mm = bad; })) << bad;
    EXPECT_TRUE(misfit([bad](sk_monitor_rules& r) { r.neighbour_threshold_mm = bad; })) << bad;
    EXPECT_TRUE(misfit([bad](sk_monitor_rules& r) { r.slope_threshold_mm = bad; })) << bad;
  }
  EXPECT_TRUE(misfit([](sk_monitor_rules& r) { r.wait_us = -1; }));
  EXPECT_TRUE(misfit([](sk_monitor_rules& r) { r.wait_us = 60'000'001; }));
  EXPECT_TRUE(misfit([](sk_monitor_rules& r) { r.period_us = 0; }));
  EXPECT_TRUE(misfit([](sk_monitor_rules& r) { r.period_us = 10'000'001; }));
  EXPECT_TRUE(misfit([](sk_monitor_rules& r) { r.dwell_us = -1; }));
  EXPECT_TRUE(misfit([](sk_monitor_rules& r) { r.dwell_us = 60'000'001; }));
  *scene.rules = good;
  EXPECT_TRUE(sk_monitor_step(scene.monitor.get(), scene.rules.get(), -1, &scene.where));
  EXPECT_EQ(std::memcmp(scene.monitor.get(), before.get(), sizeof *before), 0);
  EXPECT_FALSE(sk_monitor_step(scene.monitor.get(), scene.rules.get(), scene.now_us + kPeriod, &scene.where));
}

// A sweep goes on while the map is updated: what was scanned first stops before the sweep has ended.
// verifies: SK-WM-15, SK-WM-20
TEST_P(WorkspaceMonitor, UpdatesWhileTheSweepGoesOn) {
  int stopped_at_column = -1;
  for (int ix = 0; ix < SK_MAP_CELLS && stopped_at_column < 0; ++ix) {
    for (int iy = 0; iy < SK_MAP_CELLS; ++iy) scene.see(iy, ix, iy == 50 && ix == 20 ? 1700 : 0);
    if (ix % 4 == 3 && scene.step()) stopped_at_column = ix;
  }
  EXPECT_EQ(stopped_at_column, 27);
}

// verifies: SK-WM-45
TEST_P(WorkspaceMonitor, TheWorkOfAStepIsPrinted) {
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) scene.see(iy, ix, 1700);
  for (const char* what : {"all put off", "all judged and merged", "nothing modified"}) {
    const auto begin = std::chrono::steady_clock::now();
    scene.step();
    const auto took = std::chrono::steady_clock::now() - begin;
    std::cout << what << ": " << std::chrono::duration_cast<std::chrono::microseconds>(took).count() << " us\n";
  }
  EXPECT_EQ(scene.monitor->modified, 0);
}

INSTANTIATE_TEST_SUITE_P(Versions, WorkspaceMonitor, testing::Bool(), [](const auto& version) { return version.param ? "Figure7" : "Figure8"; });

}  // namespace
}  // namespace berm::core_test
