#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <utility>

#include "core/scanline_raster.h"
#include "map_cells.hpp"

namespace berm::core_test {
namespace {

constexpr std::int32_t kMin32 = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMax32 = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t kNow = 5'000'000;
constexpr std::int32_t kGeneration = 1'000'000;

using Cells = std::set<std::pair<int, int>>;  // (iy, ix)

class ScanlineRaster : public testing::Test {
 protected:
  std::int32_t raster(const sk_point& p, const sk_point& q) { return sk_raster_segment(map.get(), &p, &q, kNow, kGeneration); }
  Cells seen() const {
    Cells cells;
    for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (int ix = 0; ix < SK_MAP_CELLS; ++ix)
        if (map->seen_us[iy][ix] == kNow) cells.emplace(iy, ix);
    return cells;
  }
  std::int32_t height(int iy, int ix) const { return map->height_mm[iy][ix]; }

  std::unique_ptr<sk_height_map> map = cleared_map();
};

// verifies: SK-RS-1
TEST_F(ScanlineRaster, RefusalsChangeNothing) {
  ASSERT_GE(raster({-900, -900, 5}, {900, 900, 5}), 0);
  const auto before = std::make_unique<sk_height_map>(*map);
  const auto refused = [&](const sk_point& p, const sk_point& q, std::int64_t now_us, std::int32_t generation_us) {
    return sk_raster_segment(map.get(), &p, &q, now_us, generation_us) == -1 && same(*map, *before);
  };
  const sk_point good{100, 200, 300};
  for (const std::int32_t beyond : {kMin32, -32001, 32001, kMax32}) {
    for (const sk_point& bad : {sk_point{beyond, 0, 0}, sk_point{0, beyond, 0}}) {
      EXPECT_TRUE(refused(bad, good, kNow, kGeneration)) << beyond;
      EXPECT_TRUE(refused(good, bad, kNow, kGeneration)) << beyond;
    }
  }
  for (const std::int32_t beyond : {kMin32, -20001, 20001, kMax32}) {
    EXPECT_TRUE(refused({0, 0, beyond}, good, kNow, kGeneration)) << beyond;
    EXPECT_TRUE(refused(good, {0, 0, beyond}, kNow, kGeneration)) << beyond;
  }
  EXPECT_TRUE(refused(good, {-100, 0, 0}, -1, kGeneration));
  EXPECT_TRUE(refused(good, {-100, 0, 0}, kNow, 0));
  EXPECT_TRUE(refused(good, {-100, 0, 0}, kNow, -1));
}

// verifies: SK-RS-1, SK-RS-9
TEST_F(ScanlineRaster, TheFarthestCornersAreTaken) {
  EXPECT_EQ(raster({-32000, -32000, -20000}, {32000, 32000, 20000}), 3 * 104 - 2);  // the diagonal touches both neighbours at every cell corner
  EXPECT_EQ(height(103, 103), 20000 * 15600 / 32000);
  EXPECT_EQ(height(0, 0), -20000 * 15300 / 32000);
  sk_map_clear(map.get());
  EXPECT_EQ(raster({32000, -32000, 20000}, {32000, 32000, 20000}), 0);
  EXPECT_TRUE(seen().empty());
  sk_point p{100, 100, 7};
  EXPECT_EQ(sk_raster_segment(map.get(), &p, &p, 0, 1), 1);
  EXPECT_EQ(cell_of(*map, 52, 52), (Cell{7, 7, 0, 0}));
}

// verifies: SK-RS-5, SK-RS-6
TEST_F(ScanlineRaster, EqualPointsRaiseTheCellsThatHoldThem) {
  EXPECT_EQ(raster({100, 100, 7}, {100, 100, 3}), 1);
  EXPECT_EQ(seen(), (Cells{{52, 52}}));
  EXPECT_EQ(height(52, 52), 7);
  sk_map_clear(map.get());
  EXPECT_EQ(raster({0, 100, 7}, {0, 100, 9}), 2);
  EXPECT_EQ(seen(), (Cells{{52, 51}, {52, 52}}));
  EXPECT_EQ(height(52, 51), 9);
  sk_map_clear(map.get());
  EXPECT_EQ(raster({100, 300, 7}, {100, 300, 9}), 2);
  EXPECT_EQ(seen(), (Cells{{52, 52}, {53, 52}}));
  sk_map_clear(map.get());
  EXPECT_EQ(raster({-300, 300, -7}, {-300, 300, -9}), 4);
  EXPECT_EQ(seen(), (Cells{{52, 50}, {52, 51}, {53, 50}, {53, 51}}));
  for (const auto& [iy, ix] : seen()) EXPECT_EQ(height(iy, ix), -7);
}

// verifies: SK-RS-2, SK-RS-5, SK-RS-9
TEST_F(ScanlineRaster, OnTheMapsOwnBorder) {
  EXPECT_EQ(raster({15600, 15600, 1}, {15600, 15600, 1}), 1);
  EXPECT_EQ(raster({-15600, -15600, 1}, {-15600, -15600, 1}), 1);
  EXPECT_EQ(seen(), (Cells{{103, 103}, {0, 0}}));
  EXPECT_EQ(raster({15601, 15600, 1}, {15601, 15600, 1}), 0);
  EXPECT_EQ(raster({-15601, 0, 1}, {-15601, 900, 1}), 0);
  EXPECT_EQ(raster({-15600, 10, 1}, {-15600, 290, 1}), 1);
  EXPECT_EQ(seen(), (Cells{{103, 103}, {0, 0}, {52, 0}}));
}

// verifies: SK-RS-2, SK-RS-3, SK-RS-6
TEST_F(ScanlineRaster, AlongABorderBothSidesAreRaised) {
  EXPECT_EQ(raster({10, 0, 4}, {590, 0, 4}), 4);
  EXPECT_EQ(seen(), (Cells{{51, 52}, {51, 53}, {52, 52}, {52, 53}}));
  sk_map_clear(map.get());
  EXPECT_EQ(raster({600, 590, 4}, {600, 310, 4}), 2);
  EXPECT_EQ(seen(), (Cells{{53, 53}, {53, 54}}));
}

// verifies: SK-RS-2, SK-RS-3
TEST_F(ScanlineRaster, AnEndOnABorderTouchesTheCellBeyond) {
  EXPECT_EQ(raster({10, 10, 4}, {300, 20, 40}), 2);
  EXPECT_EQ(seen(), (Cells{{52, 52}, {52, 53}}));
  EXPECT_EQ(height(52, 53), 40);
  sk_map_clear(map.get());
  EXPECT_EQ(raster({290, 20, 40}, {0, 10, 4}), 2);
  EXPECT_EQ(seen(), (Cells{{52, 51}, {52, 52}}));
  EXPECT_EQ(height(52, 51), 4);
  sk_map_clear(map.get());
  EXPECT_EQ(raster({10, 10, 4}, {299, 20, 40}), 1);
}

// verifies: SK-RS-2, SK-RS-8
TEST_F(ScanlineRaster, HeightsAreThoseOfTheSegmentAboveEachCell) {
  EXPECT_EQ(raster({150, 150, 0}, {1050, 150, 900}), 4);
  EXPECT_EQ(height(52, 52), 150);
  EXPECT_EQ(height(52, 53), 450);
  EXPECT_EQ(height(52, 54), 750);
  EXPECT_EQ(height(52, 55), 900);
  sk_map_clear(map.get());
  EXPECT_EQ(raster({150, 1050, 0}, {150, 150, 1}), 4);
  EXPECT_EQ(height(55, 52), 1);  // rounded up
  EXPECT_EQ(height(52, 52), 1);
  sk_map_clear(map.get());
  EXPECT_EQ(raster({150, 1050, 0}, {150, 150, -1}), 4);
  EXPECT_EQ(height(55, 52), 0);
  EXPECT_EQ(height(52, 52), 0);  // -2/3 rounded up
}

// verifies: SK-RS-7
TEST_F(ScanlineRaster, TheSameFromEitherEnd) {
  const sk_point ends[][2] = {{{17, -3020, 55}, {3111, 44, -990}}, {{0, 0, 1}, {300, 900, 77}}, {{-600, 600, 3}, {600, -600, 8}}, {{5, 5, 1}, {5, 5, 2}}};
  for (const auto& end : ends) {
    auto other = cleared_map();
    EXPECT_EQ(raster(end[0], end[1]), sk_raster_segment(other.get(), &end[1], &end[0], kNow, kGeneration));
    EXPECT_TRUE(same(*map, *other));
    sk_map_clear(map.get());
  }
}

// verifies: SK-RS-4
TEST_F(ScanlineRaster, SweepsRotateAsInTheMap) {
  put(*map, 52, 52, {800, 900, kNow - kGeneration, kNow - 5});     // due
  put(*map, 52, 53, {800, 900, kNow - kGeneration + 1, kNow - 5});  // not yet due
  put(*map, 52, 54, {10, 900, kNow - kGeneration + 1, kNow - 5});
  EXPECT_EQ(raster({10, 10, 20}, {890, 10, 20}), 3);
  EXPECT_EQ(cell_of(*map, 52, 52), (Cell{20, 800, kNow, kNow}));
  EXPECT_EQ(cell_of(*map, 52, 53), (Cell{800, 900, kNow - kGeneration + 1, kNow}));
  EXPECT_EQ(cell_of(*map, 52, 54), (Cell{20, 900, kNow - kGeneration + 1, kNow}));
}

}  // namespace
}  // namespace berm::core_test
