#include <gtest/gtest.h>

#include "plant/world/movers.hpp"

namespace berm::plant {
namespace {

MoverConfig walker() {
  MoverConfig m;
  m.name = "walker";
  m.height = 1.8;
  m.radius = 0.25;
  m.speed = 1.6;
  m.waypoints = {{-10, 0, 0}, {-6, 0, 2}, {-6, 3, 0}};
  return m;
}

struct Walk {
  explicit Walk(const MoverConfig& c) : movers({c}) {}
  void until(double end, double swing = 0) {
    for (; t < end - 1e-9; t += 0.01) movers.step(t + 0.01, 0.01, swing, terrain);
  }
  Terrain terrain{{}, {}, 1};
  Movers movers;
  double t = 0;
};

TEST(Movers, WalksWaitsAndTurns) {
  Walk w(walker());
  w.until(1);
  EXPECT_NEAR(w.movers.pose(0).x, -10 + 1.6, 1e-6);
  EXPECT_NEAR(w.movers.pose(0).yaw, 0, 1e-12);
  w.until(2.5 + 1.0);
  EXPECT_NEAR(w.movers.pose(0).x, -6, 1e-9) << "waits there";
  EXPECT_NEAR(w.movers.pose(0).y, 0, 1e-9);
  w.until(2.5 + 2.0 + 1.0);
  EXPECT_NEAR(w.movers.pose(0).y, 1.6, 1e-6);
  EXPECT_NEAR(w.movers.pose(0).yaw, 1.5708, 1e-4);
  w.until(60);
  EXPECT_NEAR(w.movers.pose(0).y, 3, 1e-12) << "stays at the last waypoint";
}

TEST(Movers, StartsWhenToldTo) {
  MoverConfig c = walker();
  c.start_s = 3;
  c.start_swing_above = 0.5;
  Walk w(c);
  w.until(2, 1.0);
  EXPECT_EQ(w.movers.pose(0).x, -10) << "not before its time, whatever the swing";
  w.until(5, 0.4);
  EXPECT_EQ(w.movers.pose(0).x, -10) << "not below the angle";
  w.until(6, 0.6);
  EXPECT_NEAR(w.movers.pose(0).x, -8.4, 1e-6);
  w.until(7, 0.0);
  EXPECT_NEAR(w.movers.pose(0).x, -6.8, 1e-6) << "once started it goes on";
}

TEST(Movers, StandOnTheGround) {
  MoverConfig c = walker();
  c.waypoints = {{0, 0, 0}, {0, 10, 0}};
  Walk w(c);
  w.until(0.1);
  EXPECT_NEAR(w.movers.pose(0).z, 0, 1e-9);
  w.until(10);
  EXPECT_NEAR(w.movers.pose(0).z, -2.2, 1e-9);
}

TEST(Movers, OneWaypointStandsStill) {
  MoverConfig c = walker();
  c.waypoints = {{-3, 2, 5}};
  Walk w(c);
  w.until(10);
  EXPECT_EQ(w.movers.pose(0).x, -3);
  EXPECT_EQ(w.movers.pose(0).y, 2);
}

}  // namespace
}  // namespace berm::plant
