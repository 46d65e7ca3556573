#include <gtest/gtest.h>

#include <cmath>

#include "plant/world/solids.hpp"

namespace berm::plant {
namespace {

TEST(Solids, Box) {
  const Vec3 low{1, -1, 0}, high{2, 1, 3};
  EXPECT_NEAR(*cast_box({{0, 0, 1}, {1, 0, 0}}, low, high, 10), 1, 1e-12);
  EXPECT_NEAR(*cast_box({{1.5, 0, 5}, {0, 0, -1}}, low, high, 10), 2, 1e-12);
  EXPECT_EQ(*cast_box({{1.5, 0, 1}, {0, 0, -1}}, low, high, 10), 0) << "from within";
  EXPECT_FALSE(cast_box({{0, 2, 1}, {1, 0, 0}}, low, high, 10));
  EXPECT_FALSE(cast_box({{0, 0, 1}, {-1, 0, 0}}, low, high, 10)) << "behind";
  EXPECT_FALSE(cast_box({{0, 0, 1}, {1, 0, 0}}, low, high, 0.9)) << "too far";
}

TEST(Solids, TurnedBox) {
  const BoxSolid b{PlanarFrame(5, 0, 0, 3.14159265358979 / 4), {-1, -1, 0}, {1, 1, 2}};
  EXPECT_NEAR(*b.cast({{0, 0, 1}, {1, 0, 0}}, 10), 5 - std::sqrt(2.0), 1e-9);
}

TEST(Solids, Cylinder) {
  const CylinderSolid c{5, 0, 0, 1.8, 0.25};
  EXPECT_NEAR(*c.cast({{0, 0, 1}, {1, 0, 0}}, 10), 4.75, 1e-12);
  EXPECT_NEAR(*c.cast({{5.1, 0.1, 4}, {0, 0, -1}}, 10), 2.2, 1e-12) << "on its top";
  EXPECT_FALSE(c.cast({{0, 0.26, 1}, {1, 0, 0}}, 10));
  EXPECT_FALSE(c.cast({{0, 0, 1.9}, {1, 0, 0}}, 10));
  EXPECT_FALSE(c.cast({{5.3, 0, 4}, {0, 0, -1}}, 10));
}

TEST(Solids, Prism) {
  const PrismSolid p({{1, 0}, {3, 0}, {2, 2}}, 0.5);
  EXPECT_NEAR(*p.cast({{0, 0, 1}, {1, 0, 0}}, 10), 1.5, 1e-12);
  EXPECT_NEAR(*p.cast({{2, -3, 1}, {0, 1, 0}}, 10), 2.5, 1e-12);
  EXPECT_NEAR(*p.cast({{2, 0, 5}, {0, 0, -1}}, 10), 3, 1e-12);
  EXPECT_FALSE(p.cast({{0, 0.6, 1}, {1, 0, 0}}, 10));
  EXPECT_FALSE(p.cast({{2.9, -3, 1}, {0, 1, 0}}, 10));
}

}  // namespace
}  // namespace berm::plant
