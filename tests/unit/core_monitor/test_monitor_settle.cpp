// What changed while the ground was learned becomes ground.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "core/monitor_settle.h"
#include "monitor_scene.hpp"

namespace berm::core_test {
namespace {

class MonitorSettle : public testing::TestWithParam<bool> {
 protected:
  MonitorSettle() : scene(GetParam()) { scene.ground(0); }
  MonitorScene scene;
};

// verifies: SK-WM-9
TEST_P(MonitorSettle, ChangedCellsOfTheRectangleAreSetAndNothingElseChanges) {
  constexpr int kFlags[] = {SK_FLAG_EMPTY, SK_FLAG_SET, SK_FLAG_INTERPOLATED, SK_FLAG_CHANGED, SK_FLAG_OBSTACLE, 0xFF};
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) scene.accumulated(iy, ix, {kFlags[(7 * iy + ix) % 6], 10 * iy - ix, 1000 + iy});
  scene.see(50, 50, 1700);
  const auto expected = std::make_unique<sk_monitor>(*scene.monitor);
  const std::int32_t x_low = -3000, y_low = 600, x_high = 899, y_high = 1500;
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
      const std::int32_t x = -15600 + 300 * ix, y = -15600 + 300 * iy;
      const bool touches = std::max(x, x_low) <= std::min(x + 300, x_high) && std::max(y, y_low) <= std::min(y + 300, y_high);
      if (!touches || expected->accumulated_flag[iy][ix] != SK_FLAG_CHANGED) continue;
      expected->accumulated_flag[iy][ix] = SK_FLAG_SET;
      if (!GetParam()) expected->height_mm[iy][ix] = expected->obstacle_height_mm[iy][ix];
    }
  sk_settle_rectangle(scene.monitor.get(), GetParam(), x_low, y_low, x_high, y_high);
  EXPECT_EQ(std::memcmp(scene.monitor.get(), expected.get(), sizeof *expected), 0);
}

// A truck's end whose cells were first seen low, from the side: until they settle they explain nothing.
// verifies: SK-WM-9, SK-WM-12
TEST_P(MonitorSettle, TheRimOfWhatWasLearnedIsNoObstacleAfterwards) {
  for (const bool settles : {false, true}) {
    scene = MonitorScene(GetParam());
    scene.ground(0);
    for (int ix = 40; ix < 45; ++ix) scene.accumulated(50, ix, {SK_FLAG_CHANGED, GetParam() ? 2900 : 0, 2900});
    if (settles) sk_settle_rectangle(scene.monitor.get(), GetParam(), -15600, -15600, 15600, 15600);
    scene.see(51, 42, 2800);
    EXPECT_EQ(scene.settle(), !settles);
    EXPECT_EQ(scene.accumulated(51, 42).flag, settles ? SK_FLAG_CHANGED : SK_FLAG_OBSTACLE);
  }
}

INSTANTIATE_TEST_SUITE_P(Versions, MonitorSettle, testing::Bool(), [](const auto& version) { return version.param ? "Figure7" : "Figure8"; });

}  // namespace
}  // namespace berm::core_test
