// MergeCell: what each version takes over, and what it does not.
#include <gtest/gtest.h>

#include <algorithm>

#include "monitor_scene.hpp"

namespace berm::core_test {
namespace {

MonitorCell merged(bool continuous, const MonitorCell& before, int temporary, std::int32_t new_mm) {
  MonitorScene scene(continuous);
  scene.accumulated(50, 50, before);
  scene.temporary(50, 50, temporary, new_mm);
  EXPECT_TRUE(sk_merge_cell(scene.monitor.get(), scene.rules.get(), 50, 50));
  return scene.accumulated(50, 50);
}

constexpr int kMeasured = SK_FLAG_NOT_VISITED, kBetween = SK_FLAG_INTERPOLATED_NOT_VISITED;

// verifies: SK-WM-20
TEST(MonitorMerge, ACellInProgressIsPutOffAndNothingIsMerged) {
  for (const bool continuous : {true, false}) {
    const MonitorCell before{SK_FLAG_OBSTACLE, 0, 1700};
    for (const int flag : {SK_FLAG_EMPTY, SK_FLAG_SET, SK_FLAG_INTERPOLATED}) EXPECT_EQ(merged(continuous, before, flag, 0), before);
  }
}

// verifies: SK-WM-21, SK-WM-22
TEST(MonitorMerge, TheFirstHeightFillsAndTheFirstMeasuredOneReplaces) {
  for (const bool continuous : {true, false}) {
    const MonitorCell empty{SK_FLAG_EMPTY, -20000, -20000}, between{SK_FLAG_INTERPOLATED, 900, -20000};
    EXPECT_EQ(merged(continuous, empty, kMeasured, 300), (MonitorCell{SK_FLAG_SET, 300, -20000}));
    EXPECT_EQ(merged(continuous, empty, kBetween, 300), (MonitorCell{SK_FLAG_INTERPOLATED, 300, -20000}));
    EXPECT_EQ(merged(continuous, between, kMeasured, 300), (MonitorCell{SK_FLAG_SET, 300, -20000}));
    EXPECT_EQ(merged(continuous, between, kMeasured, 1300), (MonitorCell{SK_FLAG_SET, 1300, -20000}));
  }
}

// verifies: SK-WM-23, SK-WM-24, SK-WM-25
TEST(MonitorMerge, HeightsFollowInTheContinuousVersionOnly) {
  const MonitorCell set{SK_FLAG_SET, 900, 0};
  for (const std::int32_t z : {400, 899, 1300}) {
    EXPECT_EQ(merged(true, set, kMeasured, z).height_mm, z);
    EXPECT_EQ(merged(false, set, kMeasured, z).height_mm, 900);
    EXPECT_EQ(merged(true, set, kBetween, z).height_mm, std::min(z, 900)) << "what is interpolated never raises";
    EXPECT_EQ(merged(false, set, kBetween, z).height_mm, 900);
  }
}

// Every flag that an accumulated cell can hold, those that are none as well. The first height of an EMPTY cell raises none.
// verifies: SK-WM-25
TEST(MonitorMerge, AnInterpolatedHeightRaisesNoneWhateverTheCellHolds) {
  const std::int32_t heights[] = {-20000, -600, 0, 249, 251, 499, 501, 900, 1199, 1201, 1700, 2900, 20000};
  for (const bool continuous : {true, false}) {
    MonitorScene scene(continuous);
    int lowered = 0;
    for (int flag = 0; flag < 256; ++flag)
      for (const std::int32_t height : {-600, 0, 900})
        for (const std::int32_t obstacle : {-20000, 900, 1700})
          for (const std::int32_t z : heights) {
            if (flag == SK_FLAG_EMPTY) continue;
            scene.accumulated(50, 50, {flag, height, obstacle});
            scene.temporary(50, 50, kBetween, z);
            ASSERT_TRUE(sk_merge_cell(scene.monitor.get(), scene.rules.get(), 50, 50));
            const MonitorCell after = scene.accumulated(50, 50);
            ASSERT_LE(after.height_mm, height) << flag_name(flag) << ", obstacle " << obstacle << ", interpolated " << z << ", continuous " << continuous;
            ASSERT_EQ(after.obstacle_height_mm, obstacle) << flag_name(flag) << ", interpolated " << z << ", continuous " << continuous;
            lowered += after.height_mm < height;
          }
    EXPECT_GT(lowered, 0) << "the heights were merged";
  }
}

// verifies: SK-WM-26
TEST(MonitorMerge, AChangeIsMarkedAndGoesWithItsHeight) {
  const MonitorCell set{SK_FLAG_SET, 0, 5};
  EXPECT_EQ(merged(true, set, SK_FLAG_CHANGED, 800), (MonitorCell{SK_FLAG_CHANGED, 800, 800}));
  EXPECT_EQ(merged(false, set, SK_FLAG_CHANGED, 800), (MonitorCell{SK_FLAG_CHANGED, 0, 800}));
  const MonitorCell followed{SK_FLAG_CHANGED, 800, 800}, kept{SK_FLAG_CHANGED, 0, 800};
  EXPECT_EQ(merged(true, followed, kMeasured, 300), (MonitorCell{SK_FLAG_CHANGED, 300, 800}));
  EXPECT_EQ(merged(true, followed, kMeasured, 299), (MonitorCell{SK_FLAG_SET, 299, 800}));
  EXPECT_EQ(merged(false, kept, kMeasured, 250), kept);
  EXPECT_EQ(merged(false, kept, kMeasured, 249), (MonitorCell{SK_FLAG_SET, 0, 800}));
  EXPECT_EQ(merged(false, kept, kMeasured, -70), (MonitorCell{SK_FLAG_SET, -70, 800})) << "what clears may lower";
}

// verifies: SK-WM-27
TEST(MonitorMerge, AnObstacleKeepsTheHeightBeforeItAndItsOwnGreatest) {
  for (const bool continuous : {true, false}) {
    const MonitorCell set{SK_FLAG_SET, 100, 5000};
    const MonitorCell there = merged(continuous, set, SK_FLAG_OBSTACLE, 1700);
    EXPECT_EQ(there, (MonitorCell{SK_FLAG_OBSTACLE, 100, 1700}));
    EXPECT_EQ(merged(continuous, there, SK_FLAG_OBSTACLE, 1500), there);
    EXPECT_EQ(merged(continuous, there, SK_FLAG_OBSTACLE, 1900), (MonitorCell{SK_FLAG_OBSTACLE, 100, 1900}));
    EXPECT_EQ(merged(continuous, there, SK_FLAG_CHANGED, 1900), (MonitorCell{SK_FLAG_OBSTACLE, 100, 1900})) << "it is none the less one";
    EXPECT_EQ(merged(continuous, there, 0, 1900), (MonitorCell{SK_FLAG_OBSTACLE, 100, 1900})) << "no flag counts as an obstacle";
  }
}

// verifies: SK-WM-28
TEST(MonitorMerge, AnObstacleLeavesAtItsHeightCondition) {
  for (const int kind : {kMeasured, kBetween}) {
    // Figure 7: lower than the obstacle by more than the threshold, and no rise over what was there before.
    EXPECT_EQ(merged(true, {SK_FLAG_OBSTACLE, 100, 1700}, kind, 600), (MonitorCell{SK_FLAG_SET, kind == kMeasured ? 600 : 100, 1700}));
    EXPECT_EQ(merged(true, {SK_FLAG_OBSTACLE, 100, 1700}, kind, 601).flag, SK_FLAG_OBSTACLE);
    EXPECT_EQ(merged(true, {SK_FLAG_OBSTACLE, 100, 700}, kind, 200).flag, SK_FLAG_OBSTACLE);
    EXPECT_EQ(merged(true, {SK_FLAG_OBSTACLE, 100, 700}, kind, 199).flag, SK_FLAG_SET);
    // Figure 8: near the height before.
    EXPECT_EQ(merged(false, {SK_FLAG_OBSTACLE, 100, 1700}, kind, 350).flag, SK_FLAG_OBSTACLE);
    EXPECT_EQ(merged(false, {SK_FLAG_OBSTACLE, 100, 1700}, kind, 349), (MonitorCell{SK_FLAG_SET, 100, 1700}));
    EXPECT_EQ(merged(false, {SK_FLAG_OBSTACLE, 100, 1700}, kind, 40), (MonitorCell{SK_FLAG_SET, 40, 1700}));
  }
}

}  // namespace
}  // namespace berm::core_test
