// How fast may be asked for while less is known than usual, and what is near a lane.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "core/speed_share.h"

namespace berm::core_test {
namespace {

berm_parameters shares(std::int32_t dust, std::int32_t learn) {
  berm_parameters p{};
  p.dust_speed_permille = dust;
  p.workspace_learn_speed_permille = learn;
  return p;
}

sk_slice slice_of(std::initializer_list<std::array<std::int32_t, 2>> vertices) {
  sk_slice s{};
  for (const auto& [x, y] : vertices) {
    s.xyz_mm[0][s.vertices] = x;
    s.xyz_mm[1][s.vertices++] = y;
  }
  return s;
}

berm_parameters lanes(std::initializer_list<berm_lane> all) {
  berm_parameters p{};
  for (const berm_lane& z : all) p.lane[p.lanes++] = z;
  return p;
}

// verifies: SK-SI-12, SK-WM-74
TEST(SpeedShare, TheLeastOfThoseThatApply) {
  for (const auto& [dust, learn] : {std::array{400, 100}, std::array{100, 400}}) {
    const berm_parameters p = shares(dust, learn);
    EXPECT_EQ(sk_speed_share(&p, false, false), SK_WHOLE_PERMILLE);
    EXPECT_EQ(sk_speed_share(&p, true, false), dust);
    EXPECT_EQ(sk_speed_share(&p, false, true), learn);
    EXPECT_EQ(sk_speed_share(&p, true, true), 100);
  }
  const berm_parameters whole = shares(2000, 2000);
  EXPECT_EQ(sk_speed_share(&whole, true, true), SK_WHOLE_PERMILLE) << "never more than the whole";
}

// verifies: SK-WM-75
TEST(LaneNear, ToTheMillimetreOnEachSide) {
  const berm_parameters p = lanes({{4000, 2000, 9000, 6000}});
  const auto away = [&](std::int32_t x, std::int32_t y) {
    const sk_slice s = slice_of({{x, y}, {x, y}});
    return sk_away_from_lanes(&p, &s);
  };
  const std::int32_t beside = SK_LANE_BESIDE_MM;
  EXPECT_TRUE(away(4000 - beside - 1, 4000));
  EXPECT_FALSE(away(4000 - beside, 4000));
  EXPECT_FALSE(away(9000 + beside, 4000));
  EXPECT_TRUE(away(9000 + beside + 1, 4000));
  EXPECT_TRUE(away(6000, 2000 - beside - 1));
  EXPECT_FALSE(away(6000, 2000 - beside));
  EXPECT_FALSE(away(6000, 6000 + beside));
  EXPECT_TRUE(away(6000, 6000 + beside + 1));
  const sk_slice across = slice_of({{0, 4000}, {20000, 4000}}), tip = slice_of({{0, 0}, {0, 100}, {4500, 3000}});
  EXPECT_FALSE(sk_away_from_lanes(&p, &across)) << "no vertex lies in it";
  EXPECT_FALSE(sk_away_from_lanes(&p, &tip)) << "the last of the vertices alone";
}

// verifies: SK-WM-75
TEST(LaneNear, EveryLaneCounts) {
  const sk_slice s = slice_of({{0, 0}, {1000, 0}, {1000, 1000}});
  const berm_lane far{10000, 10000, 12000, 12000}, near{500, 500, 3000, 3000};
  const berm_parameters none = lanes({}), one = lanes({far}), last = lanes({far, far, far, near}), first = lanes({near, far});
  EXPECT_TRUE(sk_away_from_lanes(&none, &s));
  EXPECT_TRUE(sk_away_from_lanes(&one, &s));
  EXPECT_FALSE(sk_away_from_lanes(&last, &s));
  EXPECT_FALSE(sk_away_from_lanes(&first, &s));
}

// verifies: SK-WM-75
TEST(LaneNear, WhatIsOutOfRangeIsNear) {
  sk_slice s = slice_of({{0, 0}});
  berm_parameters p = lanes({{10000, 10000, 12000, 12000}});
  ASSERT_TRUE(sk_away_from_lanes(&p, &s));
  for (const std::int32_t count : {-1, BERM_LANES + 1, INT32_MAX, INT32_MIN}) {
    p.lanes = count;
    EXPECT_FALSE(sk_away_from_lanes(&p, &s)) << count;
  }
  p.lanes = 1;
  for (const std::int32_t count : {-1, 0, SK_SLICE_VERTICES + 1, INT32_MAX, INT32_MIN}) {
    s.vertices = count;
    EXPECT_FALSE(sk_away_from_lanes(&p, &s)) << count;
  }
  s.vertices = 1;
  p.lane[0] = {INT32_MIN, INT32_MIN, INT32_MAX, INT32_MAX};
  EXPECT_FALSE(sk_away_from_lanes(&p, &s)) << "and no sum runs over";
  p.lane[0] = {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN};
  EXPECT_TRUE(sk_away_from_lanes(&p, &s));
}

// Points of the hull, drawn, are never near when the slice is said to be away.
// verifies: SK-WM-75
TEST(LaneNear, NoPointOfTheHullIsNearWhenItIsAway) {
  constexpr unsigned kSeed = 20261;
  std::mt19937 draw(kSeed);
  const auto within = [&](std::int32_t low, std::int32_t high) { return std::uniform_int_distribution<std::int32_t>(low, high)(draw); };
  int away = 0, near = 0;
  for (int n = 0; n < 4000; ++n) {
    berm_parameters p{};
    p.lanes = within(0, BERM_LANES);
    for (int k = 0; k < p.lanes; ++k) {
      const std::int32_t x = within(-12000, 12000), y = within(-12000, 12000);
      p.lane[k] = {x, y, x + within(1, 3000), y + within(1, 3000)};
    }
    sk_slice s{};
    s.vertices = within(1, SK_SLICE_VERTICES);
    const std::int32_t x = within(-10000, 10000), y = within(-10000, 10000), size = within(1, 4000);
    for (int i = 0; i < s.vertices; ++i) s.xyz_mm[0][i] = x + within(0, size), s.xyz_mm[1][i] = y + within(0, size);
    if (!sk_away_from_lanes(&p, &s)) {
      ++near;
      continue;
    }
    ++away;
    for (int m = 0; m < 40; ++m) {
      const int i = within(0, s.vertices - 1), j = within(0, s.vertices - 1);
      const double share = within(0, 1000) * 1e-3;
      const double at[2] = {s.xyz_mm[0][i] + share * (s.xyz_mm[0][j] - s.xyz_mm[0][i]), s.xyz_mm[1][i] + share * (s.xyz_mm[1][j] - s.xyz_mm[1][i])};
      for (int k = 0; k < p.lanes; ++k) {
        const double dx = std::max({p.lane[k].x_low_mm - at[0], 0.0, at[0] - p.lane[k].x_high_mm});
        const double dy = std::max({p.lane[k].y_low_mm - at[1], 0.0, at[1] - p.lane[k].y_high_mm});
        ASSERT_GT(std::max(dx, dy), SK_LANE_BESIDE_MM) << "seed " << kSeed << " scene " << n;
      }
    }
  }
  EXPECT_GT(away, 500);
  EXPECT_GT(near, 200);
}

}  // namespace
}  // namespace berm::core_test
