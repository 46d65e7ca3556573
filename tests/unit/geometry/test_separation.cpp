#include "geometry/separation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <utility>

#include "geometry/slice_planes.hpp"
#include "pass_over.hpp"

namespace berm::kernel::test {
namespace {

constexpr int64_t now_us = 50000000;

// An upright block in the base frame with its planes, over known flat ground at 0.
class SeparationUnit : public ::testing::Test {
protected:
  SeparationUnit() : map(std::make_unique<sk_height_map>()), choice(std::make_unique<sk_choice>()) {
    sk_map_clear(map.get());
    for (int32_t iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (int32_t ix = 0; ix < SK_MAP_CELLS; ++ix) EXPECT_TRUE(sk_map_insert(map.get(), iy, ix, 0, now_us - 1000, 1000000));
    rules.now_us = now_us;
    rules.fresh_us = 1000000;
    rules.margin_mm = 300;
    rules.own_body_radius_mm = 3000;
    berm::test::pass_over(rules);
    block(2, 5010, 10, 6190, 290, 1000, 2000);
    std::memset(choice.get(), 77, sizeof(sk_choice));
  }
  void block(int32_t link, int32_t x0, int32_t y0, int32_t x1, int32_t y1, int32_t z0, int32_t z1) {
    slice.link = link;
    slice.vertices = 8;
    for (int i = 0; i < 8; ++i) {
      slice.xyz_mm[0][i] = i & 1 ? x1 : x0;
      slice.xyz_mm[1][i] = i & 2 ? y1 : y0;
      slice.xyz_mm[2][i] = i & 4 ? z1 : z0;
    }
    slice.planes = 1;
    slice.plane[0] = {0, 0, 1, z0 - 1};
    candidates = {};
    for (const auto& [x, y] : {std::pair{0, -1}, std::pair{0, 1}, std::pair{1, 0}, std::pair{-1, 0}}) offer(x * normal_scale, y * normal_scale, 0);
  }
  // A normal for the search to try.
  void offer(int32_t nx, int32_t ny, int32_t nz) {
    const int k = candidates.count++;
    candidates.nx[k] = nx;
    candidates.ny[k] = ny;
    candidates.nz[k] = nz;
    candidates.offset[k] = static_cast<float>(plane_offset(slice, nx, ny, nz) + 1);
  }
  bool choose() {
    const auto columns = std::make_unique<sk_columns>();
    return sk_columns_of(map.get(), &rules, columns.get()) && choose_planes(*map, *columns, rules, candidates, slice, *choice);
  }
  int32_t verdict() const {
    sk_clearance_result result{};
    sk_clear_slice(map.get(), &slice, choice.get(), &rules, &result);
    return result.verdict;
  }
  static int32_t cell(int32_t v_mm) { return sk_map_index(v_mm); }
  int plane_at(int32_t x_mm, int32_t y_mm) const { return choice->plane_of[cell(y_mm)][cell(x_mm)]; }
  void raise(int32_t x_mm, int32_t y_mm, int32_t z_mm) { ASSERT_TRUE(sk_map_insert(map.get(), cell(y_mm), cell(x_mm), z_mm, now_us - 500, 1000000)); }
  void forget(int32_t x_mm, int32_t y_mm) { map->seen_us[cell(y_mm)][cell(x_mm)] = -1; }

  std::unique_ptr<sk_height_map> map;
  std::unique_ptr<sk_choice> choice;
  sk_slice slice{};
  PlaneCandidates candidates{};
  sk_clearance_rules rules{};
};

} // namespace

// verifies: SK-GE-10
TEST_F(SeparationUnit, LowGroundIsLeftToTheHorizontalPlane) {
  EXPECT_TRUE(choose());
  EXPECT_EQ(verdict(), SK_CLEAR);
  for (int32_t x = 5010; x < 6190; x += 100) EXPECT_EQ(plane_at(x, 100), 0);
  EXPECT_EQ(plane_at(4000, 100), 77); // outside the rectangle: untouched
}

// verifies: SK-GE-10
TEST_F(SeparationUnit, TheMarginCountsToTheMillimetre) {
  raise(5500, 100, 699); // top with margin 999, lowest vertex 1000: d of the horizontal plane is 999
  EXPECT_TRUE(choose());
  EXPECT_EQ(verdict(), SK_CLEAR);
  raise(5500, 100, 700);
  EXPECT_FALSE(choose());
  EXPECT_EQ(verdict(), SK_BLOCKED_COLLISION);
}

// verifies: SK-GE-11
TEST_F(SeparationUnit, UnknownAndHighCellsBesideTheSliceGetAnUprightPlane) {
  // turned by 45 degrees the bounding rectangle has empty corners
  const double c = 0.7071067811865476;
  slice.vertices = 8;
  for (int i = 0; i < 8; ++i) {
    const int32_t x = i & 1 ? 6000 : 4000, y = i & 2 ? 300 : -300;
    slice.xyz_mm[0][i] = static_cast<int32_t>(x * c - y * c);
    slice.xyz_mm[1][i] = static_cast<int32_t>(x * c + y * c);
    slice.xyz_mm[2][i] = i & 4 ? 2000 : 1000;
  }
  candidates.count = 0;
  slice.planes = 1;
  for (const auto& [x, y] : {std::pair{1, -1}, std::pair{-1, 1}, std::pair{1, 1}, std::pair{-1, -1}}) offer(x * 11585, y * 11585, 0);
  forget(4350, 2750);
  raise(2750, 4350, 5000);
  map->seen_us[cell(2750)][cell(4050)] = now_us - rules.fresh_us - 1; // stale
  EXPECT_TRUE(choose());
  EXPECT_EQ(verdict(), SK_CLEAR);
  for (const auto& [x, y] : {std::pair{4350, 2750}, std::pair{2750, 4350}, std::pair{4050, 2750}}) {
    ASSERT_GT(plane_at(x, y), 0);
    EXPECT_EQ(slice.plane[plane_at(x, y)].nz, 0);
  }
}

// verifies: SK-GE-12
TEST_F(SeparationUnit, AnUnknownCellUnderTheSliceEndsTheSearchWithZeros) {
  forget(5500, 100);
  EXPECT_FALSE(choose());
  EXPECT_EQ(verdict(), SK_BLOCKED_UNKNOWN);
  for (int32_t x = 5500; x < 6190; x += 100) EXPECT_EQ(plane_at(x, 100), 0);
  map->seen_us[cell(100)][cell(5500)] = now_us - rules.fresh_us - 1;
  EXPECT_FALSE(choose());
  EXPECT_EQ(verdict(), SK_BLOCKED_STALE);
  map->seen_us[cell(100)][cell(5500)] = now_us - rules.fresh_us;
  EXPECT_TRUE(choose());
  EXPECT_EQ(verdict(), SK_CLEAR);
}

// A stamp from the future is no observation.
// verifies: SK-GE-12
TEST_F(SeparationUnit, ACellSeenInTheFutureIsNotKnown) {
  map->seen_us[cell(100)][cell(5500)] = now_us;
  EXPECT_TRUE(choose());
  map->seen_us[cell(100)][cell(5500)] = now_us + 1;
  EXPECT_FALSE(choose());
  EXPECT_EQ(verdict(), SK_BLOCKED_STALE);
}

// A side of the slice on the border of an unknown cell touches it: a plane through both separates nothing.
// verifies: SK-GE-10
TEST_F(SeparationUnit, TouchingIsNotSeparated) {
  block(2, 5100, 10, 6190, 290, 1000, 2000);
  forget(5000, 100);
  EXPECT_FALSE(choose());
  EXPECT_EQ(plane_at(5000, 100), 0);
  EXPECT_EQ(verdict(), SK_BLOCKED_UNKNOWN);
  block(2, 5101, 10, 6190, 290, 1000, 2000);
  EXPECT_TRUE(choose());
  EXPECT_EQ(verdict(), SK_CLEAR);
}

// A wedge whose lower face slopes: ground that is higher than its lowest vertex lies below the face elsewhere.
// verifies: SK-GE-10
TEST_F(SeparationUnit, SlantedPlanesClearGroundBelowASlopingFace) {
  block(2, 5000, 10, 8000, 290, 3000, 5000);
  slice.xyz_mm[2][0] = slice.xyz_mm[2][2] = 600; // near end low
  slice.plane[0].d = 599;
  offer(-2400 * 4, 0, 3000 * 4); // the face from (5000, 600) to (8000, 3000)
  raise(7300, 100, 800);
  EXPECT_TRUE(choose());
  EXPECT_EQ(verdict(), SK_CLEAR);
  EXPECT_GT(slice.plane[plane_at(7300, 100)].nz, 1);
  raise(5500, 100, 800);
  EXPECT_FALSE(choose());
  EXPECT_EQ(verdict(), SK_BLOCKED_COLLISION);
}

// verifies: SK-GE-13
TEST_F(SeparationUnit, OnlyTheBoomMayBeOverTheOwnBody) {
  for (int32_t iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int32_t ix = 0; ix < SK_MAP_CELLS; ++ix)
      if (std::hypot(SK_MAP_ORIGIN_MM + (ix + 0.5) * SK_CELL_MM, SK_MAP_ORIGIN_MM + (iy + 0.5) * SK_CELL_MM) < 2750) map->seen_us[iy][ix] = -1;
  block(1, 610, 10, 2300, 290, 1500, 2500);
  EXPECT_TRUE(choose());
  EXPECT_EQ(verdict(), SK_CLEAR);
  slice.link = 2;
  EXPECT_FALSE(choose());
  EXPECT_EQ(verdict(), SK_BLOCKED_UNKNOWN);
}

// verifies: SK-GE-13
TEST_F(SeparationUnit, SoilInADigZoneNeedsNoPlaneAboveTheFloor) {
  for (int32_t x = 5100; x < 6190; x += 300) raise(x, 100, 1500);
  for (int32_t x = 4900; x < 6500; x += 300)
    for (int32_t y : {-100, 100, 350}) raise(x, y, 1500);
  EXPECT_FALSE(choose());
  rules.dig_zones = 1;
  rules.dig_zone[0] = {4000, -4000, 9000, 4000, 900, 20000};
  EXPECT_FALSE(choose()); // not allowed at this speed
  rules.dig_allowed = true;
  EXPECT_TRUE(choose());
  EXPECT_EQ(verdict(), SK_CLEAR);
  rules.dig_zone[0].floor_mm = 1001; // the lowest vertex is at 1000
  EXPECT_FALSE(choose());
  EXPECT_EQ(verdict(), SK_BLOCKED_FLOOR);
}

// verifies: SK-GE-10, SK-GE-12
TEST_F(SeparationUnit, WhatIsTooHighToBePassedOverGetsAnUprightPlaneOrNone) {
  raise(5500, 100, 400);
  EXPECT_TRUE(choose());
  EXPECT_EQ(verdict(), SK_CLEAR);
  rules.pass_mm[cell(100)][cell(5500)] = 399;
  EXPECT_FALSE(choose());
  EXPECT_EQ(verdict(), SK_BLOCKED_OVERPASS);
  raise(5500, 100, 900);  // into the slice, with the margin
  EXPECT_FALSE(choose());
  EXPECT_EQ(verdict(), SK_BLOCKED_COLLISION);
  block(2, 5110, 10, 6190, 290, 1000, 2000);
  raise(5000, 100, 5000);  // beside the slice, outside its rectangle
  rules.pass_mm[cell(100)][cell(5500)] = 30000;
  EXPECT_FALSE(choose());
  rules.dig_zones = 1;
  rules.dig_zone[0] = {4000, -4000, 9000, 4000, 900, 1000};
  rules.dig_allowed = true;
  rules.pass_mm[cell(100)][cell(5500)] = 399;  // soil that may be dug is touched, not passed over
  EXPECT_TRUE(choose());
  EXPECT_EQ(verdict(), SK_CLEAR);
}

// verifies: SK-GE-14
TEST_F(SeparationUnit, MalformedSlicesAndSlicesOutOfTheMapAreRefusedUntouched) {
  const sk_slice good = slice;
  const auto before = std::make_unique<sk_choice>(*choice);
  const auto refused = [&] { return !choose() && std::memcmp(choice.get(), before.get(), sizeof(sk_choice)) == 0; };
  for (const int32_t bad : {0, -1, SK_SLICE_VERTICES + 1}) {
    slice.vertices = bad;
    EXPECT_TRUE(refused());
  }
  slice = good;
  for (const int32_t bad : {0, -1, SK_SLICE_PLANES + 1}) {
    slice.planes = bad;
    EXPECT_TRUE(refused());
  }
  slice = good;
  slice.plane[0].ny = SK_NORMAL_MAX + 1;
  EXPECT_TRUE(refused());
  slice = good;
  slice.xyz_mm[1][5] = 15700; // past the last cell
  EXPECT_TRUE(refused());
  slice = good;
  slice.xyz_mm[2][5] = SK_COORD_MAX_MM + 1;
  EXPECT_TRUE(refused());
}

// A plane that the slice came with and that does not hold is not used: it claims to have nearly everything below it.
// verifies: SK-GE-10
TEST_F(SeparationUnit, APlaneThatDoesNotHoldIsNotUsed) {
  raise(5500, 100, 900);
  slice.plane[slice.planes++] = {0, 0, 1, 1000};
  slice.plane[slice.planes++] = {normal_scale, 0, 0, int64_t{normal_scale} * 6190};
  EXPECT_FALSE(choose());
  EXPECT_EQ(plane_at(5500, 100), 0);
  EXPECT_EQ(verdict(), SK_BLOCKED_COLLISION);
}

// A candidate's offset is a hint: wrong by metres it costs a plane, and no more.
// verifies: SK-GE-10
TEST_F(SeparationUnit, AWrongHintMisleadsNobody) {
  raise(5500, 100, 900);
  for (int k = 0; k < candidates.count; ++k) candidates.offset[k] += 4000.0F * normal_scale;
  EXPECT_FALSE(choose());
  EXPECT_EQ(verdict(), SK_BLOCKED_COLLISION);
}

// verifies: SK-GE-27
TEST_F(SeparationUnit, PlanesAreAddedOnlyWhereTheyAreNeeded) {
  EXPECT_TRUE(choose());
  EXPECT_EQ(slice.planes, 1);
  block(2, 5110, 10, 6190, 290, 1000, 2000);
  forget(5000, 100); // beside the block: its square ends at 5100, and it is outside the rectangle
  EXPECT_TRUE(choose());
  EXPECT_EQ(slice.planes, 1);
  block(2, 5100, 10, 6190, 290, 1000, 2000);
  EXPECT_FALSE(choose());
}

// verifies: SK-GE-14
TEST_F(SeparationUnit, HeightsOutOfAllRangeDoNotOverflow) {
  map->height_mm[cell(100)][cell(5500)] = INT32_MAX;
  EXPECT_FALSE(choose());
  map->height_mm[cell(100)][cell(5500)] = map->previous_mm[cell(100)][cell(5500)] = INT32_MIN;
  EXPECT_TRUE(choose());
}

} // namespace berm::kernel::test
