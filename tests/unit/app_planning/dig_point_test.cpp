#include <gtest/gtest.h>

#include <cmath>

#include "app_bench/bench_machine.hpp"
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

}  // namespace
