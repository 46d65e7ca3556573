#include <gtest/gtest.h>

#include <cmath>

#include "plant/world/terrain.hpp"

namespace berm::plant {
namespace {

void settle_all(Terrain& t) {
  for (int i = 0; i < 5000 && !t.at_rest(); ++i) t.settle(2000);
  ASSERT_TRUE(t.at_rest());
}

TEST(Terrain, BenchHasItsLevelsAndSlopes) {
  const Terrain t({}, {}, 1);
  EXPECT_EQ(t.as_built(0, 0), 0);
  EXPECT_EQ(t.as_built(10, 0), -2.2);
  EXPECT_EQ(t.as_built(0, 6), -2.2);
  EXPECT_EQ(t.as_built(10, 10), -2.2);
  EXPECT_NEAR(t.as_built(6.75, 0), -1.1, 1e-12);
  EXPECT_NEAR(t.as_built(0, 4.2), -1.1, 1e-12);
  EXPECT_NEAR(t.grid().surface(6.75, 0), -1.1, 0.02);
}

TEST(Terrain, MoundStandsOnTheGround) {
  TerrainConfig c;
  c.mounds = {{{-5, -5}, {-5, 5}, 1.5, 1.0}};
  const Terrain t(c, {}, 1);
  EXPECT_NEAR(t.as_built(-5, 0), 1.5, 1e-12);
  EXPECT_NEAR(t.as_built(-4, 0), 0.5, 1e-12);
  EXPECT_EQ(t.as_built(-3, 0), 0);
}

TEST(Terrain, RoughnessIsSeededAndOfTheSizeAskedFor) {
  TerrainConfig c;
  c.roughness = 0.03;
  const Terrain a(c, {}, 5), b(c, {}, 5), other(c, {}, 6);
  double sum2 = 0;
  int n = 0, same = 0;
  for (int iy = 0; iy < 100; ++iy) {
    for (int ix = 0; ix < 100; ++ix) {
      ASSERT_EQ(a.height(ix, iy), b.height(ix, iy));
      same += a.height(ix, iy) == other.height(ix, iy);
      sum2 += a.height(ix, iy) * a.height(ix, iy);
      ++n;
    }
  }
  EXPECT_EQ(same, 0);
  EXPECT_NEAR(std::sqrt(sum2 / n), 0.03, 0.012);
}

TEST(Terrain, UndisturbedFaceStands) {
  TerrainConfig c;
  c.roughness = 0.02;
  Terrain t(c, {}, 2);
  const double before = t.grid().surface(6.75, 0);
  for (int i = 0; i < 20; ++i) t.settle(5000);
  EXPECT_EQ(t.grid().surface(6.75, 0), before);
}

TEST(Terrain, CutSwellsAndLooseGoesFirst) {
  Terrain t({}, {}, 1);
  EXPECT_NEAR(t.cut(160, 160, -0.5), 0.5 * 1.1 * 0.01, 1e-12);
  EXPECT_EQ(t.cut(160, 160, -0.4), 0) << "nothing is higher";
  t.deposit(160, 160, 0.002);
  EXPECT_NEAR(t.height(160, 160), -0.3, 1e-12);
  EXPECT_NEAR(t.cut(160, 160, -0.5), 0.002, 1e-12) << "loose soil does not swell again";
}

TEST(Terrain, HeapRestsAtItsAngleAndNothingIsLost) {
  Terrain t({}, {}, 1);
  const double before = t.loose_volume();
  const int cx = t.grid().index_x(-5.0), cy = t.grid().index_y(-5.0);
  t.deposit(cx, cy, 2.0);
  settle_all(t);
  EXPECT_NEAR((t.loose_volume() - before) / 2.0, 1, 1e-6);
  double steepest = 0, top = 0;
  for (int iy = cy - 30; iy <= cy + 30; ++iy) {
    for (int ix = cx - 30; ix <= cx + 30; ++ix) {
      top = std::max(top, t.height(ix, iy));
      for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{0, 1}, std::pair{1, 1}, std::pair{1, -1}}) {
        steepest = std::max(steepest, std::abs(t.height(ix, iy) - t.height(ix + dx, iy + dy)) / t.distance(dx, dy));
      }
    }
  }
  // A cone of 2 m3 at slope 0.63 is 0.91 m high.
  EXPECT_LE(steepest, 0.63 + 0.021);
  EXPECT_NEAR(top, std::cbrt(3 * 2.0 * 0.63 * 0.63 / 3.14159), 0.12);
}

TEST(Terrain, UndercutFaceComesDownAndConservesSoil) {
  Terrain t({}, {}, 1);
  const double before = t.loose_volume();
  double taken = 0;
  for (int iy = t.grid().index_y(-0.5); iy <= t.grid().index_y(0.5); ++iy) {
    for (int ix = t.grid().index_x(6.5); ix <= t.grid().index_x(7.4); ++ix) taken += t.cut(ix, iy, -2.2);
  }
  ASSERT_GT(taken, 0.5);
  const double crest_before = t.grid().surface(6.45, 0);
  settle_all(t);
  EXPECT_LT(t.grid().surface(6.45, 0), crest_before - 0.3) << "a wall of 1.4 m does not stand";
  EXPECT_NEAR((before - t.loose_volume()) / taken, 1, 1e-6);
  for (int iy = t.grid().index_y(-1.5); iy <= t.grid().index_y(1.5); ++iy) {
    for (int ix = t.grid().index_x(5.0); ix <= t.grid().index_x(8.0); ++ix) {
      EXPECT_LE(std::abs(t.height(ix, iy) - t.height(ix + 1, iy)), 0.1 * Terrain::undisturbed_slope + 0.003);
    }
  }
}

TEST(Terrain, SettlingIsBoundedInTime) {
  Terrain t({}, {}, 1);
  t.deposit(160, 160, 5.0);
  t.settle(10);
  EXPECT_FALSE(t.at_rest());
  EXPECT_GT(t.height(160, 160), 100);
}

}  // namespace
}  // namespace berm::plant
