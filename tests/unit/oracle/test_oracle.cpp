#include "plant/oracle/oracle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "bench.hpp"

namespace berm::plant::oracle {
namespace {

using bench::degree;

struct FlatGround {
  explicit FlatGround(double z) : height(200 * 200, z) {}
  [[nodiscard]] Ground view() const { return {-10, -10, 0.1, 200, 200, height.data()}; }
  std::vector<double> height;
};

double lowest_corner(const std::vector<Body>& bodies, size_t count) {
  double z = 1e9;
  for (size_t i = 0; i < count; ++i) {
    for (const Point& p : bodies[i].corner) z = std::min(z, p.z());
  }
  return z;
}

TEST(Oracle, KinematicsPutsTheTipWhereItIsAskedFor) {
  const ImplementShape s = bench::machine();
  const Oracle oracle(s);
  for (const double swing : {0.0, 0.7, -1.3}) {
    const std::vector<Body> own = oracle.machine(bench::reach(s, swing, 7.2, -0.4, -120 * degree).angle);
    ASSERT_EQ(own.size(), 5u);
    double nearest = 1e9;
    for (const Point& p : own[3].corner) {
      nearest = std::min(nearest, (p - Point(7.2 * std::cos(swing) + 0.563 * std::sin(swing), 7.2 * std::sin(swing) - 0.563 * std::cos(swing), -0.4)).norm());
    }
    EXPECT_NEAR(nearest, 0, 1e-9) << "the bucket's tip corner";
  }
}

TEST(Oracle, GapOverFlatGroundIsTheLowestCorner) {
  const ImplementShape s = bench::machine();
  const Oracle oracle(s);
  const FlatGround ground(0.0);
  Site site;
  site.ground = ground.view();
  for (const double swing : {0.0, 0.4, 2.0}) {
    for (const double z : {0.6, 0.3, 0.01, -0.2}) {
      const std::array<double, 4> q = bench::reach(s, swing, 6.5, z, -110 * degree).angle;
      const Judgement j = oracle.judge(q, site);
      const double expected = lowest_corner(oracle.machine(q), 4);
      EXPECT_NEAR(j.ground_gap, expected, 1e-9);
      EXPECT_EQ(j.contact, expected <= 0);
      EXPECT_EQ(j.closest, 1e9);
    }
  }
}

TEST(Oracle, DigZoneExceptsItsColumnsAboveItsFloor) {
  const ImplementShape s = bench::machine();
  const Oracle oracle(s);
  const FlatGround ground(0.0);
  Site site;
  site.ground = ground.view();
  site.zones = {{4, -4, 10, 4, -1.0}};
  EXPECT_FALSE(oracle.judge(bench::reach(s, 0, 7, -0.5, -110 * degree).angle, site).contact);
  const Judgement deep = oracle.judge(bench::reach(s, 0, 7, -1.1, -110 * degree).angle, site);
  EXPECT_TRUE(deep.contact);
  EXPECT_EQ(deep.what, "floor of the dig zone");
  EXPECT_NEAR(deep.ground_gap, -0.1, 1e-9);
  // Half the bucket's width over the zone's edge.
  const Judgement edge = oracle.judge(bench::reach(s, std::atan2(4.0, 6.0), std::hypot(6, 4), -0.2, -110 * degree).angle, site);
  EXPECT_TRUE(edge.contact);
  EXPECT_EQ(edge.what, "ground outside the dig zone");
}

TEST(Oracle, OneHighColumnUnderTheBoomIsFound) {
  const ImplementShape s = bench::machine();
  const Oracle oracle(s);
  FlatGround ground(-5.0);
  const std::array<double, 4> q = bench::reach(s, 0, 6.5, 1.0, -110 * degree).angle;
  ground.height[100 * 200 + 125] = 10;  // at x = 2.55, y = 0.05
  Site site;
  site.ground = ground.view();
  EXPECT_TRUE(oracle.judge(q, site).contact);
  ground.height[100 * 200 + 125] = -5;
  ground.height[103 * 200 + 125] = 10;  // y = 0.35: beside the boom
  EXPECT_FALSE(oracle.judge(q, site).contact);
}

TEST(Oracle, NamesTheNearestAndTheTouched) {
  const ImplementShape s = bench::machine();
  const Oracle oracle(s);
  Site site;
  site.people = {{"near", 8.0, 0, 0, 0.25, 1.8}, {"far", 0, -8, 0, 0.25, 1.8}};
  const std::array<double, 4> q = bench::reach(s, 0, 5.5, 2.5, -180 * degree).angle;
  const Judgement j = oracle.judge(q, site);
  EXPECT_FALSE(j.contact);
  EXPECT_EQ(j.what, "near");
  site.blocks = {{"block", 6.5, 0, 0, 0.3, {-0.5, -0.5, 0}, {0.5, 0.5, 2.6}}};
  const Judgement hit = oracle.judge(q, site);
  EXPECT_TRUE(hit.contact);
  EXPECT_EQ(hit.what, "block");
  EXPECT_EQ(hit.closest, 0);
}

TEST(Oracle, UpperBodyTurnsWithTheSwing) {
  const ImplementShape s = bench::machine();
  const Oracle oracle(s);
  Site site;
  site.people = {{"behind", -2.4, -1.6, 0, 0.25, 1.8}};
  std::array<double, 4> q = bench::reach(s, 0, 6, 2, -170 * degree).angle;
  EXPECT_NEAR(oracle.judge(q, site).closest, 0.05, 1e-6);
  q[0] = 0.1;
  EXPECT_TRUE(oracle.judge(q, site).contact);
  q[0] = -0.3;
  EXPECT_GT(oracle.judge(q, site).closest, 0.3);
}

}  // namespace
}  // namespace berm::plant::oracle
