// What makes sensing quick changes nothing that is sensed: the view of a fan, the side thread, rays foreseen.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "bench.hpp"
#include "plant/world/random.hpp"
#include "plant/world/scene.hpp"
#include "plant/world/side_thread.hpp"
#include "plant/world/spinning_lidar.hpp"

namespace berm::plant {
namespace {

// A truck, a person, a vehicle and a box round the machine, and a lidar at either side of it.
WorldConfig crowded_site() {
  WorldConfig c = bench::site();
  c.trucks[0].wait_s = 0.5;
  c.boxes = {{"crate", 7.0, -5.0, -0.5, 1.5, 1.0, 0.8, 0.3}};
  MoverConfig person, car;
  person.name = "person", person.height = 1.8, person.radius = 0.25, person.waypoints = {{-5.0, -3.0, 0.0}};
  car.name = "car", car.vehicle = true, car.height = 1.6, car.length = 4.2, car.width = 1.8, car.waypoints = {{-9.0, 4.0, 0.0}, {-8.0, 5.0, 0.0}};
  c.movers = {person, car};
  c.scanner.dust_probability = 0.01;
  return c;
}

ImplementShape with_two_lidars() {
  ImplementShape s = bench::machine();
  s.lidar = {{{-2.65, 1.40, 1.05}, 0.02, -0.03, 0.4, 180.0, true, false}, {{1.30, -1.40, 1.10}, 0.0, 0.0, 0.0, 180.0, true, false}};
  return s;
}

TEST(Sensing, WhatAFanCannotMeetIsMetByNoneOfItsRays) {
  const WorldConfig config = crowded_site();
  const ImplementShape shape = bench::machine();
  const Terrain terrain(config.terrain, config.soil, 1);
  std::vector<Truck> trucks;
  trucks.emplace_back(config.trucks[0], config.soil, "truck", 0.0, 0.0, 0.0, 0.0);
  trucks[0].call(0.0);
  std::vector<Overflow> over;
  for (int i = 1; i < 3000; ++i) trucks[0].step(0.01 * i, 100, over);
  ASSERT_EQ(trucks[0].phase(), Truck::Phase::parked);
  Movers movers(config.movers);
  movers.step(30.0, 0.01, 0.0, terrain);
  Scene scene;
  scene.place_site(terrain, trucks, movers, config.boxes);
  Random random(3);
  int met = 0, left_out = 0;
  for (int k = 0; k < 20000; ++k) {
    const double swing = random.uniform(-3.0, 3.0), at = random.uniform(0.0, 6.3), spread = 0.003;
    scene.place_machine(shape, link_frames(shape, {{swing, random.uniform(0.0, 0.9), random.uniform(-2.4, -1.2), random.uniform(-2.0, -0.5)}, {}}), 0.3);
    const PlanarFrame body(0, 0, 0, swing);
    const BaseFrame stand({0.1, -0.2, 0.05, 0.02, -0.03});
    const Vec3 place{random.uniform(-3.0, 2.0), random.uniform(-1.6, 1.6), random.uniform(0.9, 3.4)};
    const RayFan upper{place, {std::cos(at), std::sin(at), 0}, {-std::sin(at), std::cos(at), 0}, spread};
    const RayFan base{body.out(upper.origin), body.out(upper.ahead), body.out(upper.aside), spread};
    const RayFan world{stand.out(base.origin), stand.turned(base.ahead), stand.turned(base.aside), spread};
    FanView view;
    ASSERT_TRUE(scene.look(world, base, upper, view));
    left_out += view.implement && view.upper_body.count + view.track.count + view.truck.count + view.box.count + view.person.count == 7 ? 0 : 1;
    for (double elevation = -0.5; elevation < 0.5; elevation += 0.05) {
      const double beside = at + random.uniform(-spread, spread);
      const Ray in_upper{place, {std::cos(elevation) * std::cos(beside), std::cos(elevation) * std::sin(beside), std::sin(elevation)}};
      const Ray in_base{base.origin, body.out(in_upper.direction)}, in_world{world.origin, stand.turned(in_base.direction)};
      const auto quick = scene.meet(view, in_world, in_base, in_upper, 60.0), whole = scene.meet(in_world, in_base, in_upper, 60.0);
      ASSERT_EQ(quick.has_value(), whole.has_value()) << k;
      if (!whole) continue;
      ++met;
      ASSERT_EQ(std::memcmp(&quick->range, &whole->range, sizeof quick->range), 0) << k << ": " << quick->range << ", " << whole->range;
      ASSERT_EQ(quick->mover, whole->mover) << k;
    }
  }
  EXPECT_GT(met, 100000);
  EXPECT_GT(left_out, 15000) << "a view that leaves nothing out tests nothing";
}

struct Sensed {
  std::vector<berm_scan_packet> scans;
  std::vector<LidarPacket> lidars;
  std::vector<MoverReturn> movers;
};

// The site of the test below at one moment: ground, a truck that has parked, somebody and a vehicle, and the machine.
struct Site {
  WorldConfig config = crowded_site();
  Terrain terrain{config.terrain, config.soil, 1};
  std::vector<Truck> trucks;
  Movers movers{config.movers};
  std::vector<Overflow> over;

  Site() {
    trucks.emplace_back(config.trucks[0], config.soil, "truck", 0.0, 0.0, 0.0, 0.0);
    trucks[0].call(0.0);
    for (int i = 1; i < 3000; ++i) trucks[0].step(0.01 * i, 100, over);
    movers.step(30.0, 0.01, 0.0, terrain);
  }
  [[nodiscard]] Scene scene(double boom, double heap_volume) const {
    Scene s;
    s.place_site(terrain, trucks, movers, config.boxes);
    s.place_machine(bench::machine(), link_frames(bench::machine(), {{0.0, boom, -2.0, -1.0}, {}}), heap_volume);
    return s;
  }
};

// Of fans round the machine: how many the difference may be met by. The rays of all others must meet the same in both scenes.
int met_by_difference(const Scene& before, const Scene& after, std::uint64_t seed) {
  const SceneDifference difference = after.difference(before);
  Random random(seed);
  int met = 0;
  for (int k = 0; k < 4000; ++k) {
    const double at = random.uniform(0.0, 2 * std::numbers::pi), spread = 0.003;
    const PlanarFrame body(0, 0, 0, random.uniform(-3.0, 3.0));
    const BaseFrame stand({0.1, -0.2, 0.05, 0.02, -0.03});
    const Vec3 place{random.uniform(-3.0, 2.0), random.uniform(-1.6, 1.6), random.uniform(0.9, 3.4)};
    const RayFan upper{place, {std::cos(at), std::sin(at), 0}, {-std::sin(at), std::cos(at), 0}, spread};
    const Vec3 origin = body.out(place);
    const RayFan world{stand.out(origin), stand.turned(body.out(upper.ahead)), stand.turned(body.out(upper.aside)), spread};
    if (difference.may_be_met(world, upper)) {
      ++met;
      continue;
    }
    for (double elevation = -0.5; elevation < 0.5; elevation += 0.03) {
      const double beside = at + random.uniform(-spread, spread);
      const Ray in_upper{place, {std::cos(elevation) * std::cos(beside), std::cos(elevation) * std::sin(beside), std::sin(elevation)}};
      const Ray in_base{origin, body.out(in_upper.direction)}, in_world{world.origin, stand.turned(in_base.direction)};
      const auto then = before.meet(in_world, in_base, in_upper, 60.0), now = after.meet(in_world, in_base, in_upper, 60.0);
      EXPECT_EQ(then.has_value(), now.has_value()) << k;
      if (!then || !now) continue;
      EXPECT_EQ(std::memcmp(&then->range, &now->range, sizeof now->range), 0) << k << ": " << then->range << ", " << now->range;
      EXPECT_EQ(then->mover, now->mover) << k;
    }
  }
  return met;
}

TEST(Sensing, FansThatMeetNoDifferenceOfScenesMeetTheSameInBoth) {
  Site site;
  const Scene before = site.scene(0.6, 0.3);
  EXPECT_TRUE(site.scene(0.6, 0.3).difference(before).none());
  const auto some = [&](const Scene& after, std::uint64_t seed) {
    const int met = met_by_difference(before, after, seed);
    EXPECT_GT(met, 10) << seed;
    EXPECT_LT(met, 3000) << seed;
  };
  some(site.scene(0.61, 0.3), 1);
  some(site.scene(0.6, 0.4), 2);
  // Each of these changes comes on top of those before.
  for (int i = 0; i < 30; ++i) site.trucks[0].heap().deposit(0.3, 0.2, 0.02);
  site.trucks[0].step(30.0, 100, site.over);
  some(site.scene(0.6, 0.3), 3);
  site.movers.step(32.0, 2.0, 0.0, site.terrain);
  some(site.scene(0.6, 0.3), 4);
  const int ix = site.terrain.grid().index_x(7.0), iy = site.terrain.grid().index_y(-2.0);
  site.terrain.deposit(ix, iy, 0.01);
  site.terrain.settle(1000);
  some(site.scene(0.6, 0.3), 5);
  site.terrain.deposit(ix, iy, 0.01);
  site.terrain.settle(1000);
  EXPECT_TRUE(site.scene(0.6, 0.3).difference(before).everywhere) << "where the ground changed first is not known any more";
}

TEST(Sensing, AHighestHeightThatChangesIsADifferenceEverywhere) {
  Site site;
  const Scene before = site.scene(0.6, 0.3);
  site.terrain.deposit(site.terrain.grid().index_x(-10.0), site.terrain.grid().index_y(-10.0), 0.05);
  site.terrain.settle(1);
  EXPECT_TRUE(site.scene(0.6, 0.3).difference(before).everywhere);
}

enum class Manner { plain, aside, foreseen, foreseen_in_part };

Sensed sensed(Manner manner) {
  World world(crowded_site(), with_two_lidars(), 5, 1);
  SideThread side;
  Sensed all;
  JointState before{{0.0, 0.6, -2.2, -1.5}, {}};
  for (int i = 1; i <= 60; ++i) {
    JointState now = before;
    now.angle[0] += 0.004;
    now.angle[1] += i > 30 ? 0.002 : 0.0;
    const double t = 0.01 * i;
    if (manner == Manner::foreseen || manner == Manner::foreseen_in_part) {
      JointState expected = now;  // now and then the joints go another way
      if (i % 7 == 0) expected.angle[0] += 0.001;
      if (i % 5 == 0) expected.angle[1] -= 0.01;
      int asked = 0;
      world.foresee(t, 0.01, before, expected, [&] { return manner == Manner::foreseen_in_part && ++asked > i; });
    }
    world.step(t, 0.01, now, before);
    if (manner == Manner::plain) {
      world.scan(t, 0.01, before, now, {}, {}, all.scans);
      world.scan_lidars(t, 0.01, before, now, all.lidars);
    } else {
      world.sense(t, 0.01, before, now, {}, {}, all.scans, all.lidars, &side);
    }
    all.movers.insert(all.movers.end(), world.mover_returns().begin(), world.mover_returns().end());
    before = now;
  }
  return all;
}

TEST(Sensing, ASideThreadAndWhatIsDoneAheadChangeNothing) {
  const Sensed plain = sensed(Manner::plain);
  ASSERT_GT(plain.lidars.size(), 1000u);
  ASSERT_GT(plain.movers.size(), 100u);
  for (const Manner manner : {Manner::aside, Manner::foreseen, Manner::foreseen_in_part}) {
    const Sensed other = sensed(manner);
    ASSERT_EQ(other.scans.size(), plain.scans.size());
    for (std::size_t i = 0; i < plain.scans.size(); ++i) {
      ASSERT_EQ(other.scans[i].count, plain.scans[i].count);
      ASSERT_EQ(std::memcmp(other.scans[i].range, plain.scans[i].range, sizeof plain.scans[i].range), 0) << i;
    }
    ASSERT_EQ(other.lidars.size(), plain.lidars.size());
    for (std::size_t i = 0; i < plain.lidars.size(); ++i) {
      ASSERT_EQ(other.lidars[i].lidar, plain.lidars[i].lidar) << i;
      ASSERT_EQ(other.lidars[i].bytes, plain.lidars[i].bytes) << i;
    }
    ASSERT_EQ(other.movers.size(), plain.movers.size());
    for (std::size_t i = 0; i < plain.movers.size(); ++i) ASSERT_EQ(other.movers[i].x, plain.movers[i].x) << i;
  }
}

}  // namespace
}  // namespace berm::plant
