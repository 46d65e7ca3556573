#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <memory>
#include <utility>

#include "in_process/draw.hpp"
#include "watch/footprint.hpp"

namespace berm::watch {
namespace {

constexpr double cell = SK_CELL_MM * 1e-3, origin = SK_MAP_ORIGIN_MM * 1e-3;

Footprint drawn(in_process::Draw& draw, bool vehicle) {
  Footprint f{draw.between(-3, 3), draw.between(-3, 3), draw.between(-3.2, 3.2)};
  if (vehicle) {
    f.length = draw.between(0.4, 4.0);
    f.width = draw.between(0.3, 2.0);
  } else {
    f.radius = draw.between(0.1, 0.6);
  }
  return f;
}

// A square is met exactly when the footprint's distance from some point of it is zero; a fine grid of its points comes within half a step.
TEST(footprint, meets_a_square_as_its_points_say) {
  in_process::Draw draw(7, 0);
  int met = 0, missed = 0;
  for (int i = 0; i < 400; ++i) {
    const Footprint f = drawn(draw, i % 2 == 0);
    const double x = draw.between(-3, 3), y = draw.between(-3, 3), side = 0.3;
    constexpr int n = 60;
    double least = 1e9;
    for (int a = 0; a <= n; ++a)
      for (int b = 0; b <= n; ++b) least = std::min(least, distance(f, x + side * a / n, y + side * b / n));
    const bool meets = meets_square(f, x, y, side);
    if (least <= 0.0) {
      EXPECT_TRUE(meets) << i;
    }
    if (least > side / n) {
      EXPECT_FALSE(meets) << i;
    }
    (meets ? met : missed)++;
  }
  EXPECT_GT(met, 10);
  EXPECT_GT(missed, 100);
}

TEST(footprint, distance_is_from_the_outline_and_zero_within) {
  const Footprint person{1.0, 2.0, 0.0, 0.25};
  EXPECT_DOUBLE_EQ(distance(person, 1.1, 2.0), 0.0);
  EXPECT_NEAR(distance(person, 2.0, 2.0), 0.75, 1e-12);
  const Footprint vehicle{0.0, 0.0, std::acos(0.0), 0.0, 4.0, 2.0};  // along y
  EXPECT_DOUBLE_EQ(distance(vehicle, 0.5, 1.9), 0.0);
  EXPECT_NEAR(distance(vehicle, 1.5, 0.0), 0.5, 1e-12);
  EXPECT_NEAR(distance(vehicle, 0.0, 3.0), 1.0, 1e-12);
}

TEST(footprint, is_in_the_region_with_its_rim_and_has_its_middle_there_later) {
  const auto rules = std::make_unique<sk_monitor_rules>();
  const int ix = 60, iy = 40;
  rules->watched[iy][ix] = 1;
  const Region region{rules.get(), nullptr};
  const double x = origin + cell * ix, y = origin + cell * (iy + 0.5);
  EXPECT_FALSE(meets_region({x - 0.26, y, 0.0, 0.25}, region));
  EXPECT_TRUE(meets_region({x - 0.24, y, 0.0, 0.25}, region));
  EXPECT_FALSE(watched_at(region, x - 0.24, y));
  EXPECT_TRUE(watched_at(region, x + 0.01, y));
  EXPECT_FALSE(watched_at(region, 1000.0, 0.0));
  EXPECT_FALSE(meets_region({1000.0, 0.0, 0.0, 0.25}, region));
}

TEST(footprint, an_obstacle_counts_only_in_a_watched_cell_within_reach) {
  const auto rules = std::make_unique<sk_monitor_rules>();
  const auto monitor = std::make_unique<sk_monitor>();
  for (auto& row : monitor->accumulated_flag)
    for (auto& flag : row) flag = SK_FLAG_SET;
  const int ix = 60, iy = 40;
  monitor->accumulated_flag[iy][ix] = SK_FLAG_OBSTACLE;
  const double x = origin + cell * (ix + 0.5), y = origin + cell * (iy + 0.5);
  EXPECT_FALSE(somebody_near({x, y, 0.0, 0.25}, 1.0, {monitor.get()}, *rules));
  rules->watched[iy][ix] = 1;
  EXPECT_TRUE(somebody_near({x, y, 0.0, 0.25}, 1.0, {monitor.get()}, *rules));
  EXPECT_TRUE(somebody_near({x + 1.24, y, 0.0, 0.25}, 1.0, {monitor.get()}, *rules));
  EXPECT_FALSE(somebody_near({x + 1.26, y, 0.0, 0.25}, 1.0, {monitor.get()}, *rules));
  const auto histograms = std::make_unique<sk_monitor_histogram>();
  for (auto& row : histograms->state)
    for (auto& state : row) state = SK_CELL_CLEAR;
  const Held held{monitor.get(), histograms.get()};
  EXPECT_FALSE(somebody_near({x, y, 0.0, 0.25}, 1.0, held, *rules)) << "heights are not what is compared with";
  for (const auto& [state, is_somebody] : std::initializer_list<std::pair<int, bool>>{{SK_CELL_SOMEBODY, true}, {0x0, true}, {SK_CELL_LEARNING, false}}) {
    histograms->state[iy][ix] = static_cast<std::uint16_t>(state);
    EXPECT_EQ(somebody_near({x, y, 0.0, 0.25}, 1.0, held, *rules), is_somebody) << state;
  }
  monitor->accumulated_flag[iy][ix] = SK_FLAG_CHANGED;
  EXPECT_FALSE(somebody_near({x, y, 0.0, 0.25}, 1.0, {monitor.get()}, *rules));
}

}  // namespace
}  // namespace berm::watch
