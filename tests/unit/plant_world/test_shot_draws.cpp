// A lidar's draws: the stream that Random gives draw for draw, and near noise that never changes what the sensor tells.
#include "plant/world/shot_draws.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "plant/world/random.hpp"

namespace berm::plant {
namespace {

// more: as of a sensor that draws what comes back besides, and from where.
void expect_the_stream(bool more) {
  ShotDraws draws(7, more);
  Random random(7);
  for (std::size_t firing = 0; firing < 2000; ++firing) {
    const ShotDraws::Firing drawn = draws.next();
    for (std::size_t laser = 0; laser < ShotDraws::lasers; ++laser) {
      ASSERT_EQ(drawn.noise(laser), random.normal()) << firing << ", " << laser;
      ASSERT_EQ(drawn.lost(laser), random.uniform()) << firing << ", " << laser;
      ASSERT_EQ(drawn.what(laser), more ? random.uniform() : 0.0) << firing << ", " << laser;
      ASSERT_EQ(drawn.where(laser), more ? random.uniform() : 0.0) << firing << ", " << laser;
    }
  }
}

TEST(ShotDraws, AreTheStreamOfRandomShotForShot) {
  for (const bool more : {false, true}) expect_the_stream(more);
}

TEST(ShotDraws, NearNoiseIsNear) {
  ShotDraws draws(11, true);
  double farthest = 0.0;
  for (int firing = 0; firing < 20000; ++firing) {
    const ShotDraws::Firing drawn = draws.next();
    for (std::size_t laser = 0; laser < ShotDraws::lasers; ++laser)
      farthest = std::max(farthest, std::abs(drawn.near_noise(laser) - drawn.noise(laser)));
  }
  EXPECT_LT(farthest, ShotDraws::near_by / 20);
  EXPECT_GT(farthest, 0.0);
}

// Ranges chosen so that the exact noise brings them just to one side of a border between two steps, where near noise may bring them to the other.
TEST(ShotDraws, ANoisyRangeComesToTheStepOfTheExactOne) {
  constexpr double stddev = 0.03, step = 0.002;
  ShotDraws draws(13, true);
  int otherwise = 0;
  for (int firing = 0; firing < 20000; ++firing) {
    const ShotDraws::Firing drawn = draws.next();
    for (std::size_t laser = 0; laser < ShotDraws::lasers; ++laser) {
      const double border = (1000.5 + firing) * step, range = border - stddev * drawn.noise(laser) + (laser % 2 == 0 ? 1e-14 : -1e-14);
      const long exact = std::lround((range + stddev * drawn.noise(laser)) / step);
      ASSERT_EQ(std::lround(drawn.noisy(range, stddev, step, laser) / step), exact) << firing << ", " << laser;
      otherwise += std::lround((range + stddev * drawn.near_noise(laser)) / step) != exact ? 1 : 0;
    }
  }
  EXPECT_GT(otherwise, 1000) << "near noise alone would have done, so this tests nothing";
}

}  // namespace
}  // namespace berm::plant
