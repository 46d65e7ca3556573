#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "watch/intrusion_run.hpp"

namespace berm::watch {
namespace {

constexpr int runs = 600;

class IntrusionTest : public testing::Test {
 protected:
  static const Bench& bench() {
    static const Bench made = make_bench(BERM_MACHINES "/zx200.toml", false, BERM_PLANT_PROFILES);
    return made;
  }
  static const IntrusionSite& site() { return bench().intrusion_site; }
  static Intrusion drawn(int run) { return draw_intrusion(5, run, site()); }

  // Points of the whole way, every 5 cm.
  template <typename Visit>
  static void along(const Intrusion& in, Visit visit) {
    const auto& w = in.mover.waypoints;
    for (std::size_t i = 0; i + 1 < w.size(); ++i)
      for (double f = 0.0; f <= 1.0; f += 0.05 / std::max(0.1, std::hypot(w[i + 1].x - w[i].x, w[i + 1].y - w[i].y)))
        visit(w[i].x + f * (w[i + 1].x - w[i].x), w[i].y + f * (w[i + 1].y - w[i].y));
  }
};

TEST_F(IntrusionTest, the_bench_watches_its_workspace_whatever_the_file_says) { EXPECT_TRUE(bench().machine.workspace.watched); }

TEST_F(IntrusionTest, the_same_seed_and_run_give_the_same_and_others_another) {
  EXPECT_EQ(describe(drawn(3)), describe(drawn(3)));
  EXPECT_EQ(drawn(3).waits_s, drawn(3).waits_s);
  EXPECT_NE(describe(drawn(3)), describe(drawn(4)));
  EXPECT_NE(describe(drawn(3)), describe(draw_intrusion(6, 3, site())));
}

TEST_F(IntrusionTest, while_the_ground_is_learned_the_same_come_sooner) {
  double first_s = 1e9, last_s = 0.0;
  for (int i = 0; i < runs; ++i) {
    const Intrusion in = draw_intrusion(5, i, site(), When::learning);
    EXPECT_EQ(describe(in), describe(drawn(i)));
    first_s = std::min(first_s, in.waits_s);
    last_s = std::max(last_s, in.waits_s);
  }
  EXPECT_GT(first_s, 3.0) << "free space is learned then";
  EXPECT_LT(first_s, 5.0);
  EXPECT_GT(last_s, 30.0);
  EXPECT_LT(last_s, make_bench(BERM_MACHINES "/zx200_ring.toml", false, BERM_PLANT_PROFILES).machine.workspace.learn) << "heights have been learned then";
}

TEST_F(IntrusionTest, every_way_size_gait_and_version_is_drawn) {
  std::map<Way, int> way;
  std::map<Who, int> who;
  int running = 0, follows = 0;
  for (int i = 0; i < runs; ++i) {
    const Intrusion in = drawn(i);
    ++way[in.way];
    ++who[in.who];
    running += in.running ? 1 : 0;
    follows += in.follows ? 1 : 0;
  }
  for (const Way w : ways) EXPECT_GT(way[w], runs / 12) << name_of(w);
  EXPECT_GT(who[Who::adult], runs / 4);
  EXPECT_GT(who[Who::child], runs / 4);
  EXPECT_GT(who[Who::vehicle], runs / 50);
  EXPECT_GT(running, runs / 5);
  EXPECT_NEAR(follows, runs / 2, runs / 10);
}

TEST_F(IntrusionTest, sizes_and_speeds_are_those_that_are_named) {
  for (int i = 0; i < runs; ++i) {
    const Intrusion in = drawn(i);
    const plant::MoverConfig& m = in.mover;
    EXPECT_EQ(m.vehicle, in.who == Who::vehicle);
    if (in.who == Who::adult) {
      EXPECT_DOUBLE_EQ(m.height, 1.8);
    }
    if (in.who == Who::child) {
      EXPECT_DOUBLE_EQ(m.height, 1.1);
    }
    EXPECT_GE(m.speed, in.running ? 2.0 : 1.0);
    EXPECT_LE(m.speed, in.running ? 4.0 : 1.6);
    EXPECT_FALSE(m.vehicle && (in.way == Way::dig_face || in.way == Way::truck_side));
  }
}

TEST_F(IntrusionTest, ways_go_round_the_truck_and_the_machine_and_begin_on_the_terrain_beside_the_sweep) {
  for (int i = 0; i < runs; ++i) {
    const Intrusion in = drawn(i);
    const double half = in.mover.vehicle ? 0.5 * std::hypot(in.mover.length, in.mover.width) : in.mover.radius;
    double truck_m = 1e9, axis_m = 1e9;
    along(in, [&](double x, double y) {
      truck_m = std::min(truck_m, distance_from_truck(site().truck, x, y) - half);
      axis_m = std::min(axis_m, std::hypot(x, y) - half);
    });
    EXPECT_GT(truck_m, 0.09) << describe(in);
    EXPECT_GT(axis_m, site().own_radius - 0.05) << describe(in);
    const auto& from = in.mover.waypoints.front();
    EXPECT_LT(std::fabs(from.x), site().extent[0]);
    EXPECT_LT(std::fabs(from.y), site().extent[1]);
    const double bearing = std::atan2(from.y, from.x);
    const bool in_sector = bearing > site().swing_low && bearing < site().swing_high;
    EXPECT_FALSE(in_sector && std::hypot(from.x, from.y) < site().implements_reach + 1.0) << describe(in);
  }
}

TEST_F(IntrusionTest, beside_the_truck_it_keeps_the_drawn_gap_on_the_machines_side) {
  int seen = 0;
  for (int i = 0; i < runs; ++i) {
    const Intrusion in = drawn(i);
    if (in.way != Way::truck_side) continue;
    ++seen;
    ASSERT_EQ(in.mover.waypoints.size(), 3U);
    EXPECT_GE(in.side_gap_m, 0.1);
    EXPECT_LE(in.side_gap_m, 0.3);
    EXPECT_GT(in.mover.waypoints[1].wait_s, 15.0) << "until the scanners have looked";
    const auto& turn = in.mover.waypoints[1];
    EXPECT_NEAR(distance_from_truck(site().truck, turn.x, turn.y) - in.mover.radius, in.side_gap_m, 1e-9);
    EXPECT_LT(turn.y, site().truck.y) << "not the side that faces the machine";  // the truck stands along x, to the left
  }
  EXPECT_GT(seen, 50);
}

TEST_F(IntrusionTest, the_truck_is_a_rectangle_with_its_cab) {
  plant::TruckConfig t;
  t.length = 4.0, t.width = 2.0, t.wall_thickness = 0.1, t.cab_length = 2.0, t.cab_gap = 0.5;
  EXPECT_DOUBLE_EQ(distance_from_truck(t, 0.0, 0.0), 0.0);
  EXPECT_NEAR(distance_from_truck(t, -3.1, 0.0), 1.0, 1e-12);
  EXPECT_NEAR(distance_from_truck(t, 5.6, 0.0), 1.0, 1e-12);
  EXPECT_NEAR(distance_from_truck(t, 1.0, 2.1), 1.0, 1e-12);
  t.yaw = std::acos(-1.0);
  EXPECT_NEAR(distance_from_truck(t, 3.1, 0.0), 1.0, 1e-12);
}

}  // namespace
}  // namespace berm::watch
