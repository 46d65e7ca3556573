#include <gtest/gtest.h>

#include <cmath>

#include "plant/world/height_grid.hpp"
#include "plant/world/random.hpp"

namespace berm::plant {
namespace {

Vec3 unit(double x, double y, double z) { return (1 / std::sqrt(x * x + y * y + z * z)) * Vec3{x, y, z}; }

TEST(HeightGrid, FlatSurfaceIsMetWhereThePlaneIs) {
  const HeightGrid g(-10, -10, 0.1, 0.1, 200, 200, 0.5);
  for (double e = 0.05; e < 1.5; e += 0.05) {
    const Ray r{{0, 0, 3}, unit(std::cos(e), 0.3 * std::cos(e), -std::sin(e))};
    const double expected = -2.5 / r.direction.z;
    const Vec3 p = r.at(expected);
    const auto hit = g.cast(r, 100);
    if (!g.contains(p.x, p.y)) {
      EXPECT_FALSE(hit) << e;
      continue;
    }
    ASSERT_TRUE(hit) << e;
    EXPECT_NEAR(*hit, expected, 1e-9);
  }
}

TEST(HeightGrid, StraightDownAndAlongTheAxes) {
  const HeightGrid g(0, 0, 0.1, 0.1, 50, 50, 1.0);
  const auto down = g.cast({{2.53, 2.57, 4}, {0, 0, -1}}, 100);
  ASSERT_TRUE(down);
  EXPECT_NEAR(*down, 3, 1e-12);
  const auto along = g.cast({{-1, 2.5, 2}, unit(2, 0, -1)}, 100);
  ASSERT_TRUE(along);
  EXPECT_NEAR(*along, std::sqrt(5.0), 1e-9);
  EXPECT_FALSE(g.cast({{2.5, 2.5, 4}, {0, 0, 1}}, 100));
  EXPECT_FALSE(g.cast({{2.5, 2.5, 4}, {0, 0, -1}}, 2.9)) << "beyond the longest range";
}

// Fine steps along the ray find the same place on a rough surface.
TEST(HeightGrid, RoughSurfaceAgainstSmallSteps) {
  HeightGrid g(-5, -4, 0.1, 0.12, 100, 70, 0);
  Random random(3);
  for (int iy = 0; iy < g.count_y(); ++iy) {
    for (int ix = 0; ix < g.count_x(); ++ix) g.set(ix, iy, random.uniform(0, 0.4) + (ix > 60 && iy > 20 ? 1.0 : 0.0));
  }
  g.refresh();
  int hits = 0;
  for (int i = 0; i < 400; ++i) {
    const double a = random.uniform(0, 6.3), e = random.uniform(0.02, 1.5);
    const Ray r{{random.uniform(-4, 4), random.uniform(-3, 3), random.uniform(2, 4)}, {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), -std::sin(e)}};
    double expected = -1;
    for (double t = 0; t < 60 && expected < 0; t += 0.0005) {
      const Vec3 p = r.at(t);
      if (!g.contains(p.x, p.y)) {
        if (p.z < 0) break;
        continue;
      }
      if (p.z <= g.surface(p.x, p.y)) expected = t;
    }
    const auto hit = g.cast(r, 60);
    ASSERT_EQ(static_cast<bool>(hit), expected >= 0) << i;
    if (!hit) continue;
    ++hits;
    EXPECT_NEAR(*hit, expected, 0.001) << i;
  }
  EXPECT_GT(hits, 200);
}

TEST(HeightGrid, LoweredCellsAreNotMetAnyMore) {
  HeightGrid g(0, 0, 0.1, 0.1, 40, 40, 0);
  g.set(20, 20, 2);
  g.refresh();
  const Ray r{{0, 2.05, 1}, {1, 0, 0}};
  ASSERT_TRUE(g.cast(r, 100));
  EXPECT_EQ(g.highest(), 2);
  g.set(20, 20, 0);
  g.refresh();
  EXPECT_FALSE(g.cast(r, 100));
  EXPECT_EQ(g.highest(), 0);
}

}  // namespace
}  // namespace berm::plant
