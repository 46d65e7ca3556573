#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "map_cells.hpp"

namespace berm::core_test {
namespace {

constexpr std::int32_t kMin32 = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMax32 = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t kMax64 = std::numeric_limits<std::int64_t>::max();
constexpr std::int32_t kGeneration = 1'000'000;

class HeightMap : public testing::Test {
 protected:
  bool insert(std::int32_t z_mm, std::int64_t now_us) { return sk_map_insert(map.get(), 40, 60, z_mm, now_us, kGeneration); }
  Cell cell() const { return cell_of(*map, 40, 60); }
  std::int32_t top() const { return sk_map_top(map.get(), 40, 60); }

  std::unique_ptr<sk_height_map> map = cleared_map();
};

// verifies: SK-HM-1
TEST_F(HeightMap, ClearForgetsEveryCell) {
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) put(*map, iy, ix, {-iy, ix, 1000 + iy, 2000 + ix});
  sk_map_clear(map.get());
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
      ASSERT_EQ(map->seen_us[iy][ix], -1) << iy << " " << ix;
      ASSERT_EQ(map->height_mm[iy][ix], 20000) << iy << " " << ix;
      ASSERT_EQ(map->previous_mm[iy][ix], 20000) << iy << " " << ix;
    }
}

// verifies: SK-HM-2
TEST_F(HeightMap, IndexRoundsDown) {
  EXPECT_EQ(sk_map_index(-15600), 0);
  EXPECT_EQ(sk_map_index(-15601), -1);
  EXPECT_EQ(sk_map_index(-15301), 0);
  EXPECT_EQ(sk_map_index(-15300), 1);
  EXPECT_EQ(sk_map_index(-1), 51);
  EXPECT_EQ(sk_map_index(0), 52);
  EXPECT_EQ(sk_map_index(15599), 103);
  EXPECT_EQ(sk_map_index(15600), 104);
  for (const std::int32_t v : {kMin32, kMin32 + 1, kMax32 - 1, kMax32}) {
    const std::int64_t low = low_of_cell_mm(sk_map_index(v));
    EXPECT_LE(low, v);
    EXPECT_LT(v, low + 300);
  }
}

// verifies: SK-HM-3
TEST_F(HeightMap, RefusalsChangeNothing) {
  ASSERT_TRUE(insert(100, 5'000'000));
  const auto before = std::make_unique<sk_height_map>(*map);
  const auto refused = [&](std::int32_t iy, std::int32_t ix, std::int64_t now_us, std::int32_t generation_us) {
    const bool inserted = sk_map_insert(map.get(), iy, ix, 900, now_us, generation_us);
    return !inserted && same(*map, *before);
  };
  for (const std::int32_t outside : {kMin32, -1, 104, 105, kMax32}) {
    EXPECT_TRUE(refused(outside, 60, 6'000'000, kGeneration)) << outside;
    EXPECT_TRUE(refused(40, outside, 6'000'000, kGeneration)) << outside;
  }
  EXPECT_TRUE(refused(40, 60, -1, kGeneration));
  EXPECT_TRUE(refused(40, 60, std::numeric_limits<std::int64_t>::min(), kGeneration));
  EXPECT_TRUE(refused(40, 60, 6'000'000, 0));
  EXPECT_TRUE(refused(40, 60, 6'000'000, -1));
  EXPECT_TRUE(refused(40, 60, 6'000'000, kMin32));
}

// verifies: SK-HM-3, SK-HM-4
TEST_F(HeightMap, CornersOfTheMapAndEdgesOfTimeAreTaken) {
  for (const int iy : {0, 103})
    for (const int ix : {0, 103}) {
      ASSERT_TRUE(sk_map_insert(map.get(), iy, ix, 7, 0, 1));
      EXPECT_EQ(cell_of(*map, iy, ix), (Cell{7, 7, 0, 0}));
      ASSERT_TRUE(sk_map_insert(map.get(), iy, ix, 3, kMax64, kMax32));
      EXPECT_EQ(cell_of(*map, iy, ix), (Cell{3, 7, kMax64, kMax64}));
    }
}

// verifies: SK-HM-4
TEST_F(HeightMap, AnInsertionChangesItsCellAlone) {
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) put(*map, iy, ix, {iy, ix, 1000 + iy, 2000 + ix});
  auto expected = std::make_unique<sk_height_map>(*map);
  ASSERT_TRUE(insert(500, 3000));
  put(*expected, 40, 60, {500, 60, 1040, 3000});
  EXPECT_TRUE(same(*map, *expected));
}

// verifies: SK-HM-5
TEST_F(HeightMap, FirstInsertionFillsBothGenerations) {
  ASSERT_TRUE(insert(-250, 5'000'000));
  EXPECT_EQ(cell(), (Cell{-250, -250, 5'000'000, 5'000'000}));
  EXPECT_EQ(top(), -250);
}

// verifies: SK-HM-6, SK-HM-7, SK-HM-10
TEST_F(HeightMap, OldHeightsLeaveWithTheSecondSweepAfterThem) {
  ASSERT_TRUE(insert(2000, 0));
  ASSERT_TRUE(insert(100, kGeneration - 1));  // the same sweep still
  EXPECT_EQ(cell(), (Cell{2000, 2000, 0, kGeneration - 1}));
  ASSERT_TRUE(insert(100, kGeneration));
  EXPECT_EQ(cell(), (Cell{100, 2000, kGeneration, kGeneration}));
  EXPECT_EQ(top(), 2000);
  ASSERT_TRUE(insert(150, kGeneration + 10));
  EXPECT_EQ(cell(), (Cell{150, 2000, kGeneration, kGeneration + 10}));
  ASSERT_TRUE(insert(120, 2 * kGeneration));
  EXPECT_EQ(cell(), (Cell{120, 150, 2 * kGeneration, 2 * kGeneration}));
  EXPECT_EQ(top(), 150);
}

// verifies: SK-HM-7
TEST_F(HeightMap, ASweepOnlyRises) {
  ASSERT_TRUE(insert(100, 10));
  ASSERT_TRUE(insert(300, 20));
  ASSERT_TRUE(insert(200, 30));
  EXPECT_EQ(cell(), (Cell{300, 100, 10, 30}));
  EXPECT_EQ(top(), 300);
}

// verifies: SK-HM-11
TEST_F(HeightMap, AnEarlierTimeAgesTheCellAndBeginsNoSweep) {
  ASSERT_TRUE(insert(100, 5 * kGeneration));
  ASSERT_TRUE(insert(50, kGeneration));
  EXPECT_EQ(cell(), (Cell{100, 100, 5 * kGeneration, kGeneration}));
}

// verifies: SK-HM-8
TEST_F(HeightMap, HeightsAreClamped) {
  ASSERT_TRUE(insert(kMin32, 10));
  EXPECT_EQ(cell(), (Cell{-20000, -20000, 10, 10}));
  ASSERT_TRUE(insert(20001, 20));
  EXPECT_EQ(cell(), (Cell{20000, -20000, 10, 20}));
  ASSERT_TRUE(insert(kMax32, kGeneration + 10));
  EXPECT_EQ(cell(), (Cell{20000, 20000, kGeneration + 10, kGeneration + 10}));
  ASSERT_TRUE(insert(-20001, 2 * kGeneration + 10));
  EXPECT_EQ(cell(), (Cell{-20000, 20000, 2 * kGeneration + 10, 2 * kGeneration + 10}));
}

// verifies: SK-HM-9
TEST_F(HeightMap, TopIsTheLargerGenerationAndHighestOutside) {
  put(*map, 40, 60, {-30, 70, 0, 0});
  EXPECT_EQ(top(), 70);
  put(*map, 40, 60, {71, 70, 0, 0});
  EXPECT_EQ(top(), 71);
  put(*map, 40, 60, {70, 70, 0, 0});
  EXPECT_EQ(top(), 70);
  for (const int i : {0, 103}) put(*map, i, i, {-5, -6, 0, 0});
  EXPECT_EQ(sk_map_top(map.get(), 0, 0), -5);
  EXPECT_EQ(sk_map_top(map.get(), 103, 103), -5);
  for (const std::int32_t outside : {kMin32, -1, 104, kMax32}) {
    EXPECT_EQ(sk_map_top(map.get(), outside, 60), 20000) << outside;
    EXPECT_EQ(sk_map_top(map.get(), 40, outside), 20000) << outside;
  }
}

// verifies: SK-HM-12
TEST_F(HeightMap, KeepCarriesTheEffectiveHeightIntoThisSweep) {
  for (const std::int32_t height : {kMin32, -500, 0, 700, 1400, 20000})
    for (const std::int32_t previous : {-500, 0, 700, 1400, kMax32}) {
      put(*map, 40, 60, {height, previous, 3'000'000, 3'200'000});
      const auto before = std::make_unique<sk_height_map>(*map);
      ASSERT_TRUE(sk_map_keep(map.get(), 40, 60));
      ASSERT_EQ(cell().height_mm, std::max(height, previous));
      ASSERT_EQ(top(), std::max(height, previous)) << "the effective height stays";
      map->height_mm[40][60] = height;
      ASSERT_TRUE(same(*map, *before)) << "nothing else changes, not even when it was seen";
    }
  // The next sweep finds only ground; the one after forgets.
  put(*map, 40, 60, {0, 1400, 3'000'000, 3'200'000});
  ASSERT_TRUE(sk_map_keep(map.get(), 40, 60));
  ASSERT_TRUE(insert(0, 4'000'000));
  EXPECT_EQ(top(), 1400);
  ASSERT_TRUE(insert(0, 5'000'000));
  EXPECT_EQ(top(), 0);
}

// verifies: SK-HM-12
TEST_F(HeightMap, KeepRefusesWhatIsNotThere) {
  const auto before = std::make_unique<sk_height_map>(*map);
  for (const std::int32_t i : {kMin32, -1, SK_MAP_CELLS, kMax32}) {
    EXPECT_FALSE(sk_map_keep(map.get(), i, 60));
    EXPECT_FALSE(sk_map_keep(map.get(), 40, i));
  }
  EXPECT_FALSE(sk_map_keep(map.get(), 40, 60)) << "never observed";
  EXPECT_TRUE(same(*map, *before));
}

}  // namespace
}  // namespace berm::core_test
