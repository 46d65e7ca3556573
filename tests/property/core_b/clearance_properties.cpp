// Random slices over random maps: what the core calls clear is clear, and it judges as its header says. A failure prints its seed
// (RC_PARAMS="seed=..." repeats it).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <vector>

#include "clearance_scene.hpp"
#include "draw.hpp"
#include "exact_overlap.hpp"
#include "map_cells.hpp"

namespace berm::core_test {
namespace {

std::int64_t side(const sk_plane& p, const sk_slice& s, int i) {
  return std::int64_t{p.nx} * s.xyz_mm[0][i] + std::int64_t{p.ny} * s.xyz_mm[1][i] + std::int64_t{p.nz} * s.xyz_mm[2][i];
}

std::int64_t least_side(const sk_slice& s, const sk_plane& p) {
  std::int64_t least = side(p, s, 0);
  for (int i = 1; i < s.vertices; ++i) least = std::min(least, side(p, s, i));
  return least;
}

// Upright, slanted, or pointing down; with its offset just right, or too large by little.
sk_plane plane_for(const sk_slice& s) {
  const std::int32_t size = chance(50) ? 4 : 1'000'000;
  sk_plane p{draw(-size, size), draw(-size, size), 0, 0};
  if (chance(50)) p.nz = chance(90) ? draw(0, size) : -draw(0, size);
  p.d = least_side(s, p) - (chance(85) ? draw(1, 3) : draw(-2, 0));
  return p;
}

sk_slice random_slice() {
  sk_slice s{};
  s.link = draw(0, 3);
  s.vertices = draw(1, 9);
  const std::int32_t reach = chance(40) ? 3000 : chance(90) ? 12000 : 15600;
  const std::int32_t centre[3] = {draw(-reach, reach), draw(-reach, reach), draw(-2000, 4000)};
  const std::int32_t size = draw(0, 1500);
  for (int i = 0; i < s.vertices; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      s.xyz_mm[axis][i] = centre[axis] + draw(-size, size);
      if (chance(15)) s.xyz_mm[axis][i] = s.xyz_mm[axis][i] / 300 * 300;
    }
  s.plane[s.planes++] = {0, 0, 1, 0};
  s.plane[0].d = least_side(s, s.plane[0]) - 1;
  for (int more = draw(0, 14); more > 0; --more) s.plane[s.planes++] = plane_for(s);
  return s;
}

std::int32_t lowest(const sk_slice& s) {
  std::int32_t low = s.xyz_mm[2][0];
  for (int i = 1; i < s.vertices; ++i) low = std::min(low, s.xyz_mm[2][i]);
  return low;
}

sk_clearance_rules random_rules(const sk_slice& s) {
  sk_clearance_rules r = scene_rules();
  r.margin_mm = draw(0, 500);
  r.own_body_radius_mm = chance(50) ? 0 : draw(0, 4000);
  r.dig_allowed = chance(50);
  r.dig_stale = chance(30);
  r.dig_zones = draw(0, BERM_DIG_ZONES);
  for (int i = 0; i < r.dig_zones; ++i) {
    berm_dig_zone& z = r.dig_zone[i];
    const std::int32_t x = s.xyz_mm[0][0], y = s.xyz_mm[1][0];
    z = {x - draw(0, 3000), y - draw(0, 3000), x + draw(0, 3000), y + draw(0, 3000), lowest(s) + draw(-500, 100), lowest(s) + draw(-1000, 1500)};
    if (chance(50)) z = {z.x_low_mm / 300 * 300, z.y_low_mm / 300 * 300, z.x_high_mm / 300 * 300, z.y_high_mm / 300 * 300, z.floor_mm, z.ceiling_mm};
  }
  if (chance(50)) {
    const std::int32_t limit = lowest(s) - r.margin_mm + draw(-600, 300);
    for (auto& row : r.pass_mm)
      for (auto& each : row) each = static_cast<std::int16_t>(std::clamp(limit + draw(0, 400), -20000, 20000));
  }
  return r;
}

// Ground under, or at the height of, the slice; one cell in so many is higher, unknown, stale, or from the future.
void random_map(sk_height_map& map, const sk_slice& s, const sk_clearance_rules& r) {
  const std::int32_t ground = lowest(s) - r.margin_mm - (chance(70) ? 101 : draw(-600, 100));
  const std::uint32_t strange = static_cast<std::uint32_t>(chance(50) ? draw(3, 12) : draw(12, 1000));
  std::uint32_t random = draw<std::uint32_t>(0, 1u << 30);
  const auto next = [&random](std::uint32_t below) {
    random = random * 1664525u + 1013904223u;
    return static_cast<std::int32_t>((random >> 8) % below);
  };
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
      Cell cell{ground + next(101), ground + next(101), kSceneNow - next(kSceneFresh), kSceneNow - next(4) * (kSceneFresh / 3)};
      if (next(strange) == 0) {
        switch (next(5)) {
          case 0: cell.height_mm += next(3000); break;
          case 1: cell.previous_mm += next(3000); break;
          case 2: cell.seen_us = -1; break;
          case 3: cell.seen_us = kSceneNow - kSceneFresh - 1 - next(2) * 1000; break;
          default: cell.seen_us = kSceneNow + 1 + next(2) * 1000; break;
        }
      }
      put(map, iy, ix, cell);
    }
}

// Mostly a plane that separates, where there is one.
void choose_at_random(const sk_height_map& map, const sk_slice& s, const sk_clearance_rules& r, sk_choice& choice) {
  choose(choice, 0);
  sk_rectangle box{};
  if (!sk_slice_rectangle(&s, &box)) return;
  const int wrong = chance(20) ? draw(1, 100) : 0;
  for (int iy = box.iy_low; iy <= box.iy_high; ++iy)
    for (int ix = box.ix_low; ix <= box.ix_high; ++ix) {
      int plane = 0;
      while (plane < s.planes && !separates(map, s, r, plane, iy, ix)) ++plane;
      if (plane == s.planes) plane = draw(0, s.planes - 1);
      if (wrong > 0 && chance(wrong)) plane = draw(0, 255);
      choice.plane_of[iy][ix] = static_cast<std::uint8_t>(plane);
    }
}

// No point of a clear slice is in or over a column that it may not be over, own body under the boom and soil to dig excepted. Returns how many columns it is in.
int expect_apart(const sk_height_map& map, const sk_slice& s, const sk_clearance_rules& r) {
  std::vector<Vector> vertices;
  for (int i = 0; i < s.vertices; ++i) vertices.push_back({s.xyz_mm[0][i], s.xyz_mm[1][i], s.xyz_mm[2][i]});
  const ExactHull hull(vertices);
  int touched = 0;
  const auto [west, east] = std::minmax_element(vertices.begin(), vertices.end());
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
      Column c{low_of_cell_mm(ix), low_of_cell_mm(ix + 1), low_of_cell_mm(iy), low_of_cell_mm(iy + 1), 0};
      if (c.x_high < (*west)[0] || c.x_low > (*east)[0]) continue;
      const std::int32_t top = std::max(map.height_mm[iy][ix], map.previous_mm[iy][ix]);
      c.top = current(map, r, iy, ix) && top <= r.pass_mm[iy][ix] ? top + r.margin_mm : hull.highest() + 1;
      if (!hull.meets(c)) continue;
      ++touched;
      RC_ASSERT((own_body(r, iy, ix) && s.link <= 1) || may_be_dug(map, s, r, iy, ix));
    }
  for (const Vector& v : vertices) RC_ASSERT(std::abs(v[0]) < 15600 && std::abs(v[1]) < 15600);
  return touched;
}

struct Tally {
  std::array<long, 7> verdicts{};
  long touching = 0;
};

}  // namespace

// verifies: SK-CL-1, SK-CL-2, SK-CL-3, SK-CL-5, SK-CL-6, SK-CL-7, SK-CL-8, SK-CL-9, SK-CL-10, SK-CL-13, SK-CL-14, SK-CL-15, SK-CL-16
TEST(ClearanceProperties, WhatIsClearTouchesNothing) {
  const auto map = std::make_unique<sk_height_map>();
  const auto choice = std::make_unique<sk_choice>();
  Tally tally;
  EXPECT_TRUE(rc::check("clear means apart, and every verdict is that of the header", [&] {
    for (int i = 0; i < 50; ++i) {
      const sk_slice s = random_slice();
      const sk_clearance_rules r = random_rules(s);
      random_map(*map, s, r);
      choose_at_random(*map, s, r, *choice);
      sk_clearance_result out{-7, -7, -7, -7};
      sk_clear_slice(map.get(), &s, choice.get(), &r, &out);
      RC_ASSERT(same(out, judge(*map, s, *choice, r)));
      ++tally.verdicts.at(static_cast<std::size_t>(out.verdict));
      if (out.verdict == SK_CLEAR && expect_apart(*map, s, r) > 0) ++tally.touching;
    }
  }));
  std::cout << "clear " << tally.verdicts[SK_CLEAR] << " (of these touching soil to dig or the own body " << tally.touching << "), collision "
            << tally.verdicts[SK_BLOCKED_COLLISION] << ", unknown " << tally.verdicts[SK_BLOCKED_UNKNOWN] << ", stale "
            << tally.verdicts[SK_BLOCKED_STALE] << ", floor " << tally.verdicts[SK_BLOCKED_FLOOR] << ", overpass " << tally.verdicts[SK_BLOCKED_OVERPASS] << "\n";
  EXPECT_GT(tally.verdicts[SK_CLEAR], 500);
  EXPECT_GT(tally.touching, 30);
  for (const int verdict : {SK_BLOCKED_COLLISION, SK_BLOCKED_UNKNOWN, SK_BLOCKED_STALE, SK_BLOCKED_FLOOR, SK_BLOCKED_OVERPASS}) {
    EXPECT_GT(tally.verdicts[static_cast<std::size_t>(verdict)], 30) << verdict;
  }
}

}  // namespace berm::core_test
