// Points into the temporary map.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <iostream>
#include <limits>
#include <random>
#include <vector>

#include "monitor_scene.hpp"

namespace berm::core_test {
namespace {

constexpr std::int32_t kMin32 = std::numeric_limits<std::int32_t>::min(), kMax32 = std::numeric_limits<std::int32_t>::max();

class MonitorPoints : public testing::Test {
 protected:
  bool insert(std::int32_t z_mm, bool interpolated = false, std::int64_t now_us = 7) {
    return sk_monitor_insert(m, 40, 60, z_mm, interpolated, now_us);
  }
  void flag(int value) { m->temporary_flag[40][60] = static_cast<std::uint8_t>(value); }
  std::int32_t height() const { return sk_new_height_mm(m, 40, 60); }

  MonitorScene scene{true};
  sk_monitor* m = scene.monitor.get();
};

// verifies: SK-WM-2
TEST_F(MonitorPoints, BeginForgetsEverything) {
  scene.ground(300);
  scene.accumulated(3, 4, {SK_FLAG_OBSTACLE, 0, 1700});
  for (int i = 0; i < 104; ++i) scene.see(i, i, 1700);
  scene.settle();
  scene.see(5, 6, 100);
  sk_monitor_begin(m);
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
      ASSERT_EQ(m->temporary_flag[iy][ix], SK_FLAG_EMPTY);
      ASSERT_EQ(m->accumulated_flag[iy][ix], SK_FLAG_EMPTY);
    }
  EXPECT_EQ(m->modified, 0);
  EXPECT_FALSE(m->overflowed);
  EXPECT_EQ(m->updated_us, -1);
  EXPECT_EQ(m->obstacle_us, -1);
  EXPECT_FALSE(scene.step());
}

// verifies: SK-WM-3
TEST_F(MonitorPoints, RefusalsChangeNothing) {
  const auto before = std::make_unique<sk_monitor>(*m);
  for (const std::int32_t outside : {kMin32, -1, SK_MAP_CELLS, kMax32}) {
    EXPECT_FALSE(sk_monitor_insert(m, outside, 60, 100, false, 7));
    EXPECT_FALSE(sk_monitor_insert(m, 40, outside, 100, true, 7));
  }
  EXPECT_EQ(std::memcmp(m, before.get(), sizeof *m), 0);
}

// verifies: SK-WM-3
TEST_F(MonitorPoints, HeightsAreClamped) {
  insert(kMax32);
  EXPECT_EQ(height(), 20000);
  insert(kMin32);
  EXPECT_EQ(height(), -20000);
}

// verifies: SK-WM-4, SK-WM-5
TEST_F(MonitorPoints, EveryFlagMeetsBothKindsOfPoint) {
  for (const int before : {SK_FLAG_EMPTY, SK_FLAG_SET, SK_FLAG_INTERPOLATED, SK_FLAG_NOT_VISITED, SK_FLAG_INTERPOLATED_NOT_VISITED, SK_FLAG_CHANGED, SK_FLAG_OBSTACLE}) {
    const bool measured_before = before != SK_FLAG_EMPTY && before != SK_FLAG_INTERPOLATED && before != SK_FLAG_INTERPOLATED_NOT_VISITED;
    scene.temporary(40, 60, before, 900);
    EXPECT_EQ(insert(2000, true), before == SK_FLAG_EMPTY) << flag_name(before);
    EXPECT_EQ(m->temporary_flag[40][60], before == SK_FLAG_EMPTY ? SK_FLAG_INTERPOLATED : before);
    EXPECT_EQ(height(), before == SK_FLAG_EMPTY ? 2000 : 900);
    scene.temporary(40, 60, before, 900);
    EXPECT_TRUE(insert(300));
    EXPECT_EQ(m->temporary_flag[40][60], SK_FLAG_SET) << flag_name(before);
    EXPECT_EQ(height(), measured_before ? 900 : 300) << flag_name(before) << ": a measured point overrides interpolated ones";
  }
}

// verifies: SK-WM-6
TEST_F(MonitorPoints, TheHeightIsTheSecondHighestOfAnyPoints) {
  const unsigned seed = std::random_device{}();
  std::cout << "seed " << seed << "\n";
  std::mt19937 random(seed);
  for (int run = 0; run < 2000; ++run) {
    flag(SK_FLAG_EMPTY);
    std::vector<std::int32_t> points;
    const int count = std::uniform_int_distribution<>(1, 6)(random);
    for (int i = 0; i < count; ++i) {
      points.push_back(std::uniform_int_distribution<>(-3, 3)(random));
      ASSERT_TRUE(insert(points.back()));
      std::vector<std::int32_t> sorted = points;
      std::sort(sorted.rbegin(), sorted.rend());
      ASSERT_EQ(height(), sorted[sorted.size() > 1 ? 1 : 0]) << "after " << i + 1 << " points";
    }
  }
}

// verifies: SK-WM-6
TEST_F(MonitorPoints, ACellBeganWithItsFirstPointAfterAMerge) {
  insert(100, true, 5);
  insert(100, false, 9);
  flag(SK_FLAG_NOT_VISITED);
  insert(100, false, 11);
  EXPECT_EQ(m->began_us[40][60], 5);
  flag(SK_FLAG_EMPTY);
  insert(100, false, 20);
  EXPECT_EQ(m->began_us[40][60], 20);
}

}  // namespace
}  // namespace berm::core_test
