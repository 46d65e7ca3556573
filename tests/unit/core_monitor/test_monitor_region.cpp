// The safety region: its circle, what is left out of it, and that an obstacle in any of its cells is found.
#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <random>
#include <vector>

#include "monitor_scene.hpp"

namespace berm::core_test {
namespace {

berm_parameters parameters(std::int32_t radius_mm, std::int32_t own_mm) {
  berm_parameters p{};
  p.workspace_radius_mm = radius_mm;
  p.own_body_radius_mm = own_mm;
  return p;
}

bool within(std::int64_t low_x, std::int64_t low_y, std::int64_t radius) {
  const std::int64_t x = std::clamp<std::int64_t>(0, low_x, low_x + 300), y = std::clamp<std::int64_t>(0, low_y, low_y + 300);
  return x * x + y * y <= radius * radius;
}

// verifies: SK-WM-40
TEST(MonitorRegion, TheCircleIsOfEveryCellThatHasAPointInItButTheOwnBodys) {
  const auto rules = monitor_rules(true);
  for (const std::int32_t radius : {1, 299, 300, 301, 12'000, 14'999, 15'000})
    for (const std::int32_t own : {1, 300, 3'000}) {
      const berm_parameters p = parameters(radius, own);
      sk_watch_region(rules.get(), &p, true);
      for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
        for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
          const std::int64_t x = -15600 + 300 * ix, y = -15600 + 300 * iy;
          ASSERT_EQ(rules->watched[iy][ix] != 0, within(x, y, radius) && !within(x, y, own)) << radius << " " << own << " " << iy << " " << ix;
        }
    }
}

struct Rectangle {
  std::int64_t x_low, y_low, x_high, y_high;
};

// Not an edge of theirs is beyond an edge of the other's.
bool touches(const Rectangle& a, const Rectangle& b) {
  return std::max(a.x_low, b.x_low) <= std::min(a.x_high, b.x_high) && std::max(a.y_low, b.y_low) <= std::min(a.y_high, b.y_high);
}

// verifies: SK-WM-40, SK-WM-46
TEST(MonitorRegion, WhatTheMachineChangesIsLeftOutAndLanesWhileTheyAreOpen) {
  constexpr unsigned kSeed = 17;
  std::mt19937 random(kSeed);
  // Corners on cell borders too, where touching is decided.
  const auto coordinate = [&random] { return static_cast<std::int32_t>(random() % 2 != 0 ? 300 * (random() % 101) - 15000 : random() % 30001 - 15000); };
  const auto rectangle = [&] {
    std::int32_t x = coordinate(), y = coordinate(), u = coordinate(), v = coordinate();
    return berm_lane{std::min(x, u), std::min(y, v), std::max(x, u) + 1, std::max(y, v) + 1};
  };
  const auto rules = monitor_rules(true);
  int left_out = 0;
  for (int round = 0; round < 60; ++round) {
    berm_parameters p = parameters(15'000, 2'000);
    std::vector<Rectangle> fixed, lanes;
    const auto noted = [](const berm_lane& r, std::vector<Rectangle>& list) { return list.push_back({r.x_low_mm, r.y_low_mm, r.x_high_mm, r.y_high_mm}), r; };
    p.dig_zones = round % (BERM_DIG_ZONES + 1);
    p.truck_zones = round % (BERM_TRUCK_ZONES + 1);
    p.lanes = round % (BERM_LANES + 1);
    for (int i = 0; i < p.dig_zones; ++i) {
      const berm_lane r = noted(rectangle(), fixed);
      p.dig_zone[i] = {r.x_low_mm, r.y_low_mm, r.x_high_mm, r.y_high_mm, 0, 0};
    }
    for (int i = 0; i < p.truck_zones; ++i) {
      const berm_lane r = noted(rectangle(), fixed);
      p.truck_zone[i] = {r.x_low_mm, r.y_low_mm, r.x_high_mm, r.y_high_mm, 0};
    }
    for (int i = 0; i < p.lanes; ++i) p.lane[i] = noted(rectangle(), lanes);
    p.lane[BERM_LANES - 1].x_low_mm = p.lanes < BERM_LANES ? -15000 : p.lane[BERM_LANES - 1].x_low_mm;  // one that is not counted
    for (const bool open : {false, true}) {
      sk_watch_region(rules.get(), &p, open);
      for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
        for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
          const std::int64_t x = -15600 + 300 * ix, y = -15600 + 300 * iy;
          const Rectangle cell{x, y, x + 300, y + 300};
          const auto in = [&cell](const Rectangle& r) { return touches(cell, r); };
          const bool out = std::any_of(fixed.begin(), fixed.end(), in) || (open && std::any_of(lanes.begin(), lanes.end(), in));
          left_out += out;
          ASSERT_EQ(rules->watched[iy][ix] != 0, within(x, y, 15'000) && !within(x, y, 2'000) && !out) << "seed " << kSeed << " round " << round << " " << iy << " " << ix;
        }
    }
  }
  EXPECT_GT(left_out, 100000);
}

// verifies: SK-WM-41
TEST(MonitorRegion, AnObstacleStopsInEveryWatchedCellAndInNoOther) {
  MonitorScene scene(true);
  scene.ground(0);
  const berm_parameters p = parameters(12'000, 2'000);
  sk_watch_region(scene.rules.get(), &p, true);
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

}  // namespace
}  // namespace berm::core_test
