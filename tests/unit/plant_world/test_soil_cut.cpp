#include <gtest/gtest.h>

#include "bench.hpp"
#include "plant/world/soil_cut.hpp"

namespace berm::plant {
namespace {

using bench::degree;

// A level site, so that what is cut can be reckoned.
class SoilCutTest : public ::testing::Test {
 protected:
  SoilCutTest() : terrain(flat(), {}, 1), load(shape, {}), cut(shape, {}), landing(terrain, trucks, zones) {}
  static TerrainConfig flat() {
    TerrainConfig c;
    c.crest_x = c.crest_y = 100;
    c.toe_x = c.toe_y = 101;
    return c;
  }
  // Tip from one place of the swing plane to another; returns the loose volume cut. Nothing settles.
  double drag(double r1, double z1, double r2, double z2, double elevation1, double elevation2, int steps) {
    double total = 0;
    BucketPose before = cut.pose(link_frames(shape, bench::reach(shape, swing, r1, z1, elevation1)));
    for (int i = 1; i <= steps; ++i) {
      const double f = static_cast<double>(i) / steps;
      const BucketPose now =
          cut.pose(link_frames(shape, bench::reach(shape, swing, r1 + f * (r2 - r1), z1 + f * (z2 - z1), elevation1 + f * (elevation2 - elevation1))));
      total += cut.cut(before, now, 0.01, terrain, load, book);
      before = now;
    }
    return total;
  }
  ImplementShape shape = bench::machine();
  Terrain terrain;
  BucketLoad load;
  SoilCut cut;
  std::vector<Truck> trucks;
  std::vector<DigZoneConfig> zones{DigZoneConfig{}};
  Landing landing;
  SoilBook book;
  double swing = 0;
};

TEST_F(SoilCutTest, OverTheGroundNothingIsCut) {
  EXPECT_EQ(drag(8, 0.3, 6, 0.3, -110 * degree, -110 * degree, 100), 0);
  EXPECT_EQ(load.volume(), 0);
}

TEST_F(SoilCutTest, DragFillsTheBucketWithWhatItsTrenchHeld) {
  const double before = terrain.loose_volume();
  const double displaced = drag(8.0, 0.05, 8.0, -0.3, -105 * degree, -105 * degree, 20);  // into the ground
  const double entered = load.volume(), pushed = displaced - entered;
  const double taken = drag(8.0, -0.3, 6.2, -0.3, -105 * degree, -115 * degree, 150);
  // A trench 1.126 m wide and 0.3 m deep over 1.8 m, swollen, and what had been pushed ahead; whole cells make the difference.
  EXPECT_NEAR(load.volume() - entered, 1.126 * 0.3 * 1.8 * 1.1 + pushed, 0.14);
  EXPECT_GE(taken, load.volume() - entered - 1e-9);
  EXPECT_NEAR(book.dug, load.volume(), 1e-9);
  EXPECT_NEAR((terrain.loose_volume() + load.volume()) / before, 1, 1e-12);
  EXPECT_NEAR(terrain.height(terrain.grid().index_x(7.5), terrain.grid().index_y(0)), -0.3, 0.05);
  EXPECT_NEAR(terrain.height(terrain.grid().index_x(7.5), terrain.grid().index_y(0.8)), 0, 1e-9) << "beside the bucket";
}

TEST_F(SoilCutTest, FullBucketPushesTheRestAhead) {
  drag(8.6, -0.1, 8.6, -0.9, -105 * degree, -105 * degree, 40);
  drag(8.6, -0.9, 5.6, -0.9, -105 * degree, -115 * degree, 250);
  EXPECT_NEAR(load.volume(), 1.2, 1e-12);
  double highest = 0;
  for (double r = 3.5; r < 5.6; r += 0.1) highest = std::max(highest, terrain.height(terrain.grid().index_x(r), terrain.grid().index_y(0)));
  EXPECT_GT(highest, 0.2) << "a heap before the bucket";
}

TEST_F(SoilCutTest, PushingBackwardsDoesNotFill) {
  drag(6.0, -0.3, 8.0, -0.3, -80 * degree, -80 * degree, 150);
  EXPECT_LT(load.volume(), 0.05);
  EXPECT_GT(terrain.height(terrain.grid().index_x(8.9), terrain.grid().index_y(0)), 0.05);
}

TEST_F(SoilCutTest, SwingingThroughSoilHeapsItUpBeside) {
  BucketPose before = cut.pose(link_frames(shape, bench::reach(shape, 0, 7, -0.3, -100 * degree)));
  const double entered = load.volume();
  for (int i = 1; i <= 20; ++i) {
    const BucketPose now = cut.pose(link_frames(shape, bench::reach(shape, 0.01 * i, 7, -0.3, -100 * degree)));
    cut.cut(before, now, 0.01, terrain, load, book);
    before = now;
  }
  EXPECT_EQ(load.volume(), entered);
  EXPECT_GT(terrain.loose_thickness(terrain.grid().index_x(7.1), terrain.grid().index_y(2.2)), 0.0);
}

TEST_F(SoilCutTest, WorksAtEverySwingAngle) {
  swing = 40 * degree;
  drag(8.0, -0.3, 6.2, -0.3, -105 * degree, -115 * degree, 150);
  EXPECT_NEAR(load.volume(), 1.126 * 0.3 * 1.8 * 1.1 + 0.15, 0.2);
}

TEST_F(SoilCutTest, ResistanceSlowsAndLetsGo) {
  double factor = 1;
  for (int i = 0; i < 100; ++i) factor = cut.speed_factor(0.0055, 0.01);  // 0.5 m3/s of bank
  EXPECT_NEAR(factor, 0.5, 0.01);
  for (int i = 0; i < 100; ++i) factor = cut.speed_factor(0.05, 0.01);
  EXPECT_GE(factor, 0.35);
  EXPECT_LT(factor, 0.4);
  for (int i = 0; i < 200; ++i) factor = cut.speed_factor(0, 0.01);
  EXPECT_NEAR(factor, 1, 1e-6);
}

TEST_F(SoilCutTest, SoilPushesAgainstTheEdgesMotion) {
  const BucketPose before = cut.pose(link_frames(shape, bench::reach(shape, 0, 8.0, -0.3, -105 * degree)));
  const BucketPose now = cut.pose(link_frames(shape, bench::reach(shape, 0, 7.99, -0.31, -105 * degree)));
  const EdgeForce none = cut.edge_force(before, now, 0.01, 1.0), half = cut.edge_force(before, now, 0.01, 0.5);
  EXPECT_EQ(std::hypot(none.r_n, none.z_n), 0);
  EXPECT_NEAR(std::hypot(half.r_n, half.z_n), 60e3, 1);
  EXPECT_NEAR(half.r_n, half.z_n, 1) << "inward and down, so outward and up";
  EXPECT_GT(half.r_n, 0);
  EXPECT_LT(std::hypot(cut.edge_force(now, now, 0.01, 0.5).r_n, cut.edge_force(now, now, 0.01, 0.5).z_n), 1) << "at rest nothing is pushed";
}

TEST_F(SoilCutTest, OpenBucketEmptiesUnderItsLip) {
  load.take(1.0);
  book.dug = 1.0;
  const BucketPose open = cut.pose(link_frames(shape, bench::reach(shape, 90 * degree, 5.0, 2.0, -50 * degree)));
  for (int i = 0; i < 400; ++i) {
    cut.empty(open, 0.01, terrain, load, landing, book);
    terrain.settle(5000);
  }
  EXPECT_EQ(load.volume(), 0);
  EXPECT_NEAR(book.spilled, 1.0, 1e-9);
  double near = 0;
  for (double x = -1.7; x < 1.71; x += 0.1) {
    for (double y = 3.4; y < 6.6; y += 0.1) near += terrain.loose_thickness(terrain.grid().index_x(x + 0.01), terrain.grid().index_y(y + 0.01)) * 0.01;
  }
  EXPECT_NEAR(near, 1.0, 0.01);
}

}  // namespace
}  // namespace berm::plant
