#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <memory>

#include "clearance_scene.hpp"
#include "map_cells.hpp"

namespace berm::core_test {
namespace {

// A block over the cells 53, 54 along x and 53 along y (its edges are inside the cells), from 1000 mm up.
constexpr Block kBlock{310, 890, 310, 590, 1000, 1500};

// A triangle over the cells 53 and 54 squared that leaves out cell (54, 54); plane 5 is upright along its long side.
sk_slice triangle() {
  sk_slice s = block_slice(3, kBlock);
  s.vertices = 3;
  const std::int32_t corners[3][3] = {{310, 310, 1000}, {605, 310, 1000}, {310, 605, 1000}};
  for (int i = 0; i < 3; ++i)
    for (int axis = 0; axis < 3; ++axis) s.xyz_mm[axis][i] = corners[i][axis];
  s.plane[5] = {-1, -1, 0, -915 - 1};
  return s;
}

class Clearance : public testing::Test {
 protected:
  void SetUp() override {
    level(*map, 0);
    choose(*choice, 0);
  }
  sk_clearance_result check(const sk_slice& s) {
    sk_clearance_result out{-7, -7, -7, -7};
    sk_clear_slice(map.get(), &s, choice.get(), &rules, &out);
    EXPECT_TRUE(same(out, judge(*map, s, *choice, rules))) << "the reference judges otherwise";
    return out;
  }
  void expect(const sk_clearance_result& out, std::int32_t verdict, std::int32_t iy, std::int32_t ix, std::int32_t cells) {
    EXPECT_EQ(out.verdict, verdict);
    EXPECT_EQ(out.iy, iy);
    EXPECT_EQ(out.ix, ix);
    EXPECT_EQ(out.cells, cells);
  }
  void age(int iy, int ix, std::int64_t age_us) { map->seen_us[iy][ix] = kSceneNow - age_us; }
  void zone(const berm_dig_zone& z) {
    rules.dig_allowed = true;
    rules.dig_zone[rules.dig_zones++] = z;
  }

  std::unique_ptr<sk_height_map> map = cleared_map();
  std::unique_ptr<sk_choice> choice = std::make_unique<sk_choice>();
  sk_clearance_rules rules = scene_rules();
};

// verifies: SK-CL-1, SK-CL-4, SK-CL-13
TEST_F(Clearance, AboveTheGround) {
  expect(check(block_slice(3, kBlock)), SK_CLEAR, -1, -1, 2);
  level(*map, 699);  // 999 with the margin: the plane lies at 999
  expect(check(block_slice(3, kBlock)), SK_CLEAR, -1, -1, 2);
  level(*map, 700);  // they would touch
  expect(check(block_slice(3, kBlock)), SK_BLOCKED_COLLISION, 53, 53, 1);
}

// verifies: SK-CL-4
TEST_F(Clearance, TheLargerGenerationCounts) {
  map->previous_mm[53][54] = 700;
  expect(check(block_slice(3, kBlock)), SK_BLOCKED_COLLISION, 53, 54, 2);
  put(*map, 53, 54, {700, 0, 0, kSceneNow});
  expect(check(block_slice(3, kBlock)), SK_BLOCKED_COLLISION, 53, 54, 2);
}

// verifies: SK-CL-2, SK-CL-13
TEST_F(Clearance, ABorderCountsForTheCellsOnBothSides) {
  const sk_slice s = block_slice(3, {300, 900, 600, 600, 1000, 1500});
  sk_rectangle r{};
  ASSERT_TRUE(sk_slice_rectangle(&s, &r));
  EXPECT_EQ(r.ix_low, 52);
  EXPECT_EQ(r.ix_high, 55);
  EXPECT_EQ(r.iy_low, 53);
  EXPECT_EQ(r.iy_high, 54);
  expect(check(s), SK_CLEAR, -1, -1, 8);
  map->height_mm[54][55] = 5000;
  expect(check(s), SK_BLOCKED_COLLISION, 54, 55, 8);
  map->height_mm[54][52] = 5000;
  expect(check(s), SK_BLOCKED_COLLISION, 54, 52, 5);
  map->height_mm[53][55] = 5000;
  expect(check(s), SK_BLOCKED_COLLISION, 53, 55, 4);
}

// verifies: SK-CL-3
TEST_F(Clearance, RectangleAtTheMapsEdge) {
  const sk_rectangle untouched{-9, -9, -9, -9};
  for (const int side : {-1, 1}) {
    for (const bool along_x : {false, true}) {
      const std::int32_t inside = side < 0 ? -15599 : 15599;
      const std::int32_t edge = side < 0 ? -15600 : 15600;
      const auto at = [&](std::int32_t v) { return block_slice(3, along_x ? Block{v, v, 0, 0, 1000, 1000} : Block{0, 0, v, v, 1000, 1000}); };
      sk_rectangle r = untouched;
      const sk_slice within = at(inside), beyond = at(edge);
      EXPECT_TRUE(sk_slice_rectangle(&within, &r));
      EXPECT_EQ(along_x ? r.ix_low : r.iy_low, side < 0 ? 0 : 103);
      EXPECT_EQ(along_x ? r.ix_high : r.iy_high, side < 0 ? 0 : 103);
      expect(check(within), SK_CLEAR, -1, -1, 2);
      r = untouched;
      EXPECT_FALSE(sk_slice_rectangle(&beyond, &r));
      EXPECT_TRUE(r.ix_low == -9 && r.ix_high == -9 && r.iy_low == -9 && r.iy_high == -9) << "a refusal wrote its output";
      expect(check(beyond), SK_BLOCKED_UNKNOWN, -1, -1, 0);
    }
  }
}

// verifies: SK-CL-5
TEST_F(Clearance, NeverObservedOrStaleHasNoTop) {
  const sk_slice s = block_slice(3, kBlock);
  map->seen_us[53][54] = -1;
  expect(check(s), SK_BLOCKED_UNKNOWN, 53, 54, 2);
  age(53, 54, kSceneFresh);
  expect(check(s), SK_CLEAR, -1, -1, 2);
  age(53, 54, kSceneFresh + 1);
  expect(check(s), SK_BLOCKED_STALE, 53, 54, 2);
  age(53, 54, -1);  // seen in the future
  expect(check(s), SK_BLOCKED_STALE, 53, 54, 2);
  map->seen_us[53][54] = 0;
  rules.now_us = kSceneFresh;
  level(*map, -20000);
  for (auto& row : map->seen_us)
    for (std::int64_t& seen : row) seen = 0;
  expect(check(s), SK_CLEAR, -1, -1, 2);
}

// verifies: SK-CL-5, SK-CL-6
TEST_F(Clearance, OnlyAnUprightPlaneSeparatesWhatHasNoTop) {
  sk_slice s = triangle();
  map->seen_us[54][54] = -1;
  expect(check(s), SK_BLOCKED_UNKNOWN, 54, 54, 4);
  choice->plane_of[54][54] = 5;  // the cell's near corner is (600, 600): -1200 <= -916
  expect(check(s), SK_CLEAR, -1, -1, 4);
  age(54, 54, kSceneFresh + 1);
  expect(check(s), SK_CLEAR, -1, -1, 4);
  s.plane[5].nz = 1;
  s.plane[5].d += 1000;
  expect(check(s), SK_BLOCKED_STALE, 54, 54, 4);
  s.plane[5].nz = 0;
  s.plane[5].d = -915;  // touches a vertex
  expect(check(s), SK_BLOCKED_STALE, 54, 54, 4);
}

// verifies: SK-CL-6
TEST_F(Clearance, EachCellHasItsOwnPlane) {
  const sk_slice s = triangle();
  map->height_mm[54][54] = 9000;
  expect(check(s), SK_BLOCKED_COLLISION, 54, 54, 4);
  choice->plane_of[54][54] = 5;
  expect(check(s), SK_CLEAR, -1, -1, 4);
  choice->plane_of[53][54] = 5;  // holds, but not for this cell
  expect(check(s), SK_BLOCKED_COLLISION, 53, 54, 2);
}

// verifies: SK-CL-6
TEST_F(Clearance, APlaneThatDoesNotHoldOrPointsDownIsNone) {
  sk_slice s = block_slice(3, kBlock);
  s.plane[0].d = 1000;  // touches the block
  expect(check(s), SK_BLOCKED_COLLISION, 53, 53, 1);
  s.plane[0] = {0, 0, -1, -1501};  // above the block, and above the column as well: no column lies wholly over a plane
  level(*map, 5000);
  expect(check(s), SK_BLOCKED_COLLISION, 53, 53, 1);
  s.plane[0] = {0, 0, 0, -1};
  expect(check(s), SK_BLOCKED_COLLISION, 53, 53, 1);
  s.plane[0] = {0, 0, 0, 0};
  expect(check(s), SK_BLOCKED_COLLISION, 53, 53, 1);
}

// verifies: SK-CL-6
TEST_F(Clearance, AChoiceBeyondThePlanesIsNone) {
  sk_slice s = block_slice(3, kBlock);
  for (int k = s.planes; k < SK_SLICE_PLANES; ++k) s.plane[k] = s.plane[0];  // there, but not in use
  for (const int plane : {6, 23, 24, 255}) {
    choose(*choice, plane);
    expect(check(s), SK_BLOCKED_COLLISION, 53, 53, 1);
  }
}

// verifies: SK-CL-7
TEST_F(Clearance, OwnBodyIsTheTailsAndTheBoomsAlone) {
  rules.own_body_radius_mm = 849;  // the far corner of cell (53, 53) is at 848.5 mm
  level(*map, 9000);
  map->seen_us[53][53] = -1;
  const Block over_it{310, 590, 310, 590, 1000, 1500};
  expect(check(block_slice(0, over_it)), SK_CLEAR, -1, -1, 1);
  expect(check(block_slice(1, over_it)), SK_CLEAR, -1, -1, 1);
  expect(check(block_slice(2, over_it)), SK_BLOCKED_UNKNOWN, 53, 53, 1);
  level(*map, -9000);
  expect(check(block_slice(3, over_it)), SK_BLOCKED_UNKNOWN, 53, 53, 1);
  rules.own_body_radius_mm = 848;
  expect(check(block_slice(3, over_it)), SK_CLEAR, -1, -1, 1);
  map->seen_us[53][53] = -1;
  expect(check(block_slice(1, over_it)), SK_BLOCKED_UNKNOWN, 53, 53, 1);
}

// verifies: SK-CL-7, SK-CL-8
TEST_F(Clearance, NoDiggingAtTheOwnBody) {
  rules.own_body_radius_mm = 849;
  zone({0, 0, 900, 900, -500, 9000});
  expect(check(block_slice(3, {310, 590, 310, 590, 1000, 1500})), SK_BLOCKED_UNKNOWN, 53, 53, 1);
}

// verifies: SK-CL-8, SK-CL-9
TEST_F(Clearance, TheTailDigsNowhere) {
  level(*map, 2000);
  zone({300, 300, 900, 600, 1000, 2000});
  expect(check(block_slice(1, kBlock)), SK_CLEAR, -1, -1, 2);
  expect(check(block_slice(0, kBlock)), SK_BLOCKED_COLLISION, 53, 53, 1);
  rules.dig_zone[0].floor_mm = 1200;
  expect(check(block_slice(1, kBlock)), SK_BLOCKED_FLOOR, 53, 53, 1);
  expect(check(block_slice(0, kBlock)), SK_BLOCKED_COLLISION, 53, 53, 1);
}

// verifies: SK-CL-8, SK-CL-9
TEST_F(Clearance, DigZone) {
  level(*map, 2000);
  zone({300, 300, 900, 600, 1000, 2000});
  const sk_slice s = block_slice(3, kBlock);
  expect(check(s), SK_CLEAR, -1, -1, 2);
  rules.dig_allowed = false;
  expect(check(s), SK_BLOCKED_COLLISION, 53, 53, 1);
  rules.dig_allowed = true;
  rules.dig_zones = 0;
  expect(check(s), SK_BLOCKED_COLLISION, 53, 53, 1);
  rules.dig_zones = 1;
  rules.dig_zone[0].floor_mm = 1001;
  expect(check(s), SK_BLOCKED_FLOOR, 53, 53, 1);
  level(*map, 0);  // separated: the floor is not asked
  expect(check(s), SK_CLEAR, -1, -1, 2);
}

// verifies: SK-CL-8
TEST_F(Clearance, TheZoneMustHoldTheWholeCell) {
  level(*map, 2000);
  const sk_slice s = block_slice(2, kBlock);
  zone({300, 300, 900, 600, 0, 2000});
  expect(check(s), SK_CLEAR, -1, -1, 2);
  const berm_dig_zone whole = rules.dig_zone[0];
  for (std::int32_t berm_dig_zone::*edge : {&berm_dig_zone::x_low_mm, &berm_dig_zone::y_low_mm}) {
    rules.dig_zone[0] = whole;
    rules.dig_zone[0].*edge += 1;
    expect(check(s), SK_BLOCKED_COLLISION, 53, 53, 1);
  }
  rules.dig_zone[0] = whole;
  rules.dig_zone[0].y_high_mm -= 1;
  expect(check(s), SK_BLOCKED_COLLISION, 53, 53, 1);
  rules.dig_zone[0] = whole;
  rules.dig_zone[0].x_high_mm -= 1;
  expect(check(s), SK_BLOCKED_COLLISION, 53, 54, 2);
}

// verifies: SK-CL-8, SK-CL-9
TEST_F(Clearance, OneOfSeveralZonesIsEnough) {
  level(*map, 2000);
  const sk_slice s = block_slice(3, kBlock);
  zone({300, 300, 900, 600, 1001, 2000});
  zone({300, 300, 600, 600, 1000, 2000});
  expect(check(s), SK_BLOCKED_FLOOR, 53, 54, 2);
  zone({0, 0, 300, 300, 0, 2000});
  zone({600, 0, 900, 900, -100, 2000});
  expect(check(s), SK_CLEAR, -1, -1, 2);
}

// verifies: SK-CL-10
TEST_F(Clearance, InADigZoneTooGroundMustBeKnown) {
  zone({300, 300, 900, 600, 1000, 2000});
  level(*map, 2000);
  const sk_slice s = block_slice(3, kBlock);
  expect(check(s), SK_CLEAR, -1, -1, 2);
  map->seen_us[53][54] = -1;
  expect(check(s), SK_BLOCKED_UNKNOWN, 53, 54, 2);
  age(53, 54, kSceneFresh + 1);
  expect(check(s), SK_BLOCKED_STALE, 53, 54, 2);
  age(53, 54, -1);
  expect(check(s), SK_BLOCKED_STALE, 53, 54, 2);
  age(53, 54, kSceneFresh);
  expect(check(s), SK_CLEAR, -1, -1, 2);
  map->seen_us[53][53] = -1;
  rules.dig_zone[0].floor_mm = 1001;
  expect(check(s), SK_BLOCKED_FLOOR, 53, 53, 1);
}

// verifies: SK-CL-5, SK-CL-10
TEST_F(Clearance, StaleSoilMayCountAsItWasLastSeen) {
  zone({300, 300, 900, 600, 1000, 2000});
  level(*map, 2000);
  rules.dig_stale = true;
  const sk_slice s = block_slice(3, kBlock);
  age(53, 54, kSceneFresh + 1);
  expect(check(s), SK_CLEAR, -1, -1, 2);
  map->height_mm[53][54] = 2001;
  expect(check(s), SK_BLOCKED_STALE, 53, 54, 2);
  map->height_mm[53][54] = 2000;
  map->seen_us[53][54] = -1;
  expect(check(s), SK_BLOCKED_UNKNOWN, 53, 54, 2);
  age(53, 54, kSceneFresh + 1);
  rules.dig_allowed = false;  // nowhere else does it count
  level(*map, 0);
  age(53, 54, kSceneFresh + 1);
  expect(check(s), SK_BLOCKED_STALE, 53, 54, 2);
}

// The margin is not counted: the ceiling says how high soil may be measured.
// verifies: SK-CL-10
TEST_F(Clearance, WhatStandsHigherThanTheCeilingIsNoSoil) {
  zone({300, 300, 900, 600, 1000, 2000});
  level(*map, 2000);
  const sk_slice s = block_slice(3, kBlock);
  map->height_mm[53][54] = 2001;
  expect(check(s), SK_BLOCKED_COLLISION, 53, 54, 2);
  put(*map, 53, 54, {2000, 2001, kSceneNow, kSceneNow});
  expect(check(s), SK_BLOCKED_COLLISION, 53, 54, 2);
  // another zone over the same cell may know of higher soil; one that the slice is too low for gives its reason
  zone({600, 300, 900, 600, 1001, 9000});
  expect(check(s), SK_BLOCKED_FLOOR, 53, 54, 2);
  rules.dig_zone[1].floor_mm = 1000;
  expect(check(s), SK_CLEAR, -1, -1, 2);
}

// A column that is too high to be passed over: beside it is clear, over it is not, however high.
// verifies: SK-CL-15, SK-CL-16
TEST_F(Clearance, WhatIsTooHighIsNotPassedOver) {
  const sk_slice s = block_slice(3, kBlock);
  rules.pass_mm[53][54] = 200;
  map->height_mm[53][54] = 200;
  expect(check(s), SK_CLEAR, -1, -1, 2);  // the margin is not counted
  map->height_mm[53][54] = 201;
  expect(check(s), SK_BLOCKED_OVERPASS, 53, 54, 2);
  put(*map, 53, 54, {200, 201, kSceneNow, kSceneNow});
  expect(check(s), SK_BLOCKED_OVERPASS, 53, 54, 2);
  const sk_slice far_up = block_slice(3, {kBlock.x_low, kBlock.x_high, kBlock.y_low, kBlock.y_high, 15000, 15500});
  expect(check(far_up), SK_BLOCKED_OVERPASS, 53, 54, 2);
  map->height_mm[53][54] = 700;  // it would be struck, with the margin
  expect(check(s), SK_BLOCKED_COLLISION, 53, 54, 2);
  age(53, 54, kSceneFresh + 1);
  expect(check(s), SK_BLOCKED_STALE, 53, 54, 2);
}

// verifies: SK-CL-15, SK-CL-16
TEST_F(Clearance, WhatIsTooHighIsPassedBesideByAnUprightPlane) {
  rules.pass_mm[54][54] = 200;
  map->height_mm[54][54] = 201;
  expect(check(triangle()), SK_BLOCKED_OVERPASS, 54, 54, 4);
  choice->plane_of[54][54] = 5;
  expect(check(triangle()), SK_CLEAR, -1, -1, 4);
  map->height_mm[54][54] = 9000;
  expect(check(triangle()), SK_CLEAR, -1, -1, 4);
  choice->plane_of[54][54] = 0;
  expect(check(triangle()), SK_BLOCKED_COLLISION, 54, 54, 4);
}

// verifies: SK-CL-7, SK-CL-8, SK-CL-15
TEST_F(Clearance, OwnBodyAndSoilToDigHaveTheirOwnRules) {
  level(*map, 2000);
  for (auto& row : rules.pass_mm) std::fill(std::begin(row), std::end(row), std::int16_t{-20000});
  zone({300, 300, 900, 600, 1000, 2000});
  expect(check(block_slice(3, kBlock)), SK_CLEAR, -1, -1, 2);
  rules.own_body_radius_mm = 1500;
  expect(check(block_slice(1, kBlock)), SK_CLEAR, -1, -1, 2);
  expect(check(block_slice(3, kBlock)), SK_BLOCKED_UNKNOWN, 53, 53, 1);
}

}  // namespace
}  // namespace berm::core_test
