// The order in which a face is dug: the planner's choices one after another, each dug by the forward model.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "app_bench/bench_machine.hpp"
#include "planning/dig_regions.hpp"
#include "planning/dig_shape.hpp"

namespace {

using namespace berm::app;

constexpr double width = 1.1;

// A fresh face that falls from this distance on all round the machine, so that no column is better than another.
DigGround fresh_face(const SiteModel& site, double crest) {
  TerrainMap map;
  for (double x = 0.0; x < 12.0; x += 0.05)
    for (double y = -8.0; y < 8.0; y += 0.05) map.insert(x, y, std::clamp(-1.5 * (std::hypot(x, y) - crest), -2.65, 0.0), 1.0);
  DigGround ground(site);
  ground.observe(map);
  return ground;
}

class DigOrder : public ::testing::Test {
protected:
  DigOrder() { needs.bucket_width = width; }
  void begin(double crest) {
    floor.emplace(machine, site);
    ground = fresh_face(site, crest);
  }
  RegionDig next() const { return next_dig(machine, site, *floor, *ground, needs, last); }
  // Until the bucket holds what is wanted, or the drag ends.
  void dig(const RegionDig& chosen) {
    const auto path = DigPath::solve(machine, chosen.plan.drag);
    ASSERT_TRUE(path);
    CutModel cut(machine, SurfaceProfile(*ground, chosen.plan.bearing, width), width);
    for (double s = 0.0; s < path->length() && cut.volume() < needs.volume; s += 0.06) cut.reach(path->at(s));
    lower_ground(*ground, chosen.plan.bearing, width, cut.surface());
    ground->settle();
    last = chosen.region;
  }
  bool yields(const DigRegion& region) const { return plan_dig(machine, site, *floor, *ground, needs, region.bounds).volume >= 0.75 * needs.volume; }
  // Whether a column of that bench, within the site's bearings, does.
  bool bench_yields(int bench) const {
    const auto regions = dig_regions(machine, site, *floor, needs);
    return std::any_of(regions.begin(), regions.end(), [&](const DigRegion& r) { return r.bench == bench && r.reach == RegionReach::site && yields(r); });
  }

  MachineModel machine = berm::app_bench::zx200();
  SiteModel site = berm::app_bench::bench();
  DigNeeds needs;
  std::optional<DigFloor> floor;
  std::optional<DigGround> ground;
  DigRegion last;
};

// stentz-1999, 4.2 and Figure 12, but for the neighbour of the last cut, into which soil slid: that is left for the next time. Without a price for depth all
// columns that fill the bucket cost the same.
TEST_F(DigOrder, WherePricesAreEqualIsFromLeftToRightPastTheLastCutsNeighbour) {
  needs.effort = 0.0;
  begin(6.0);
  std::vector<int> columns;
  for (int k = 0; k < 6; ++k) {
    const RegionDig chosen = next();
    ASSERT_GE(chosen.plan.volume, needs.volume);
    columns.push_back(chosen.region.column);
    dig(chosen);
    if (HasFatalFailure()) return;
  }
  EXPECT_EQ(columns, (std::vector{4, 6, 8, 4, 6, 8})) << "of the columns 4 to 8, from the left";
}

// By what digs cost the order is another one, but the columns beside the site's bearings, and drags that end nearer, come when these are dug out.
TEST_F(DigOrder, TheSitesColumnsAreAllDugBeforeThoseBesideThemAndDragsThatEndNearer) {
  begin(6.0);
  std::vector<int> digs(12, 0);
  RegionReach reach = RegionReach::site;
  for (int k = 0; k < 16; ++k) {
    const RegionDig chosen = next();
    EXPECT_TRUE(chosen.region.reach == RegionReach::site || !bench_yields(1)) << "dig " << k;
    EXPECT_GE(chosen.region.reach, reach) << "dig " << k;
    if (chosen.region.reach == RegionReach::site) {
      EXPECT_NE(chosen.region.column, last.column) << "dig " << k << ": where soil has just slid to";
      ++digs[static_cast<std::size_t>(chosen.region.column)];
    }
    reach = chosen.region.reach;
    dig(chosen);
    if (HasFatalFailure()) return;
  }
  EXPECT_EQ(reach, RegionReach::nearer);
  for (std::size_t column = 4; column <= 8; ++column) EXPECT_GE(digs[column], 1) << column;
}

// Top to bottom: a face of two benches, 1.325 m each. The lower one begins when no column of the upper one fills three quarters of a bucket, and then the upper is done.
TEST_F(DigOrder, TheUpperBenchIsDugOutBeforeTheLowerBegins) {
  site.bench_height = 1.5;
  begin(7.0);
  const double upper_floor = -2.65 / 2.0;
  std::vector<int> digs(3, 0);
  for (int k = 0; k < 60 && (k == 0 || last.reach == RegionReach::site); ++k) {
    const RegionDig chosen = next();
    ASSERT_TRUE(chosen.region.bench == 1 || chosen.region.bench == 2);
    if (chosen.region.bench == 1) {
      EXPECT_EQ(digs[2], 0) << "dig " << k << ": back up again";
      for (const DigWaypoint& w : chosen.plan.drag) EXPECT_GE(w.z, upper_floor - 1e-9);
    } else if (digs[2] == 0) {
      EXPECT_FALSE(bench_yields(1)) << "the upper bench is left with soil in it";
      EXPECT_EQ(chosen.left, 5);
    }
    if (chosen.region.reach == RegionReach::site) ++digs[static_cast<std::size_t>(chosen.region.bench)];
    dig(chosen);
    if (HasFatalFailure()) return;
  }
  EXPECT_NE(last.reach, RegionReach::site) << "the site's columns are never dug out";
  EXPECT_GE(digs[1], 6);
  EXPECT_GE(digs[2], 6);
  EXPECT_FALSE(bench_yields(2));
  // What is left stands no higher than the upper bench's floor and what a bucket needs.
  for (double bearing = site.dig_swing_right; bearing <= site.dig_swing_left; bearing += radians(6.0))
    for (double r = 6.2; r <= site.dig_radius_start; r += 0.1) EXPECT_LT(SurfaceProfile(*ground, bearing, width).at(r), upper_floor) << degrees(bearing) << " degrees, " << r << " m";
}

}  // namespace
