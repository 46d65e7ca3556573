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

TEST(TerrainMap, ThePassageOfTheBucketBoundsUntilSeenAgain) {
  TerrainMap map;
  map.lower_to(7.0, 0.0, -1.5);
  EXPECT_FALSE(map.height(7.0, 0.0));
  EXPECT_EQ(map.bound(7.0, 0.0), -1.5);
  map.insert(7.0, 0.0, -1.2, 3.0);  // soil slid in
  EXPECT_EQ(map.height(7.0, 0.0), -1.2);
  EXPECT_FALSE(map.bound(7.0, 0.0));
  map.lower_to(7.0, 0.0, -1.4);
  EXPECT_EQ(map.height(7.0, 0.0), -1.4);
}

}  // namespace
