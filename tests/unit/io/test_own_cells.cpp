// The machine's own cells: which they are, and how high they stand in the map.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include "io/own_cells.hpp"
#include "mini_machine.hpp"

namespace berm::kernel {
namespace {

constexpr std::int64_t kNow = 1000000;
constexpr std::int32_t kGeneration = 1000000;

class OwnCellsTest : public ::testing::Test {
 protected:
  void SetUp() override { sk_map_clear(map.get()); }
  berm_parameters parameters = berm::test::demo_parameters();
  std::unique_ptr<sk_height_map> map = std::make_unique<sk_height_map>();
};

// verifies: SK-CY-25
TEST_F(OwnCellsTest, CoverTheCircleAndNothingBeyondTheRim) {
  OwnCells(parameters).stamp(*map, kNow, kGeneration);
  const double radius = parameters.own_body_radius_mm;
  int inside = 0, rim = 0;
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy) {
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
      // Independent statement: the cell's nearest and farthest points from the axis.
      const double x = SK_MAP_ORIGIN_MM + ix * SK_CELL_MM, y = SK_MAP_ORIGIN_MM + iy * SK_CELL_MM;
      const double nearest = std::hypot(std::clamp(0.0, x, x + SK_CELL_MM), std::clamp(0.0, y, y + SK_CELL_MM));
      const double farthest = std::hypot(std::max(std::fabs(x), std::fabs(x + SK_CELL_MM)), std::max(std::fabs(y), std::fabs(y + SK_CELL_MM)));
      const bool stamped = map->seen_us[iy][ix] >= 0;
      ASSERT_EQ(stamped, nearest < radius) << ix << ' ' << iy;
      if (!stamped) continue;
      EXPECT_LE(farthest, own_and_rim_radius_mm(parameters));
      const bool own = farthest <= radius;
      EXPECT_EQ(sk_map_top(map.get(), iy, ix), own ? SK_HEIGHT_MAX_MM : 3600);
      ++(own ? inside : rim);
    }
  }
  EXPECT_GT(inside, 200);
  EXPECT_GT(rim, 50);
}

// verifies: SK-CY-25
TEST_F(OwnCellsTest, SomethingHigherInTheRimStays) {
  const OwnCells own(parameters);
  const std::int32_t ix = sk_map_index(2950), iy = sk_map_index(100);
  own.stamp(*map, kNow, kGeneration);
  sk_map_insert(map.get(), iy, ix, 4500, kNow + 10000, kGeneration);
  for (int k = 2; k < 90; ++k) own.stamp(*map, kNow + k * 10000, kGeneration);
  EXPECT_EQ(sk_map_top(map.get(), iy, ix), 4500);
  EXPECT_EQ(map->seen_us[iy][ix], kNow + 890000);
}

// verifies: SK-CY-25
TEST_F(OwnCellsTest, TheOverpassRuleLeavesThemAlone) {
  const OwnCells own(parameters);
  own.stamp(*map, kNow, kGeneration);
  const auto rules = std::make_unique<sk_clearance_rules>();
  for (auto& row : rules->pass_mm) std::fill(std::begin(row), std::end(row), std::int16_t{800});
  rules->pass_mm[52][52] = 30000;  // a higher limit stays
  own.permit(*rules);
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
      const bool stamped = map->seen_us[iy][ix] >= 0;
      const int limit = iy == 52 && ix == 52 ? 30000 : stamped ? sk_map_top(map.get(), iy, ix) : 800;
      ASSERT_EQ(rules->pass_mm[iy][ix], limit) << ix << ' ' << iy;
    }
}

}  // namespace
}  // namespace berm::kernel
