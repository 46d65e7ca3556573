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

// A face that is dug out from the toe to 6.9 m: what begins farther out goes through the air.
DigGround ground_dug_out_to(double from) {
  TerrainMap map;
  for (double x = 3.0; x < 12.0; x += 0.1)
    for (double y = -5.0; y < 5.0; y += 0.1) map.insert(x, y, x <= 6.0 ? 0.0 : x < from ? -1.5 * (x - 6.0) : -2.6, 1.0);
  DigGround ground(berm::app_bench::bench());
  ground.observe(map);
  return ground;
}

class DigSearch : public ::testing::Test {
protected:
  DigPlan plan(const DigGround& ground, double nearest, double farthest) const {
    return plan_dig(machine, site, DigFloor(machine, site), ground, needs, {0.0, -2.65, 5.6, nearest, farthest});
  }
  MachineModel machine = berm::app_bench::zx200();
  SiteModel site = berm::app_bench::bench();
  DigNeeds needs{0.8, 1.1, 1.0};
};

TEST_F(DigSearch, TheDragBeginsWhereItCostsLeastWithinTheBounds) {
  constexpr double tolerance = 0.05;  // s: a depth is found to a centimetre
  for (const double from : {6.7, 7.0, 7.6}) {
    const DigGround ground = ground_dug_out_to(from);
    const DigPlan best = plan(ground, 6.6, 7.4);
    EXPECT_GE(best.start_radius, 6.6 - 1e-9);
    EXPECT_LE(best.start_radius, 7.4 + 1e-9);
    EXPECT_DOUBLE_EQ(best.drag.front().r, best.start_radius);
    for (const double start : {7.4, 7.0, 6.6}) {
      const DigPlan only = plan(ground, start, start);
      EXPECT_DOUBLE_EQ(only.start_radius, start);
      EXPECT_GE(only.cost, best.cost - tolerance) << "from " << start << " m, dug out to " << from;
      EXPECT_LT(only.candidates, best.candidates);
    }
  }
  const DigGround ground = ground_dug_out_to(6.7);
  const double effort = needs.effort;
  needs.effort = 3.0 * effort;
  EXPECT_NEAR(plan(ground, 6.6, 7.4).start_radius, 7.4, 1e-9) << "a long cut is a shallow one";
  needs.effort = 0.1 * effort;
  EXPECT_LT(plan(ground, 6.6, 7.4).start_radius, 7.3) << "light soil: through the air to the face takes longer than a deeper cut";
}

TEST_F(DigSearch, TimeIsInThePrice) {
  const DigGround ground = ground_dug_out_to(6.7);
  const DigPlan far = plan(ground, 7.4, 7.4), near = plan(ground, 6.6, 6.6);
  ASSERT_GE(std::min(far.volume, near.volume), needs.volume - 1e-9);
  EXPECT_GT(far.seconds, near.seconds + 0.15) << "0.8 m of way";
  EXPECT_NEAR(far.cost - near.cost, far.seconds - near.seconds + (far.energy - near.energy) / 60e3, 1e-6);
}

TEST_F(DigSearch, TheBucketAttacksAsCostsLeast) {
  const DigGround ground = ground_of(seen_bench());
  const DigPlan best = plan(ground, 7.4, 7.4);
  const DigBounds bounds{0.0, -2.65, 5.6};
  const DigFloor floor(machine, site);
  const DigForwardModel model(machine, site, floor, ground, needs, bounds);
  std::vector<double> cheapest;
  for (const double attack : {-84.0, -92.0}) {
    double least = 1e9;
    for (double depth = 0.02; depth < 1.0; depth += 0.01)
      if (const auto dig = model.outcome({7.4, radians(attack), depth}); dig && dig->volume >= needs.volume)
        least = std::min(least, dig->seconds + needs.effort * dig->lifted / (needs.volume * 0.5) / 60e3);
    cheapest.push_back(least);
  }
  EXPECT_NEAR(best.cost, *std::min_element(cheapest.begin(), cheapest.end()), 0.08);
  EXPECT_GT(*std::max_element(cheapest.begin(), cheapest.end()), best.cost + 0.05) << "they cost the same: the test shows nothing";
}

TEST_F(DigSearch, ADragThatLeavesTheDigZoneOrComesToTheMachinesBodyIsNone) {
  const DigGround ground = ground_of(seen_bench());
  EXPECT_GE(plan(ground, 7.4, 7.4).volume, needs.volume);
  site.dig_zones[0].x_high = 7.0;
  EXPECT_EQ(plan(ground, 7.4, 7.4).volume, 0.0);
  EXPECT_FALSE(plan(ground, 7.4, 7.4).drag.empty());
  site.dig_zones[0].x_high = 10.5;
  machine.own_body_radius = 5.0;
  EXPECT_EQ(plan(ground, 7.4, 7.4).volume, 0.0);
}

}  // namespace
