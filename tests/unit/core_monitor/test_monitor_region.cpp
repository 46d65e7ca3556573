// The safety region: its circle, and that an obstacle in any of its cells is found.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <utility>

#include "monitor_scene.hpp"

namespace berm::core_test {
namespace {

// verifies: SK-WM-40
TEST(MonitorRegion, TheCircleIsOfEveryCellThatHasAPointInIt) {
  const auto rules = monitor_rules(true);
  for (const std::int64_t radius : {1, 299, 300, 301, 12'000, 15'000, 15'600, 22'100, 32'000}) {
    ASSERT_TRUE(sk_watch_circle(rules.get(), static_cast<std::int32_t>(radius)));
    for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
        const std::int64_t low_x = -15600 + 300 * ix, low_y = -15600 + 300 * iy;
        const std::int64_t x = std::clamp<std::int64_t>(0, low_x, low_x + 300), y = std::clamp<std::int64_t>(0, low_y, low_y + 300);
        ASSERT_EQ(rules->watched[iy][ix] != 0, x * x + y * y <= radius * radius) << radius << " " << iy << " " << ix;
      }
  }
}

// verifies: SK-WM-40
TEST(MonitorRegion, ARadiusOutOfRangeChangesNothing) {
  const auto rules = monitor_rules(true);
  ASSERT_TRUE(sk_watch_circle(rules.get(), 5000));
  const auto before = std::make_unique<sk_monitor_rules>(*rules);
  for (const std::int32_t radius : {std::numeric_limits<std::int32_t>::min(), -1, 0, 32001, std::numeric_limits<std::int32_t>::max()})
    EXPECT_FALSE(sk_watch_circle(rules.get(), radius)) << radius;
  EXPECT_EQ(std::memcmp(rules.get(), before.get(), sizeof *rules), 0);
}

// verifies: SK-WM-41
TEST(MonitorRegion, AnObstacleStopsInEveryWatchedCellAndInNoOther) {
  MonitorScene scene(true);
  scene.ground(0);
  sk_watch_circle(scene.rules.get(), 12'000);
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix)
      for (const int flag : std::initializer_list<int>{SK_FLAG_OBSTACLE, 0x00, SK_FLAG_NOT_VISITED}) {
        scene.accumulated(iy, ix, {flag, 0, 0});
        const bool found = sk_find_obstacle(scene.monitor.get(), scene.rules.get(), &scene.where);
        ASSERT_EQ(found, scene.rules->watched[iy][ix] != 0) << iy << " " << ix;
        ASSERT_EQ(scene.where.iy, found ? iy : -1);
        ASSERT_EQ(scene.where.ix, found ? ix : -1);
        scene.accumulated(iy, ix, {SK_FLAG_CHANGED, 0, 0});
      }
  EXPECT_FALSE(sk_find_obstacle(scene.monitor.get(), scene.rules.get(), &scene.where));
}

// verifies: SK-WM-46
TEST(MonitorRegion, AnExcludedCellStopsNoMoreAndEveryOtherStill) {
  MonitorScene scene(true);
  scene.ground(0);
  ASSERT_TRUE(sk_watch_circle(scene.rules.get(), 12'000));
  for (const auto& [iy, ix] : std::initializer_list<std::pair<int, int>>{{52, 52}, {52, 53}, {20, 60}, {0, 0}, {103, 103}, {52, 52}}) {
    const auto expected = std::make_unique<sk_monitor_rules>(*scene.rules);
    expected->watched[iy][ix] = 0;
    EXPECT_TRUE(sk_region_exclude(scene.rules.get(), iy, ix));
    EXPECT_EQ(std::memcmp(scene.rules.get(), expected.get(), sizeof *expected), 0) << iy << " " << ix;
  }
  const auto found = [&scene](int iy, int ix) {
    scene.accumulated(iy, ix, {SK_FLAG_OBSTACLE, 0, 1700});
    const bool stops = sk_find_obstacle(scene.monitor.get(), scene.rules.get(), &scene.where);
    scene.accumulated(iy, ix, {SK_FLAG_SET, 0, 0});
    return stops;
  };
  EXPECT_FALSE(found(52, 53));
  EXPECT_TRUE(found(53, 52));
  EXPECT_TRUE(found(52, 54));
  ASSERT_TRUE(sk_watch_circle(scene.rules.get(), 12'000));
  EXPECT_TRUE(found(52, 53)) << "the circle puts it back";
}

// verifies: SK-WM-46
TEST(MonitorRegion, ACellOutsideTheMapIsNotExcluded) {
  const auto rules = monitor_rules(true);
  const auto before = std::make_unique<sk_monitor_rules>(*rules);
  constexpr std::int32_t kLow = std::numeric_limits<std::int32_t>::min(), kHigh = std::numeric_limits<std::int32_t>::max();
  for (const std::int32_t out : {kLow, -1, SK_MAP_CELLS, kHigh})
    for (const std::int32_t in : {0, 103}) {
      EXPECT_FALSE(sk_region_exclude(rules.get(), out, in)) << out;
      EXPECT_FALSE(sk_region_exclude(rules.get(), in, out)) << out;
    }
  EXPECT_EQ(std::memcmp(rules.get(), before.get(), sizeof *rules), 0);
}

}  // namespace
}  // namespace berm::core_test
