// Whatever the machine does, soil is neither made nor lost, and the books agree.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bench.hpp"
#include "plant/world/landing.hpp"
#include "plant/world/soil_cut.hpp"

namespace berm::plant {
namespace {

using bench::degree;
double draw(std::mt19937_64& r, double low, double high) { return low + (high - low) * static_cast<double>(r() >> 11) * 0x1.0p-53; }

class SoilConservation : public ::testing::TestWithParam<int> {};

TEST_P(SoilConservation, RandomMotionsOverBenchAndTruck) {
  std::mt19937_64 r(static_cast<uint64_t>(GetParam()));
  const ImplementShape shape = bench::machine();
  WorldConfig config = bench::site();
  config.soil.stick_fraction = GetParam() % 2 == 0 ? 0.0 : 0.15;
  Terrain terrain(config.terrain, config.soil, 1);
  std::vector<Truck> trucks;
  trucks.emplace_back(config.trucks[0], config.soil, "truck_1", -2.2, 0, 0, 0);
  trucks[0].call(0);
  Landing landing(terrain, trucks, config.dig_zones);
  BucketLoad load(shape, config.soil);
  SoilCut cut(shape, config.soil);
  SoilBook book;
  std::vector<Overflow> over;
  const double before = terrain.loose_volume();
  double cut_volume = 0;

  JointState at = bench::reach(shape, 0, 7, 0.5, -120 * degree);
  for (int leg = 0; leg < 60; ++leg) {
    // By turns: anywhere in the soil, curled and lifted, over the truck, opened there; now and then a little beside it.
    const double dig_swing = draw(r, -40, 40) * degree, truck_swing = draw(r, 65, 120) * degree;
    JointState goal = at;
    if (leg % 4 == 0) goal = bench::reach(shape, dig_swing, draw(r, 5.2, 8.0), draw(r, -2.8, 0.5), draw(r, -150, -60) * degree);
    else if (leg % 4 == 1) goal = bench::reach(shape, at.angle[0], 5.0, 1.0, -180 * degree);
    else if (leg % 4 == 2) goal = bench::reach(shape, truck_swing, draw(r, 5.0, 6.5), draw(r, 1.5, 2.0), -180 * degree);
    else goal.angle[3] = 35 * degree;
    BucketPose last = cut.pose(link_frames(shape, at));
    for (int i = 1; i <= 80; ++i) {
      JointState now = at;
      for (size_t k = 0; k < 4; ++k) now.angle[k] += (goal.angle[k] - at.angle[k]) * i / 80;
      const BucketPose pose = cut.pose(link_frames(shape, now));
      over.clear();
      trucks[0].step(0.01 * i, 1000, over);
      for (const Overflow& o : over) landing.overflow(trucks[0], o, book);
      cut_volume += cut.cut(last, pose, 0.01, terrain, load, book);
      cut.empty(pose, 0.01, terrain, load, landing, book);
      terrain.settle(2000);
      last = pose;
      ASSERT_GE(load.volume(), 0);
      ASSERT_LE(load.volume(), 1.2 + 1e-12);
    }
    at = goal;
    const double in_truck = trucks[0].heap().loose_volume();
    ASSERT_NEAR((terrain.loose_volume() + load.volume() + in_truck - before) / std::max(0.1, cut_volume), 0, 1e-6) << "leg " << leg;
    ASSERT_NEAR(book.dug, load.volume() + in_truck + book.spilled, 1e-9) << "leg " << leg;
  }
  EXPECT_GT(cut_volume, 3) << "the motions dig";
  EXPECT_GT(trucks[0].heap().loose_volume(), 0.2) << "and dump";
}

INSTANTIATE_TEST_SUITE_P(Seeds, SoilConservation, ::testing::Range(1, 7));

}  // namespace
}  // namespace berm::plant
