// Counts every allocation of the process, GMP's included: malloc itself is replaced.
#include <gtest/gtest.h>

#include <iostream>
#include <memory>

#include "counted_malloc.hpp"
#include "geometry/joint_history.hpp"
#include "geometry/scan_projection.hpp"
#include "geometry/self_filter.hpp"
#include "geometry/separation.hpp"
#include "geometry/swept_slices.hpp"
#include "machine_profile.hpp"
#include "pass_over.hpp"

namespace berm::kernel::test {
namespace {

constexpr uint64_t seed = 404;
constexpr int64_t now_us = 100000000;

void patchwork(sk_height_map& map, std::mt19937_64& random) {
  sk_map_clear(&map);
  for (int32_t iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int32_t ix = 0; ix < SK_MAP_CELLS; ++ix)
      if (random() % 12 != 0) sk_map_insert(&map, iy, ix, static_cast<int32_t>(uniform(random, -2000, random() % 20 == 0 ? 4000 : 0)), now_us - 1000, 1000000);
}

} // namespace

// verifies: SK-GE-15
TEST(NoAllocation, InACycle) {
  if (!BERM_COUNTS_MALLOC) GTEST_SKIP() << "SKIPPED: malloc is the sanitizer's";
  const long probe = allocations;
  delete new std::vector<int>(100);
  ASSERT_GT(allocations, probe) << "the counter does not count";

  std::mt19937_64 random(seed);
  const auto set = std::make_unique<SliceSet>();
  const auto map = std::make_unique<sk_height_map>();
  const auto choice = std::make_unique<sk_choice>();
  const auto columns = std::make_unique<sk_columns>();
  for (const Machine& machine : machine_profiles()) {
    const SelfFilter filter(machine.parameters);
    const ScanProjection projection(machine.parameters);
    JointHistory history;
    sk_clearance_rules rules{};
    rules.now_us = now_us;
    rules.fresh_us = 20000000;
    rules.margin_mm = 300;
    berm::test::pass_over(rules);
    rules.own_body_radius_mm = machine.parameters.own_body_radius_mm;
    berm_scan_packet packet{};
    packet.samples_per_revolution = 400;
    packet.count = 100;
    long slices = 0, searched = 0;
    const long before = allocations;
    for (int i = 0; i < 400; ++i) {
      if (i % 20 == 0) patchwork(*map, random);
      if (!build_slices(machine.parameters, random_box(machine.parameters, random), *set)) continue;
      slices += set->count;
      if (!sk_columns_of(map.get(), &rules, columns.get())) continue;
      for (int s = 0; s < set->count; ++s) searched += choose_planes(*map, *columns, rules, *set, s, *choice) ? 1 : 0;
      int32_t angle_urad[4] = {i, i, i, i};
      history.push(1000 * i, angle_urad);
      const JointAngles q = history.at(1000 * i - 500).angles;
      Eigen::Vector3d point;
      sk_point base{};
      if (projection.in_upper_body(packet, i % 100, 5000, point) && !filter.is_own(point, q)) ScanProjection::in_base(point, q.swing, base);
    }
    EXPECT_EQ(allocations, before) << "seed " << seed;
    std::cout << machine.name << ": seed " << seed << ", " << slices << " slices built and searched (" << searched << " separated), " << allocations - before << " allocations\n";
    EXPECT_GT(slices, 1000);
    EXPECT_GT(searched, 100);
  }
}

// Columns that touch the plane exactly: where a filtered predicate would fall back to exact arithmetic, and allocate.
// verifies: SK-GE-15
TEST(NoAllocation, InDegenerateTests) {
  if (!BERM_COUNTS_MALLOC) GTEST_SKIP() << "SKIPPED: malloc is the sanitizer's";
  const auto set = std::make_unique<SliceSet>();
  const auto map = std::make_unique<sk_height_map>();
  const auto choice = std::make_unique<sk_choice>();
  const auto columns = std::make_unique<sk_columns>();
  std::mt19937_64 random(seed + 1);
  const Machine machine = machine_profiles().front();
  sk_clearance_rules rules{};
  rules.now_us = now_us;
  rules.fresh_us = 20000000;
  berm::test::pass_over(rules);
  long touched = 0;
  const long before = allocations;
  for (int i = 0; i < 60; ++i) {
    if (!build_slices(machine.parameters, random_box(machine.parameters, random), *set)) continue;
    for (int s = 0; s < set->count; ++s) {
      sk_rectangle r{};
      sk_slice& slice = set->slice[s];
      if (!sk_slice_rectangle(&slice, &r)) continue;
      PlaneCandidates candidates;
      plane_candidates_of(*set, s, candidates);
      sk_map_clear(map.get());
      for (int32_t iy = r.iy_low; iy <= r.iy_high; ++iy)
        for (int32_t ix = r.ix_low; ix <= r.ix_high; ++ix) {
          // the height at which the cell's farthest corner meets slanted plane k, to the millimetre above it
          const int k = upright_candidates + (ix + iy) % (candidates.count - upright_candidates);
          const sk_plane p{candidates.nx[k], candidates.ny[k], candidates.nz[k], plane_offset(slice, candidates.nx[k], candidates.ny[k], candidates.nz[k])};
          const int64_t x = SK_MAP_ORIGIN_MM + ix * SK_CELL_MM + (p.nx > 0 ? SK_CELL_MM : 0), y = SK_MAP_ORIGIN_MM + iy * SK_CELL_MM + (p.ny > 0 ? SK_CELL_MM : 0);
          const int64_t height = (p.d + 1 - p.nx * x - p.ny * y) / p.nz;
          sk_map_insert(map.get(), iy, ix, static_cast<int32_t>(std::clamp<int64_t>(height, -SK_HEIGHT_MAX_MM, SK_HEIGHT_MAX_MM)), now_us - 1000, 1000000);
          touched += p.nx * x + p.ny * y + p.nz * height == p.d + 1 ? 1 : 0;
        }
      if (sk_columns_of(map.get(), &rules, columns.get())) choose_planes(*map, *columns, rules, *set, s, *choice);
    }
  }
  // upright sides that pass through the corners of cells: a block on the grid
  sk_slice block{};
  block.link = 2;
  block.vertices = 8;
  for (int i = 0; i < 8; ++i) {
    block.xyz_mm[0][i] = i & 1 ? 6000 : 4800;
    block.xyz_mm[1][i] = i & 2 ? 900 : -900;
    block.xyz_mm[2][i] = i & 4 ? 2000 : 1000;
  }
  block.planes = 5;
  block.plane[0] = {0, 0, 1, 999};
  block.plane[1] = {16384, 0, 0, 16384 * 4800 - 1};
  block.plane[2] = {-16384, 0, 0, -16384 * 6000 - 1};
  block.plane[3] = {0, 16384, 0, -16384 * 900 - 1};
  block.plane[4] = {0, -16384, 0, -16384 * 900 - 1};
  sk_map_clear(map.get());
  const PlaneCandidates none{};
  ASSERT_TRUE(sk_columns_of(map.get(), &rules, columns.get()));
  EXPECT_FALSE(choose_planes(*map, *columns, rules, none, block, *choice)); // every cell touches, none is known
  EXPECT_EQ(allocations, before) << "seed " << seed + 1;
  EXPECT_GT(touched, 0);
}

} // namespace berm::kernel::test
