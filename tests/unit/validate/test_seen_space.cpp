// What the validation sweep's judge takes for hidden: beams placed by hand, a wall between them and the ground.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "validate/seen_space.hpp"

namespace {

using berm::validate::SeenSpace;

constexpr double head_z = 3.0, wall_x = 5.0, wall_top = 2.0;

berm::plant::ImplementShape shape() {
  berm::plant::ImplementShape s;
  s.scanner[0].position = s.scanner[1].position = {0.0, 0.0, head_z};
  return s;
}

// One turn of the mirror's lower quarter at this pan, over level ground, with or without the wall from y = -1 to 1.
berm_scan_packet scanline(double pan, bool wall) {
  berm_scan_packet p{};
  p.samples_per_revolution = 400;
  p.sample_period_ns = 83333;
  p.first_index = 300;
  p.count = 99;
  p.echoes_per_sample = 1;
  p.pan_start_urad = p.pan_end_urad = static_cast<std::int32_t>(std::lround(pan * 1e6));
  for (int i = 0; i < p.count; ++i) {
    const double down = 0.5 * std::numbers::pi - 2.0 * std::numbers::pi * i / 400.0;
    double range = head_z / std::sin(down);
    const double to_wall = wall_x / (std::cos(down) * std::cos(pan));
    const bool meets = wall && to_wall < range && head_z - to_wall * std::sin(down) < wall_top && std::fabs(wall_x * std::tan(pan)) < 1.0;
    if (meets) range = to_wall;
    if (range < 100.0) p.range[i][0] = static_cast<std::uint16_t>(std::lround(range * 1e3 / BERM_SCAN_RANGE_LSB_MM));
  }
  return p;
}

SeenSpace looked(bool wall, double t) {
  SeenSpace seen(shape());
  for (double pan = -0.6; pan <= 0.6; pan += 0.01) seen.take(scanline(pan, wall), t, {});
  return seen;
}

TEST(SeenSpace, BehindAWallSpaceIsHiddenUpToTheLineOfSight) {
  const auto hidden = looked(true, 1.0).hidden_against(looked(false, 1.0), 2.0);
  ASSERT_GT(hidden.size(), 50U);
  for (const auto& h : hidden) {
    EXPECT_GT(h.x, wall_x - SeenSpace::side);
    EXPECT_LT(std::fabs(h.y), h.x / wall_x + SeenSpace::side) << "beside the wall";
    const double line = head_z - (head_z - wall_top) * (h.x - 0.5 * SeenSpace::side) / wall_x;
    EXPECT_LE(h.top, line + 2.0 * SeenSpace::side) << "over the line of sight at " << h.x;
  }
  const bool deep = std::any_of(hidden.begin(), hidden.end(), [](const auto& h) { return std::fabs(h.x - 6.1) < 0.2 && std::fabs(h.y) < 0.2 && h.top > 1.2; });
  EXPECT_TRUE(deep) << "just behind the wall";
}

TEST(SeenSpace, NothingIsHiddenWithoutAWallNorAskedBeforeItIsLookedFor) {
  EXPECT_TRUE(looked(false, 1.0).hidden_against(looked(false, 1.0), 2.0).empty());
  EXPECT_TRUE(looked(true, 1.0).hidden_against(looked(false, 1.0), 0.5).empty()) << "nobody had looked yet";
}

TEST(SeenSpace, ALaterLookFromElsewhereEndsIt) {
  SeenSpace seen = looked(true, 1.0);
  for (double pan = -0.6; pan <= 0.6; pan += 0.01) seen.take(scanline(pan, false), 3.0, {});  // as if from where the wall does not hide
  const SeenSpace without = looked(false, 1.0);
  EXPECT_FALSE(seen.hidden_against(without, 2.9).empty());
  EXPECT_TRUE(seen.hidden_against(without, 3.1).empty());
}

}  // namespace
