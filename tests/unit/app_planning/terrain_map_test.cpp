#include <gtest/gtest.h>

#include "planning/terrain_map.hpp"

namespace {

using berm::app::TerrainMap;

TEST(TerrainMap, NewestHeightStands) {
  TerrainMap map;
  EXPECT_FALSE(map.height(5.0, 1.0));
  map.insert(5.0, 1.0, 0.4, 1.0);
  map.insert(5.0, 1.0, -0.3, 9.0);
  EXPECT_EQ(map.height(5.0, 1.0), -0.3);
  EXPECT_EQ(map.observed_at(5.0, 1.0), 9.0);
  EXPECT_FALSE(map.height(5.3, 1.0));
}

TEST(TerrainMap, HighestOfOnePassageStands) {
  TerrainMap map;
  map.insert(5.0, 1.0, 0.3, 1.00);
  map.insert(5.0, 1.0, -0.9, 1.01);  // beside a wall's top the scanline also meets the ground below
  EXPECT_EQ(map.height(5.0, 1.0), 0.3);
}

TEST(TerrainMap, OutsideIsIgnored) {
  TerrainMap map;
  map.insert(40.0, 0.0, 1.0, 1.0);
  map.insert(-15.1, 0.0, 1.0, 1.0);
  EXPECT_FALSE(map.height(40.0, 0.0));
  EXPECT_EQ(map.height_or(40.0, 0.0, -7.0), -7.0);
}

}  // namespace
