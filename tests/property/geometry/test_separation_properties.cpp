// The search for separating planes against random maps: what it claims holds, what it leaves out had to be left out, and the core agrees.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "exact_hull.hpp"
#include "geometry/separation.hpp"
#include "geometry/swept_slices.hpp"
#include "machine_profile.hpp"
#include "pass_over.hpp"

namespace berm::kernel::test {
namespace {

constexpr uint64_t seed = 4242;
constexpr int64_t now_us = 100000000;
constexpr int32_t fresh_us = 20000000;

// Rolling ground with walls, pits, cells never seen and cells seen too long ago.
void random_map(sk_height_map& map, std::mt19937_64& random) {
  sk_map_clear(&map);
  const double slope_x = uniform(random, -0.15, 0.15), slope_y = uniform(random, -0.15, 0.15), base = uniform(random, -2500, 500);
  const uint64_t strange = 4 + random() % 60; // one cell in so many
  for (int32_t iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int32_t ix = 0; ix < SK_MAP_CELLS; ++ix) {
      const double x = SK_MAP_ORIGIN_MM + ix * SK_CELL_MM, y = SK_MAP_ORIGIN_MM + iy * SK_CELL_MM;
      double z = base + slope_x * x + slope_y * y + uniform(random, 0, 200);
      int64_t seen = now_us - 1000000;
      if (random() % strange == 0) {
        const uint64_t kind = random() % 3;
        if (kind == 0) continue;
        if (kind == 1) seen = now_us - fresh_us - 1;
        if (kind == 2) z += uniform(random, 0, 6000);
      }
      ASSERT_TRUE(sk_map_insert(&map, iy, ix, static_cast<int32_t>(z), seen, 1000000));
    }
}

struct Cell {
  int32_t iy, ix, x, y;
  bool topped, own;
  int64_t top;
};

Cell cell_at(const sk_height_map& map, const sk_clearance_rules& rules, int32_t iy, int32_t ix) {
  Cell c{iy, ix, SK_MAP_ORIGIN_MM + ix * SK_CELL_MM, SK_MAP_ORIGIN_MM + iy * SK_CELL_MM, false, true, 0};
  c.topped = map.seen_us[iy][ix] >= rules.now_us - rules.fresh_us && map.seen_us[iy][ix] >= 0;
  c.top = std::max(map.height_mm[iy][ix], map.previous_mm[iy][ix]) + rules.margin_mm;
  for (int corner = 0; corner < 4; ++corner)
    c.own = c.own && std::hypot(c.x + (corner & 1) * SK_CELL_MM, c.y + (corner >> 1) * SK_CELL_MM) <= rules.own_body_radius_mm;
  return c;
}

bool separates(const sk_slice& slice, const sk_plane& p, const Cell& c) {
  if (p.nz < 0 || (p.nz != 0 && !c.topped)) return false;
  for (int i = 0; i < slice.vertices; ++i)
    if (int64_t{p.nx} * slice.xyz_mm[0][i] + int64_t{p.ny} * slice.xyz_mm[1][i] + int64_t{p.nz} * slice.xyz_mm[2][i] <= p.d) return false;
  for (int corner = 0; corner < 4; ++corner) {
    const int64_t x = c.x + (corner & 1) * SK_CELL_MM, y = c.y + (corner >> 1) * SK_CELL_MM;
    if (p.nx * x + p.ny * y + p.nz * (c.topped ? c.top : 0) > p.d) return false;
  }
  return true;
}

// Least distance between a slice and a column that goes down without end, by Gilbert's iteration on the difference body: an upper bound
// that converges; used to call a pair clearly apart.
double gap_mm(const sk_slice& slice, const Cell& c) {
  double v[3];
  const auto difference = [&](const double n[3], double out[3]) { // vertex of slice minus column that is least along n
    int best = 0;
    double least = 1e300;
    for (int i = 0; i < slice.vertices; ++i) {
      const double d = n[0] * slice.xyz_mm[0][i] + n[1] * slice.xyz_mm[1][i] + n[2] * slice.xyz_mm[2][i];
      if (d < least) { least = d; best = i; }
    }
    out[0] = slice.xyz_mm[0][best] - (c.x + (n[0] > 0 ? SK_CELL_MM : 0));
    out[1] = slice.xyz_mm[1][best] - (c.y + (n[1] > 0 ? SK_CELL_MM : 0));
    out[2] = slice.xyz_mm[2][best] - (n[2] > 0 ? static_cast<double>(c.top) : -40000.0);
  };
  const double start[3] = {0.0, 0.0, 1.0};
  difference(start, v);
  double bound = 0.0; // certified: n . (slice - column) >= bound for the unit vector n = v / |v|
  for (int i = 0; i < 2000; ++i) {
    double w[3];
    difference(v, w);
    const double vv = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    if (vv < 1.0) return 0.0;
    const double vw = v[0] * w[0] + v[1] * w[1] + v[2] * w[2];
    bound = std::max(bound, vw / std::sqrt(vv));
    const double d[3] = {w[0] - v[0], w[1] - v[1], w[2] - v[2]};
    const double dd = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if (dd < 1e-9 || vv - vw < 1e-6 * vv) break;
    const double t = std::clamp((vv - vw) / dd, 0.0, 1.0);
    for (int k = 0; k < 3; ++k) v[k] += t * d[k];
  }
  return bound;
}

// Whether the footprints (convex hull of the vertices seen from above, and the square) are apart by more than 2 mm, along the normal of any
// pair of vertices. (The normals of the square separate no cell of the bounding rectangle by as much.)
bool footprints_apart(const sk_slice& slice, const Cell& c) {
  const auto apart = [&](double nx, double ny) {
    const double length = std::hypot(nx, ny);
    if (length == 0.0) return false;
    double least = 1e300;
    for (int i = 0; i < slice.vertices; ++i) least = std::min(least, (nx * slice.xyz_mm[0][i] + ny * slice.xyz_mm[1][i]) / length);
    const double most = (nx * (c.x + (nx > 0 ? SK_CELL_MM : 0)) + ny * (c.y + (ny > 0 ? SK_CELL_MM : 0))) / length;
    return least > most + 2.0;
  };
  for (int i = 0; i < slice.vertices; ++i)
    for (int j = 0; j < slice.vertices; ++j)
      if (apart(slice.xyz_mm[1][j] - slice.xyz_mm[1][i], slice.xyz_mm[0][i] - slice.xyz_mm[0][j])) return true;
  return false;
}

struct Tally {
  long slices = 0, separated = 0, cells = 0, slanted = 0, upright = 0, unseparated = 0, needless = 0, own_blocked = 0;
};

void check_slice(const sk_height_map& map, const sk_columns& columns, SliceSet& set, int s, const sk_clearance_rules& rules, sk_choice& choice, Tally& tally) {
  const sk_slice& slice = set.slice[s];
  sk_rectangle r{};
  if (!sk_slice_rectangle(&slice, &r)) return;
  const bool all = choose_planes(map, columns, rules, set, s, choice);
  ++tally.slices;
  tally.separated += all ? 1 : 0;
  bool ended = false, own_blocked = false;
  for (int32_t iy = r.iy_low; iy <= r.iy_high; ++iy)
    for (int32_t ix = r.ix_low; ix <= r.ix_high; ++ix) {
      const Cell c = cell_at(map, rules, iy, ix);
      const int plane = choice.plane_of[iy][ix];
      ASSERT_LT(plane, slice.planes);
      if (ended) {
        ASSERT_EQ(plane, 0) << "after the end of the search";
        continue;
      }
      ++tally.cells;
      if (c.own) {
        own_blocked = own_blocked || slice.link != 1;
        if (slice.link == 1) continue;
      }
      if (c.own && plane == 0) { // an upright plane is looked for; the core blocks whatever is found
        ended = !all;
        continue;
      }
      if (separates(slice, slice.plane[plane], c)) {
        tally.upright += plane > 0 && slice.plane[plane].nz == 0 ? 1 : 0;
        tally.slanted += plane > 0 && slice.plane[plane].nz != 0 ? 1 : 0;
        continue;
      }
      ASSERT_EQ(plane, 0) << "a plane that does not separate was chosen";
      ASSERT_FALSE(all) << "every cell was claimed to be separated";
      ASSERT_FALSE(footprints_apart(slice, c)) << "an upright plane was there to be found";
      ++tally.unseparated;
      if (c.topped && gap_mm(slice, c) > 1.0) ++tally.needless;
      ended = true;
    }
  ASSERT_EQ(ended, !all);
  tally.own_blocked += all && own_blocked ? 1 : 0;
  sk_clearance_result result{};
  sk_clear_slice(&map, &slice, &choice, &rules, &result);
  ASSERT_NE(result.verdict, SK_BLOCKED_INVALID);
  ASSERT_EQ(result.verdict == SK_CLEAR, all && !own_blocked) << "the core judges otherwise, verdict " << result.verdict;
}

} // namespace

// verifies: SK-GE-10
// verifies: SK-GE-11
// verifies: SK-GE-12
TEST(Separation, ClaimsOnlyWhatHoldsAndFindsWhatIsThere) {
  std::mt19937_64 random(seed);
  const auto set = std::make_unique<SliceSet>();
  const auto map = std::make_unique<sk_height_map>();
  const auto choice = std::make_unique<sk_choice>();
  const auto columns = std::make_unique<sk_columns>();
  sk_clearance_rules rules{};
  rules.now_us = now_us;
  rules.fresh_us = fresh_us;
  rules.margin_mm = 300;
  berm::test::pass_over(rules);
  for (const Machine& machine : machine_profiles()) {
    rules.own_body_radius_mm = machine.parameters.own_body_radius_mm;
    Tally tally;
    for (int scene = 0; scene < 60; ++scene) {
      random_map(*map, random);
      ASSERT_TRUE(sk_columns_of(map.get(), &rules, columns.get()));
      for (int pose = 0; pose < 5; ++pose) {
        if (!build_slices(machine.parameters, random_box(machine.parameters, random), *set)) continue;
        for (int s = 0; s < set->count; ++s) {
          check_slice(*map, *columns, *set, s, rules, *choice, tally);
          if (HasFatalFailure()) FAIL() << "seed " << seed << " scene " << scene << " pose " << pose << " slice " << s;
        }
      }
    }
    std::cout << machine.name << ": seed " << seed << ", " << tally.slices << " slices, " << tally.separated << " separated; " << tally.cells << " cells, by upright planes "
              << tally.upright << ", by slanted " << tally.slanted << ", ended by a cell without plane " << tally.unseparated << ", of these apart by more than 1 mm "
              << tally.needless << "; blocked over the own body only " << tally.own_blocked << "\n";
    EXPECT_GT(tally.separated, 1000);
    EXPECT_GT(tally.unseparated, 1000);
    EXPECT_GT(tally.slanted, 100);
    EXPECT_GT(tally.upright, 100);
    EXPECT_LT(static_cast<double>(tally.needless), 0.2 * static_cast<double>(tally.unseparated));
  }
}

} // namespace berm::kernel::test
