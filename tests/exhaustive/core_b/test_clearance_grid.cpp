// Small planes about one cell, every state of a cell, every cell of the map: each verdict against the words of the header.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "clearance_scene.hpp"
#include "map_cells.hpp"

namespace berm::core_test {
namespace {

class ClearanceGrid : public testing::Test {
 protected:
  void SetUp() override {
    level(*map, -400);
    choose(*choice, 0);
  }
  sk_clearance_result expect_as_said(const sk_slice& s) {
    sk_clearance_result out{-7, -7, -7, -7};
    sk_clear_slice(map.get(), &s, choice.get(), &rules, &out);
    const sk_clearance_result said = judge(*map, s, *choice, rules);
    EXPECT_TRUE(same(out, said)) << "verdict " << out.verdict << " at " << out.iy << " " << out.ix << ", said " << said.verdict << " at " << said.iy
                                 << " " << said.ix;
    ++verdicts[out.verdict];
    return out;
  }

  std::unique_ptr<sk_height_map> map = cleared_map();
  std::unique_ptr<sk_choice> choice = std::make_unique<sk_choice>();
  sk_clearance_rules rules = scene_rules();
  long verdicts[7] = {};
};

sk_slice point_slice(std::int32_t x, std::int32_t y, std::int32_t z) {
  sk_slice s{};
  s.link = 3;
  s.vertices = 1;
  s.xyz_mm[0][0] = x;
  s.xyz_mm[1][0] = y;
  s.xyz_mm[2][0] = z;
  s.planes = 1;
  return s;
}

// A point in, on the border of and above the column of cell (52, 52), which ends at -100 mm; its offset about the least that a corner needs.
// verifies: SK-CL-2, SK-CL-4, SK-CL-6, SK-CL-13
TEST_F(ClearanceGrid, EverySmallPlaneAboutOneCell) {
  for (const int x : {0, 1, 150, 299, 300})
    for (const int y : {0, 1, 150, 299, 300})
      for (const int z : {-101, -100, -99, 0})
        for (int nx = -1; nx <= 1; ++nx)
          for (int ny = -1; ny <= 1; ++ny)
            for (int nz = -1; nz <= 1; ++nz)
              for (int slack = -2; slack <= 2; ++slack)
                for (const bool by_vertex : {false, true}) {
                  sk_slice s = point_slice(x, y, z);
                  const int vertex = nx * x + ny * y + nz * z, corner = 300 * ((nx > 0) + (ny > 0)) - 100 * nz;
                  s.plane[0] = {nx, ny, nz, (by_vertex ? vertex : corner) + slack};
                  expect_as_said(s);
                  if (HasFailure()) FAIL() << x << " " << y << " " << z << " normal " << nx << " " << ny << " " << nz << " d " << s.plane[0].d;
                }
  EXPECT_GT(verdicts[SK_CLEAR], 100);
  EXPECT_GT(verdicts[SK_BLOCKED_COLLISION], 1000);
}

// The far side of a cell that the point is beside, in a slice over both: the plane's own cell is the one that is judged.
// verifies: SK-CL-5, SK-CL-6
TEST_F(ClearanceGrid, EveryUprightPlaneBetweenTwoCells) {
  sk_slice s = block_slice(3, {10, 20, 10, 20, 0, 500});
  s.xyz_mm[0][8] = 310;  // the slice is a wedge into cell (52, 53)
  s.xyz_mm[1][8] = 10;
  s.vertices = 9;
  for (int nx = -3; nx <= 3; ++nx)
    for (int ny = -3; ny <= 3; ++ny)
      for (int d = -2000; d <= 1000; d += 5) {
        s.plane[0] = {nx, ny, 0, d};
        expect_as_said(s);
        if (HasFailure()) FAIL() << nx << " " << ny << " " << d;
      }
}

// verifies: SK-CL-5, SK-CL-8, SK-CL-9, SK-CL-10, SK-CL-13
TEST_F(ClearanceGrid, EveryStateOfACell) {
  const sk_slice level_plane = block_slice(3, {10, 20, 10, 20, 0, 500});
  rules.now_us = 4;
  rules.dig_zone[0] = {0, 0, 300, 300, 0, 0};
  for (rules.margin_mm = 0; rules.margin_mm <= 1; ++rules.margin_mm)
    for (rules.fresh_us = 0; rules.fresh_us <= 5; ++rules.fresh_us)
      for (int seen = -1; seen <= 6; ++seen)
        for (int height = -3; height <= 2; ++height)
          for (int previous = -3; previous <= 2; ++previous)
            for (rules.dig_zones = 0; rules.dig_zones <= 1; ++rules.dig_zones)
              for (const int dig : {0, 1, 2})
                for (int floor = -1; floor <= 1; ++floor)
                  for (int ceiling = -2; ceiling <= 2; ++ceiling) {
                    rules.dig_allowed = dig > 0;
                    rules.dig_stale = dig > 1;
                    rules.dig_zone[0].floor_mm = floor;
                    rules.dig_zone[0].ceiling_mm = ceiling;
                    put(*map, 52, 52, {height, previous, 0, seen});
                    expect_as_said(level_plane);
                    if (HasFailure()) FAIL() << cell_of(*map, 52, 52) << "; fresh " << rules.fresh_us << " floor " << floor << " ceiling " << ceiling;
                  }
  for (int verdict = SK_CLEAR; verdict <= SK_BLOCKED_FLOOR; ++verdict) EXPECT_GT(verdicts[verdict], 1000) << verdict;
}

// Every height about every limit, with every kind of plane under the slice, in every state of the cell.
// verifies: SK-CL-15, SK-CL-16
TEST_F(ClearanceGrid, EveryHeightAboutTheOverpassLimit) {
  rules.now_us = 4;
  rules.margin_mm = 1;
  for (const int link : {0, 1, 2, 3})
    for (int plane = 0; plane <= 5; ++plane) {
      const sk_slice s = block_slice(link, {10, 20, 10, 20, 0, 500});
      choose(*choice, plane);
      for (const bool own : {false, true})
        for (const bool dig : {false, true})
          for (rules.fresh_us = 0; rules.fresh_us <= 2; ++rules.fresh_us)
            for (int seen = -1; seen <= 5; ++seen)
              for (int height = -4; height <= 2; ++height)
                for (int previous = -4; previous <= 2; ++previous)
                  for (int limit = -5; limit <= 3; ++limit) {
                    rules.own_body_radius_mm = own ? 500 : 0;
                    rules.dig_allowed = dig;
                    rules.dig_zones = 1;
                    rules.dig_zone[0] = {0, 0, 300, 300, -10, -2};
                    rules.pass_mm[52][52] = static_cast<std::int16_t>(limit);
                    put(*map, 52, 52, {height, previous, 0, seen});
                    expect_as_said(s);
                    if (HasFailure()) FAIL() << cell_of(*map, 52, 52) << "; fresh " << rules.fresh_us << " limit " << limit << " plane " << plane;
                  }
    }
  EXPECT_GT(verdicts[SK_BLOCKED_OVERPASS], 300);
  EXPECT_GT(verdicts[SK_CLEAR], 1000);
  EXPECT_GT(verdicts[SK_BLOCKED_COLLISION], 1000);
}

// verifies: SK-CL-7
TEST_F(ClearanceGrid, EveryCellAndOwnBody) {
  level(*map, 0);
  for (const int radius : {0, 1, 424, 425, 900, 2000, 3600, 15600, 22061, 22062, 32000})
    for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (int ix = 0; ix < SK_MAP_CELLS; ++ix)
        for (int link = 0; link <= 3; ++link)
          for (const int z : {300, 301}) {  // touching, not touching
            rules.own_body_radius_mm = radius;
            const double x = std::max(std::fabs(300.0 * ix - 15600.0), std::fabs(300.0 * ix - 15300.0));
            const double y = std::max(std::fabs(300.0 * iy - 15600.0), std::fabs(300.0 * iy - 15300.0));
            const bool own = std::hypot(x, y) <= radius;
            sk_slice s = point_slice(-15600 + 300 * ix + 10, -15600 + 300 * iy + 290, z);
            s.link = link;
            s.plane[0] = {0, 0, 1, z - 1};
            sk_clearance_result out{};
            sk_clear_slice(map.get(), &s, choice.get(), &rules, &out);
            const int said = own ? (link <= 1 ? SK_CLEAR : SK_BLOCKED_UNKNOWN) : (z == 301 ? SK_CLEAR : SK_BLOCKED_COLLISION);
            ASSERT_EQ(out.verdict, said) << radius << " " << iy << " " << ix << " link " << link;
            ASSERT_EQ(out.iy, said == SK_CLEAR ? -1 : iy);
            ASSERT_EQ(out.ix, said == SK_CLEAR ? -1 : ix);
          }
}

// verifies: SK-CL-2, SK-CL-3, SK-CL-13
TEST_F(ClearanceGrid, EveryRectangleAboutTheMapsCorners) {
  const int offsets[] = {-901, -900, -899, -601, -600, -599, -301, -300, -299, -150, -1, 0, 1};
  long inside = 0;
  for (const int corner : {-1, 1})
    for (const int x0 : offsets)
      for (const int x1 : offsets)
        for (const int y0 : offsets)
          for (const int y1 : offsets) {
            sk_slice s = point_slice(corner * (15600 + x0), corner * (15600 + y0), 1000);
            s.vertices = 2;
            s.xyz_mm[0][1] = corner * (15600 + x1);
            s.xyz_mm[1][1] = corner * (15600 + y1);
            s.xyz_mm[2][1] = 1000;
            s.plane[0] = {0, 0, 1, 999};
            const sk_clearance_result out = expect_as_said(s);
            const bool beyond = std::max({x0, x1, y0, y1}) >= 0;
            ASSERT_EQ(out.verdict, beyond ? SK_BLOCKED_UNKNOWN : SK_CLEAR) << x0 << " " << y0 << " " << x1 << " " << y1;
            inside += beyond ? 0 : 1;
          }
  EXPECT_EQ(inside, 2 * 11 * 11 * 11 * 11);
}

}  // namespace
}  // namespace berm::core_test
