#include "planning/dig_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app_bench/bench_machine.hpp"
#include "planning/dig_point.hpp"

namespace {

using namespace berm::app;

constexpr double width = 1.1;

DigGround bench() {
  TerrainMap map;
  for (double x = 3.0; x < 12.0; x += 0.1)
    for (double y = -5.0; y < 5.0; y += 0.1)
      if (x <= 6.0 || x >= 7.6) map.insert(x, y, x <= 6.0 ? 0.0 : -2.2, 1.0);
  DigGround ground(berm::app_bench::bench());
  ground.observe(map);
  return ground;
}

struct Drag {
  DigPlan plan;
  std::optional<DigPath> path;
};

Drag drag_through(const DigGround& ground) {
  const DigFloor floor(berm::app_bench::zx200(), berm::app_bench::bench());
  Drag drag{plan_dig(berm::app_bench::zx200(), berm::app_bench::bench(), floor, ground, {1.1, width, 1.0}, {0.0, -2.65, 5.6}), std::nullopt};
  drag.path = DigPath::solve(berm::app_bench::zx200(), drag.plan.drag);
  return drag;
}

double height_of(const DigShape& shape, double r) {
  const auto at = std::min_element(shape.begin(), shape.end(), [&](const auto& a, const auto& b) { return std::fabs(a[0] - r) < std::fabs(b[0] - r); });
  return (*at)[1];
}

TEST(DigShape, BeginsWhereTheDragDoesAndEndsWhereTheGroundIsAsItWas) {
  const DigGround ground = bench();
  const Drag drag = drag_through(ground);
  ASSERT_TRUE(drag.path);
  const DigShape shape = shape_after(berm::app_bench::zx200(), ground, 0.0, width, *drag.path, drag.plan.volume, 7.4);
  const SurfaceProfile before(ground, 0.0, width);
  ASSERT_GT(shape.size(), 5u);
  EXPECT_NEAR(shape.front()[0], 7.4, 1e-9);
  EXPECT_NEAR(shape.back()[1], before.at(shape.back()[0]), 0.1);
  EXPECT_LT(height_of(shape, 6.5), before.at(6.5) - 0.2);
}

TEST(DigShape, ADragThatIsFullSoonerLeavesTheRest) {
  const DigGround ground = bench();
  const Drag drag = drag_through(ground);
  ASSERT_TRUE(drag.path);
  const DigShape whole = shape_after(berm::app_bench::zx200(), ground, 0.0, width, *drag.path, 10.0, 7.4);
  const DigShape half = shape_after(berm::app_bench::zx200(), ground, 0.0, width, *drag.path, 0.5 * drag.plan.volume, 7.4);
  EXPECT_GT(half.back()[0], whole.back()[0] + 0.15) << "less of the face comes down";
}

TEST(LowerGround, IsLoweredOverTheBucketsWidthOnly) {
  DigGround ground = bench();
  SurfaceProfile cut(ground, 0.0, width);
  for (double& z : cut.heights()) z = std::min(z, -1.0);
  lower_ground(ground, 0.0, width, cut);
  EXPECT_EQ(ground.height(5.5, 0.05), -1.0);
  EXPECT_EQ(ground.height(5.5, 1.05), 0.0);
  EXPECT_EQ(ground.height(8.5, 0.05), -2.2) << "it is lower already";
}

TEST(WayOut, EndsCurledAboveTheGroundAndGoesNoDeeperThanItBegan) {
  const MachineModel machine = berm::app_bench::zx200();
  const SurfaceProfile surface(bench(), 0.0, width);
  const auto from = inverse_tip(machine, {6.4, -1.6}, radians(-120.0));
  ASSERT_TRUE(from);
  const std::vector<DigWaypoint> way = way_out(machine, surface, forward(machine, *from));
  ASSERT_GE(way.size(), 3u);
  for (std::size_t i = 1; i < way.size(); ++i) EXPECT_GE(way[i].z, way[i - 1].z - 1e-9);
  EXPECT_LE(way.back().attitude, radians(-173.0));
  EXPECT_GT(way.back().z, surface.at(way.back().r) + 0.5);
  EXPECT_TRUE(DigPath::solve(machine, way));
}

TEST(DigShape, TheBankStandsAsHighAsWhatLiesNearerThanTheTip) {
  const DigGround ground = bench();
  const SurfaceProfile surface(ground, 0.0, width);
  ArmPoints now;
  now.tip = {6.3, -1.9};
  EXPECT_NEAR(bank_over(surface, now), 1.9, 0.05) << "the bench's level is 0";
  now.tip = {8.6, -2.4};
  EXPECT_NEAR(bank_over(surface, now), 0.2, 0.1) << "the lower ground lies at -2.2";
}

}  // namespace
