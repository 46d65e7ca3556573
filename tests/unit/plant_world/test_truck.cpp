#include <gtest/gtest.h>

#include "bench.hpp"
#include "plant/world/landing.hpp"
#include "plant/world/truck.hpp"

namespace berm::plant {
namespace {

Truck make(double wait = 0) {
  TruckConfig c = bench::truck();
  c.wait_s = wait;
  return Truck(c, {}, "truck_1", -2.2, 0, 0, 0);
}

TEST(Truck, FirstOneStandsAtTheStart) {
  Truck t = make();
  std::vector<Overflow> over;
  t.call(0);
  t.step(0, 100, over);
  EXPECT_EQ(t.phase(), Truck::Phase::parked);
  EXPECT_NEAR(t.frame().x, -0.70, 1e-12);
  EXPECT_NEAR(t.frame().y, 6.75, 1e-12);
  EXPECT_NEAR(t.frame().z, 0.30 - 1.22, 1e-12);
}

TEST(Truck, BedAndCabAreWhereTheConfigurationSays) {
  Truck t = make();
  std::vector<Overflow> over;
  t.call(0);
  t.step(0, 100, over);
  EXPECT_TRUE(t.over_bed(t.frame().in(Vec3{1.7, 7.9, 0})));
  EXPECT_FALSE(t.over_bed(t.frame().in(Vec3{1.8, 6.75, 0})));
  EXPECT_TRUE(t.over_truck(t.frame().in(Vec3{1.78, 6.75, 0}))) << "rear wall";
  EXPECT_TRUE(t.over_truck(t.frame().in(Vec3{-5.0, 6.75, 0}))) << "the cab points along the yaw";
  EXPECT_FALSE(t.over_truck(t.frame().in(Vec3{4.0, 6.75, 0})));
}

TEST(Truck, ComesInReverseWithoutJumpsAndLeavesForward) {
  Truck t = make(20);
  std::vector<Overflow> over;
  t.call(0);
  double last = 1e9, fastest = 0, stood = -1;
  for (int i = 0; i <= 2500; ++i) {
    t.step(i * 0.01, 100, over);
    if (last < 1e8) fastest = std::max(fastest, std::abs(t.frame().x - last) / 0.01);
    last = t.frame().x;
    if (t.phase() == Truck::Phase::parked && stood < 0) stood = i * 0.01;
  }
  EXPECT_NEAR(stood, 20, 0.011);
  EXPECT_NEAR(fastest, 2, 0.02);
  t.release(25);
  double left = -1;
  for (int i = 0; i <= 2000; ++i) {
    t.step(25 + i * 0.01, 100, over);
    EXPECT_LT(t.frame().x, last + 1e-9) << "towards the cab";
    last = t.frame().x;
    if (t.phase() == Truck::Phase::gone && left < 0) left = 25 + i * 0.01;
  }
  EXPECT_NEAR(last, -14.7, 1e-9);
  EXPECT_NEAR(left, t.gone_at(), 0.02);
  EXPECT_FALSE(t.present());
}

TEST(Truck, ReleaseCountsOnlyWhenParked) {
  Truck t = make(5);
  std::vector<Overflow> over;
  t.call(0);
  t.step(0, 100, over);
  t.release(0);
  EXPECT_NE(t.phase(), Truck::Phase::leaving);
}

class LandingTest : public ::testing::Test {
 protected:
  LandingTest() : terrain({}, {}, 1), landing(terrain, trucks, zones) {
    trucks.push_back(make());
    std::vector<Overflow> over;
    trucks[0].call(0);
    trucks[0].step(0, 100, over);
    book.dug = 1;
  }
  Terrain terrain;
  std::vector<Truck> trucks;
  std::vector<DigZoneConfig> zones{DigZoneConfig{}};
  Landing landing;
  SoilBook book;
};

TEST_F(LandingTest, IntoTheBed) {
  landing.drop(-0.7, 6.75, 0.4, book);
  EXPECT_NEAR(trucks[0].heap().loose_volume(), 0.4, 1e-12);
  EXPECT_EQ(book.spilled, 0);
}

TEST_F(LandingTest, BackIntoTheDigZoneIsNotDug) {
  landing.drop(6.5, 0, 0.4, book);
  EXPECT_NEAR(book.dug, 0.6, 1e-12);
  EXPECT_EQ(book.spilled, 0);
}

TEST_F(LandingTest, BesideTheTruckIsSpilled) {
  landing.drop(-0.7, 5.0, 0.4, book);
  EXPECT_NEAR(book.spilled, 0.4, 1e-12);
  EXPECT_EQ(trucks[0].heap().loose_volume(), 0);
}

TEST_F(LandingTest, OnTheCabSlidesToTheGround) {
  const double before = terrain.loose_volume();
  landing.drop(-5.0, 6.5, 0.4, book);
  EXPECT_NEAR(book.spilled, 0.4, 1e-12);
  EXPECT_NEAR(terrain.loose_volume() - before, 0.4, 1e-6);
  EXPECT_EQ(terrain.loose_thickness(terrain.grid().index_x(-5.0), terrain.grid().index_y(6.5)), 0) << "not under the truck";
}

TEST_F(LandingTest, OnAWallGoesToTheNearerSide) {
  landing.drop(-0.7, 6.75 - 1.22 - 0.02, 0.1, book);
  EXPECT_NEAR(trucks[0].heap().loose_volume(), 0.1, 1e-12);
  landing.drop(-0.7, 6.75 - 1.22 - 0.06, 0.1, book);
  EXPECT_NEAR(book.spilled, 0.1, 1e-12);
}

}  // namespace
}  // namespace berm::plant
