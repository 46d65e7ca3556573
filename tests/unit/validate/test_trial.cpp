// What the validation sweep draws: the same again for the same seed, and no obstacle where the ground must be fenced.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plant/machine/plant_profile.hpp"
#include "validate/trial.hpp"

namespace {

using berm::validate::draw_trial;
using berm::validate::SwingLimits;
using berm::validate::Trial;

constexpr std::uint64_t seed = 5;
constexpr int runs = 1500;
constexpr double own_body = 3.0, fence = 3.6;

// Nearest of many points of the box's outline; no box is so large, and so near, that it holds the swing axis.
double nearest(const berm::plant::BoxConfig& box) {
  double found = 1e9;
  const double c = std::cos(box.yaw), s = std::sin(box.yaw);
  for (int i = 0; i <= 400; ++i) {
    const double u = i / 400.0 - 0.5;
    for (const double side : {-0.5, 0.5})
      for (const auto& [a, b] : {std::pair{u, side}, {side, u}}) {
        const double along = a * box.length, across = b * box.width;
        const double x = box.x + c * along - s * across, y = box.y + s * along + c * across;
        found = std::min(found, std::hypot(x, y));
      }
  }
  return found;
}

class Trials : public testing::Test {
 protected:
  berm::plant::PlantProfile profile = berm::plant::load_plant_profile(BERM_PLANT_PROFILE);
  Trial drawn(int run, double fence_m) const { return draw_trial(seed, run, profile.shape, SwingLimits{0.87, 1800.0, own_body, fence_m}); }
};

TEST_F(Trials, NoObstacleStandsWithinTheFence) {
  int within = 0;
  for (int run = 0; run < runs; ++run) {
    EXPECT_GE(nearest(drawn(run, fence).obstacle), fence) << "run " << run;
    within += nearest(drawn(run, 0.0).obstacle) < fence;
  }
  EXPECT_GT(within, runs / 50) << "without a fence some stand there";
}

TEST_F(Trials, TheFenceChangesNothingElse) {
  for (int run = 0; run < runs; ++run) {
    const Trial with = drawn(run, fence), without = drawn(run, 0.0);
    EXPECT_EQ(with.from, without.from);
    EXPECT_EQ(with.to, without.to);
    EXPECT_EQ(with.swing_speed, without.swing_speed);
    EXPECT_EQ(with.payload_kg, without.payload_kg);
    EXPECT_EQ(with.place, without.place);
    if (nearest(without.obstacle) >= fence) { EXPECT_EQ(berm::validate::describe(with), berm::validate::describe(without)); }
  }
}

}  // namespace
