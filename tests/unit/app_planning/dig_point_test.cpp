#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "app_bench/bench_machine.hpp"
#include "planning/dig_candidate.hpp"
#include "planning/dig_point.hpp"

namespace {

using namespace berm::app;

// The bench as a scanner over the cab sees it: the face beyond the crest stays hidden.
TerrainMap seen_bench(double crest = 6.0) {
  TerrainMap map;
  for (double x = 3.0; x < 12.0; x += 0.1)
    for (double y = -5.0; y < 5.0; y += 0.1) {
      if (x > crest && x < 9.1) continue;
      map.insert(x, y, x <= crest ? 0.0 : -2.2, 1.0);
    }
  return map;
}

DigGround ground_of(const TerrainMap& map) {
  DigGround ground(berm::app_bench::bench());
  ground.observe(map);
  return ground;
}

TEST(SurfaceProfile, AHiddenFaceFallsFromTheCrestToTheNextSeenGround) {
  const TerrainMap map = seen_bench();
  const SurfaceProfile surface(ground_of(map), 0.0, 1.1);
  EXPECT_NEAR(surface.at(5.5), 0.0, 1e-9);
  EXPECT_LT(surface.at(6.5), -0.4);
  EXPECT_GT(surface.at(6.5), -1.0);
  EXPECT_NEAR(surface.at(8.5), -2.2, 1e-9);
  for (double r = 6.0; r < 9.0; r += 0.1) EXPECT_LE(surface.at(r + 0.1), surface.at(r) + 1e-9);
}

TEST(CutModel, TakesWhatLiesAboveTheBucketOnce) {
  const MachineModel m = berm::app_bench::zx200();
  TerrainMap map;
  for (double x = 3.0; x < 12.0; x += 0.1)
    for (double y = -2.0; y < 2.0; y += 0.1) map.insert(x, y, 0.0, 1.0);
  CutModel model(m, SurfaceProfile(ground_of(map), 0.0, 1.1), 1.1);
  const auto above = inverse_tip(m, {7.0, 0.2}, radians(-90.0)), in = inverse_tip(m, {7.0, -0.5}, radians(-90.0));
  ASSERT_TRUE(above && in);
  EXPECT_EQ(model.reach(*above), 0.0);
  const double taken = model.reach(*in);
  EXPECT_GT(taken, 0.05);                      // the hanging bucket's lower edge over its width
  EXPECT_LT(taken, 0.5 * 1.3 * 1.1);           // at most its whole length
  EXPECT_NEAR(model.surface().at(7.0), -0.5, 0.06);
  EXPECT_EQ(model.reach(*in), 0.0);
  EXPECT_EQ(model.reach(*above), 0.0);
  EXPECT_EQ(model.volume(), taken);
}

TEST(CutModel, FillGrowsAlongAPath) {
  const MachineModel m = berm::app_bench::zx200();
  const SurfaceProfile surface(ground_of(seen_bench()), 0.0, 1.1);
  const DigPlan plan = plan_dig(m, berm::app_bench::bench(), DigFloor(m, berm::app_bench::bench()), ground_of(seen_bench()), {1.1, 1.1, 1.0}, {0.0, -2.65, 5.6});
  const auto path = DigPath::solve(m, plan.drag);
  ASSERT_TRUE(path);
  const std::vector<double> fill = fill_along(m, surface, 1.1, *path);
  EXPECT_EQ(fill.front(), 0.0) << "it begins over the ground";
  EXPECT_NEAR(fill.back(), plan.volume, 1e-9);
  for (std::size_t i = 1; i < fill.size(); ++i) EXPECT_GE(fill[i], fill[i - 1]);
}

TEST(DigPoint, CutsTheWantedVolumeAndStaysAboveTheFloor) {
  const SiteModel site = berm::app_bench::bench();
  const DigNeeds needs{1.1, 1.1, 1.0};
  const DigPlan plan = plan_dig(berm::app_bench::zx200(), site, DigFloor(berm::app_bench::zx200(), site), ground_of(seen_bench()), needs, {0.0, -2.4, 5.8});
  EXPECT_NEAR(plan.volume, 1.1, 0.06);
  EXPECT_GT(plan.depth, 0.2);
  EXPECT_LT(plan.depth, 1.0);
  for (const DigWaypoint& w : plan.drag) {
    EXPECT_GE(w.z, -2.4 - 1e-9);
    EXPECT_LE(w.r, site.dig_radius_start + 1e-9);
    EXPECT_GE(w.r, 5.8 - 0.11);
  }
  EXPECT_TRUE(DigPath::solve(berm::app_bench::zx200(), plan.drag));
}

TEST(DigPoint, CostsWhatItLacksAndItsEnergy) {
  const MachineModel machine = berm::app_bench::zx200();
  const SiteModel site = berm::app_bench::bench();
  const TerrainMap map = seen_bench();
  const DigNeeds needs{1.1, 1.1, 1.0};
  const auto cost = [&](const DigNeeds& n) { return plan_dig(machine, site, DigFloor(machine, site), ground_of(map), n, {0.0, -2.65, 5.6}).cost; };
  const double usual = cost(needs);
  DigNeeds hard = needs, more = needs;
  hard.effort = 2.0 * needs.effort;
  more.volume = 3.0;  // a metre deep it is not there
  EXPECT_GT(cost(hard), usual + 1.0);
  EXPECT_GT(cost(more), usual + 5.0);
}

class DigCandidates : public ::testing::Test {
protected:
  DigPlan plan(const DigGround& ground) const { return plan_dig(machine, site, DigFloor(machine, site), ground, needs, bounds); }
  MachineModel machine = berm::app_bench::zx200();
  SiteModel site = berm::app_bench::bench();
  DigNeeds needs{0.8, 1.1, 1.0};
  DigBounds bounds{0.0, -2.65, 5.6};
};

TEST_F(DigCandidates, TheShallowestThatFillsTheBucketIsTaken) {
  const DigGround ground = ground_of(seen_bench());
  const DigFloor floor(machine, site);
  const DigForwardModel model(machine, site, floor, ground, needs, bounds);
  const DigPlan best = plan(ground);
  EXPECT_GE(best.volume, needs.volume);
  EXPECT_LE(best.candidates, 9) << "of 128 depths";
  const auto shallower = model.outcome({site.dig_radius_start, radians(-92.0), best.depth - 0.01});
  ASSERT_TRUE(shallower);
  EXPECT_LT(shallower->volume, needs.volume);
}

// The dump is on the left.
TEST_F(DigCandidates, WorkAndTimeAreInThePrice) {
  const DigGround ground = ground_of(seen_bench());
  needs.dump_bearing = radians(90.0);
  needs.payload = 1500.0;
  const DigPlan dig = plan(ground);
  EXPECT_GT(dig.energy, 20e3);
  EXPECT_GT(dig.dig_seconds, 2.0);
  EXPECT_GT(dig.swing_seconds, 6.0) << "there and back";
  EXPECT_NEAR(dig.price(), dig.energy / 60e3 + dig.dig_seconds + dig.swing_seconds, 1e-9);
  bounds.bearing = radians(9.0);
  const DigPlan nearer_to_dump = plan(ground);
  EXPECT_LT(nearer_to_dump.swing_seconds, dig.swing_seconds - 0.1);
}

// Half a metre deep a dig takes what the digs before took.
TEST_F(DigCandidates, TheWorkGoesWithTheDepthAndWithWhatTheDigsBeforeTook) {
  const DigGround ground = ground_of(seen_bench());
  const DigPlan dig = plan(ground);
  EXPECT_NEAR(dig.energy, needs.effort * dig.depth / 0.5, 1e-6);
  needs.effort *= 2.0;
  EXPECT_NEAR(plan(ground).energy, 2.0 * dig.energy, 1e-6);
}

TEST_F(DigCandidates, ADragThatLeavesTheDigZoneOrComesToTheMachinesBodyIsNone) {
  const DigGround ground = ground_of(seen_bench());
  EXPECT_GE(plan(ground).volume, needs.volume);
  site.dig_zones[0].x_high = 7.0;
  EXPECT_EQ(plan(ground).volume, 0.0);
  EXPECT_FALSE(plan(ground).drag.empty());
  site.dig_zones[0].x_high = 10.5;
  machine.own_body_radius = 5.0;
  EXPECT_EQ(plan(ground).volume, 0.0);
}

// A wall of soil between machine and face, up to where the stick comes.
TEST_F(DigCandidates, AStickThatWouldComeIntoTheCrestIsNoDig) {
  const auto with_wall = [](double top) {
    TerrainMap map;
    for (double x = 3.0; x < 12.0; x += 0.1)
      for (double y = -5.0; y < 5.0; y += 0.1) map.insert(x, y, x < 5.3 ? top : x < 6.0 ? 0.0 : std::max(-2.2, -1.5 * (x - 6.0)), 1.0);
    return ground_of(map);
  };
  EXPECT_GE(plan(with_wall(0.0)).volume, needs.volume);
  EXPECT_EQ(plan(with_wall(4.0)).volume, 0.0);
}

}  // namespace
