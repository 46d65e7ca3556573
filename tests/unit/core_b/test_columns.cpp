// The columns of a map at one time, and the check by height alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>

#include "clearance_scene.hpp"
#include "core/columns.h"
#include "map_cells.hpp"
#include "pass_over.hpp"

namespace berm::core_test {
namespace {

constexpr std::uint64_t kSeed = 77;

class Columns : public testing::Test {
 protected:
  bool make() { return sk_columns_of(map.get(), &rules, columns.get()); }

  std::unique_ptr<sk_height_map> map = cleared_map();
  std::unique_ptr<sk_columns> columns = std::make_unique<sk_columns>();
  sk_clearance_rules rules = scene_rules();
};

// verifies: SK-CO-1, SK-CO-2
TEST_F(Columns, AreTheMapsAndTheBlocksBoundThem) {
  std::mt19937_64 random(kSeed);
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
      map->height_mm[iy][ix] = static_cast<std::int32_t>(random() % 40001) - 20000;
      map->previous_mm[iy][ix] = static_cast<std::int32_t>(random() % 40001) - 20000;
      const std::int64_t stamps[] = {-1, kSceneNow, kSceneNow + 1, kSceneNow - rules.fresh_us, kSceneNow - rules.fresh_us - 1};
      map->seen_us[iy][ix] = stamps[random() % 5];
    }
  for (auto& row : rules.pass_mm)
    for (auto& limit : row) limit = static_cast<std::int16_t>(static_cast<std::int32_t>(random() % 40001) - 20000);
  map->height_mm[3][3] = INT32_MAX;
  map->seen_us[3][3] = kSceneNow;
  ASSERT_TRUE(make());
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
      const std::int64_t top = std::int64_t{std::max(map->height_mm[iy][ix], map->previous_mm[iy][ix])} + rules.margin_mm;
      const bool passed = current(*map, rules, iy, ix) && top - rules.margin_mm <= rules.pass_mm[iy][ix];
      const std::int64_t wanted = passed ? std::min<std::int64_t>(top, SK_NO_TOP) : SK_NO_TOP;
      ASSERT_EQ(columns->top_mm[iy][ix], wanted) << "seed " << kSeed << " cell " << iy << ", " << ix;
      ASSERT_GE(columns->block_mm[iy / SK_BLOCK_CELLS][ix / SK_BLOCK_CELLS], columns->top_mm[iy][ix]);
    }
  for (int by = 0; by < SK_MAP_BLOCKS; ++by)
    for (int bx = 0; bx < SK_MAP_BLOCKS; ++bx) {
      std::int32_t most = INT32_MIN;
      for (int iy = by * SK_BLOCK_CELLS; iy < std::min(SK_MAP_CELLS, (by + 1) * SK_BLOCK_CELLS); ++iy)
        for (int ix = bx * SK_BLOCK_CELLS; ix < std::min(SK_MAP_CELLS, (bx + 1) * SK_BLOCK_CELLS); ++ix) most = std::max(most, columns->top_mm[iy][ix]);
      ASSERT_EQ(columns->block_mm[by][bx], most) << "no higher than need be";
    }
}

// verifies: SK-CO-1
TEST_F(Columns, MalformedRulesAreRefusedUntouched) {
  columns->top_mm[5][5] = 123;
  columns->block_mm[1][1] = 321;
  rules.margin_mm = -1;
  EXPECT_FALSE(make());
  EXPECT_EQ(columns->top_mm[5][5], 123);
  EXPECT_EQ(columns->block_mm[1][1], 321);
}

// Whatever the check by height calls clear, the whole check calls clear with the level plane; and where all is current, low, and no own body, it does.
// verifies: SK-CO-3
TEST_F(Columns, WhatIsClearByHeightIsClear) {
  std::mt19937_64 random(kSeed + 1);
  const auto between = [&](int low, int high) { return low + static_cast<int>(random() % static_cast<std::uint64_t>(high - low + 1)); };
  const auto choice = std::make_unique<sk_choice>();
  choose(*choice, 0);
  int clear = 0, not_clear = 0, own = 0;
  for (int n = 0; n < 3000; ++n) {
    level(*map, 0);
    for (int k = between(0, 6); k > 0; --k) map->height_mm[between(40, 64)][between(40, 64)] = between(-500, 2000);
    if (between(0, 3) == 0) map->seen_us[between(45, 60)][between(45, 60)] = between(0, 1) == 0 ? -1 : kSceneNow - rules.fresh_us - 1;
    rules.own_body_radius_mm = between(0, 1) * 1500;
    test::pass_over(rules);
    for (int k = between(0, 3); k > 0; --k) rules.pass_mm[between(45, 60)][between(45, 60)] = static_cast<std::int16_t>(between(-600, 1500));
    ASSERT_TRUE(make());
    const int x = between(-3000, 3000), y = between(-3000, 3000), z = between(200, 2500);
    const sk_slice slice = block_slice(between(0, 3), {x, x + between(10, 2500), y, y + between(10, 2500), z, z + 500});
    sk_clearance_result whole{};
    sk_clear_slice(map.get(), &slice, choice.get(), &rules, &whole);
    const bool by_height = sk_clear_level(map.get(), columns.get(), &slice, &rules);
    if (by_height) {
      ASSERT_EQ(whole.verdict, SK_CLEAR) << "seed " << kSeed + 1 << " case " << n;
    }
    // the plane of block_slice is the level one just below it: the converse holds but for stick and bucket near an own body
    if (whole.verdict == SK_CLEAR && (slice.link <= 1 || rules.own_body_radius_mm == 0)) {
      ASSERT_TRUE(by_height) << "seed " << kSeed + 1 << " case " << n;
    }
    clear += by_height ? 1 : 0;
    not_clear += by_height ? 0 : 1;
    own += by_height && rules.own_body_radius_mm > 0 ? 1 : 0;
  }
  EXPECT_GT(clear, 300);
  EXPECT_GT(not_clear, 300);
  EXPECT_GT(own, 50);
}

// verifies: SK-CO-3
TEST_F(Columns, NothingOutsideTheMapOrMalformedIsClearByHeight) {
  level(*map, -9000);
  ASSERT_TRUE(make());
  EXPECT_TRUE(sk_clear_level(map.get(), columns.get(), [] { static sk_slice s = block_slice(2, {100, 200, 100, 200, 1000, 1500}); return &s; }(), &rules));
  for (const Block& b : {Block{15500, 15700, 0, 100, 1000, 1500}, Block{0, 100, -15700, -15500, 1000, 1500}, Block{0, 100, 0, 100, 1000, SK_COORD_MAX_MM + 1}}) {
    const sk_slice slice = block_slice(2, b);
    EXPECT_FALSE(sk_clear_level(map.get(), columns.get(), &slice, &rules));
  }
  sk_slice slice = block_slice(2, {100, 200, 100, 200, 1000, 1500});
  slice.vertices = 0;
  EXPECT_FALSE(sk_clear_level(map.get(), columns.get(), &slice, &rules));
  slice = block_slice(4, {100, 200, 100, 200, 1000, 1500});
  EXPECT_FALSE(sk_clear_level(map.get(), columns.get(), &slice, &rules));
}

// Any slice: the cells that a walk over the whole map finds, and the lowest vertex, also where coordinates lie on cells' borders; nothing beyond the map.
// verifies: SK-CO-4
TEST(SliceFootprint, IsEveryCellThatTheVerticesMeet) {
  std::mt19937_64 random(kSeed + 2);
  const auto between = [&](int low, int high) { return low + static_cast<int>(random() % static_cast<std::uint64_t>(high - low + 1)); };
  int inside = 0, outside = 0;
  for (int n = 0; n < 2000; ++n) {
    sk_slice slice = block_slice(between(0, 3), {0, 1, 0, 1, 0, 1});
    slice.vertices = between(1, SK_SLICE_VERTICES);
    const int x = between(-16000, 16000), y = between(-16000, 16000), spread = between(0, 1) * between(1, 3000);
    for (int i = 0; i < slice.vertices; ++i) {
      slice.xyz_mm[0][i] = x + between(-spread, spread);
      slice.xyz_mm[1][i] = y + between(-spread, spread);
      slice.xyz_mm[2][i] = between(-5000, 5000);
      if (std::int32_t& on_border = slice.xyz_mm[between(0, 1)][i]; between(0, 3) == 0) on_border -= on_border % SK_CELL_MM;
    }
    const auto meets = [&](int axis, int cell) {
      const int low = sk_cell_low_mm(cell), *v = slice.xyz_mm[axis];
      return *std::min_element(v, v + slice.vertices) <= low + SK_CELL_MM && low <= *std::max_element(v, v + slice.vertices);
    };
    int ix_low = INT32_MAX, ix_high = INT32_MIN, iy_low = INT32_MAX, iy_high = INT32_MIN;
    for (int cell = -20; cell < SK_MAP_CELLS + 20; ++cell) {
      if (meets(0, cell)) ix_low = std::min(ix_low, cell), ix_high = cell;
      if (meets(1, cell)) iy_low = std::min(iy_low, cell), iy_high = cell;
    }
    const bool in_map = ix_low >= 0 && ix_high < SK_MAP_CELLS && iy_low >= 0 && iy_high < SK_MAP_CELLS;
    sk_footprint found{{-7, -7, -7, -7}, -7};
    ASSERT_EQ(sk_slice_footprint(&slice, &found), in_map) << "seed " << kSeed + 2 << " case " << n;
    (in_map ? inside : outside) += 1;
    if (!in_map) {
      ASSERT_TRUE(found.cells.ix_low == -7 && found.cells.ix_high == -7 && found.cells.iy_low == -7 && found.cells.iy_high == -7 && found.z_low_mm == -7) << "written to";
      continue;
    }
    ASSERT_EQ(found.cells.ix_low, ix_low) << "seed " << kSeed + 2 << " case " << n;
    ASSERT_EQ(found.cells.ix_high, ix_high) << "seed " << kSeed + 2 << " case " << n;
    ASSERT_EQ(found.cells.iy_low, iy_low) << "seed " << kSeed + 2 << " case " << n;
    ASSERT_EQ(found.cells.iy_high, iy_high) << "seed " << kSeed + 2 << " case " << n;
    ASSERT_EQ(found.z_low_mm, *std::min_element(slice.xyz_mm[2], slice.xyz_mm[2] + slice.vertices)) << "seed " << kSeed + 2 << " case " << n;
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(outside, 100);
}

// verifies: SK-CO-4
TEST(SliceFootprint, NoneOfWhatIsMalformed) {
  const sk_slice good = block_slice(2, {100, 200, 100, 200, 1000, 1500});
  sk_footprint found{};
  ASSERT_TRUE(sk_slice_footprint(&good, &found));
  const auto refused = [](const sk_slice& slice) {
    sk_footprint kept{{-7, -7, -7, -7}, -7};
    return !sk_slice_footprint(&slice, &kept) && kept.cells.ix_low == -7 && kept.z_low_mm == -7;
  };
  for (const int vertices : {0, -1, SK_SLICE_VERTICES + 1}) {
    sk_slice slice = good;
    slice.vertices = vertices;
    EXPECT_TRUE(refused(slice)) << vertices << " vertices";
  }
  for (const int planes : {0, -1, SK_SLICE_PLANES + 1}) {
    sk_slice slice = good;
    slice.planes = planes;
    EXPECT_TRUE(refused(slice)) << planes << " planes";
  }
  for (const int link : {-1, 4}) {
    sk_slice slice = good;
    slice.link = link;
    EXPECT_TRUE(refused(slice)) << "link " << link;
  }
  for (int axis = 0; axis < 3; ++axis)
    for (const int value : {SK_COORD_MAX_MM + 1, -SK_COORD_MAX_MM - 1}) {
      sk_slice slice = good;
      slice.xyz_mm[axis][slice.vertices - 1] = value;
      EXPECT_TRUE(refused(slice)) << "axis " << axis << ": " << value;
    }
}

}  // namespace
}  // namespace berm::core_test
