// Who comes while the ground is learned: histograms take him for the ground, free space does not, once rays have passed all round where he is (SK-FS-11).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "lidar_ring.hpp"
#include "watched_ring.hpp"

namespace berm::kernel::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kWalkM_s = 1.6;             // ISO 13855
constexpr double kFromM = 16.0, kToM = 5.0;  // of the swing axis; the region ends at 15
constexpr double kComesS = 4.0, kStaysS = 2.0, kWayS = (kFromM - kToM) / kWalkM_s;
constexpr double kLearnRad_s = 0.087;        // a swing at learn_speed

class LearningIntruderTest : public testing::Test {
 protected:
  LearningIntruderTest() {
    parameters.workspace_histogram = 1;
    parameters.workspace_learn_us = 45'000'000;
  }
  // He comes, stays, and goes where he came from.
  bool step(Ring& ring, const Somebody& who, double bearing_deg) {
    const double t = ring.time_s() - kComesS, d = distance(t), bearing = bearing_deg * kPi / 180;
    ring.scene.people = {{d * std::cos(bearing), d * std::sin(bearing), who.radius, who.height}};
    return ring.step();
  }
  static double distance(double t) { return kFromM - kWalkM_s * (std::clamp(t, 0.0, kWayS) - std::clamp(t - kWayS - kStaysS, 0.0, kWayS)); }
  berm_parameters parameters = watched_ring();
};

// verifies: SK-FS-11, SK-FS-13
TEST_F(LearningIntruderTest, WhoWalksInStopsIt) {
  for (const double rad_s : {0.0, kLearnRad_s})
    for (const Somebody& who : {kAdult, kChild}) {
      double nearest = kFromM;
      int found = 0, of = 0;
      for (int bearing_deg = 20; bearing_deg < 360; bearing_deg += 60, ++of) {
        const auto ring = std::make_unique<Ring>(parameters);
        ring->swing = [rad_s](double t) { return rad_s * t; };
        while (ring->time_s() < kComesS + kWayS + kStaysS) {
          if (!step(*ring, who, bearing_deg)) continue;
          EXPECT_TRUE(ring->watch.learns());
          nearest = std::min(nearest, distance(ring->time_s() - kComesS));
          ++found;
          break;
        }
      }
      std::printf("%s, swing %.3f rad/s: %d of %d stopped for, at %.1f m or farther\n", who.name, rad_s, found, of, nearest);
      EXPECT_EQ(found, of) << who.name << " " << rad_s;
      EXPECT_GT(nearest, rad_s > 0.0 ? 7.5 : kToM) << who.name << " " << rad_s;
    }
}

// verifies: SK-FS-15
TEST_F(LearningIntruderTest, WhoWalksInOverTheDigStopsIt) {
  parameters.dig_zone[0] = {3900, -4200, 14900, 4200, -3400, 1100};
  for (const Somebody& who : {kAdult, kChild}) {
    const auto ring = std::make_unique<Ring>(parameters);
    ring->swing = [](double t) { return kLearnRad_s * t; };
    double found = 0.0;
    while (found == 0.0 && ring->time_s() < kComesS + kWayS + kStaysS)
      if (step(*ring, who, 0.0)) found = distance(ring->time_s() - kComesS);
    EXPECT_TRUE(ring->watch.learns());
    EXPECT_GT(found, 7.5) << who.name;
    std::printf("%s in the dig zone: stopped for at %.1f m\n", who.name, found);
  }
}

// verifies: SK-FS-4, SK-FS-11
TEST_F(LearningIntruderTest, WhenHeHasLeftItGoesOn) {
  const auto ring = std::make_unique<Ring>(parameters);
  double held_from = 0.0, held_until = 0.0;
  while (ring->time_s() < kComesS + 2 * kWayS + kStaysS + 4.0) {
    if (!step(*ring, kAdult, 150.0)) continue;
    held_until = ring->time_s();
    if (held_from == 0.0) held_from = held_until;
  }
  const double turns_s = kComesS + kWayS + kStaysS;
  EXPECT_GT(held_from, 0.0);
  EXPECT_GT(held_until, turns_s) << "he stood there";
  EXPECT_LT(held_until, turns_s + kWayS + 4.0);
  EXPECT_TRUE(ring->watch.learns());
}

// verifies: SK-FS-11
TEST_F(LearningIntruderTest, WhatStandsThereIsNobodyHoweverTheMachineSwings) {
  for (const double rad_s : {0.0, kLearnRad_s, 0.6}) {
    const auto ring = std::make_unique<Ring>(parameters);
    ring->scene.boxes = {{{6.13, 4.08, 0.0}, {8.1, 7.0, 1.6}}, {{-9.1, -6.0, 0.0}, {-6.55, -4.37, 2.5}}, {{-5.0, 8.0, 0.0}, {-4.9, 12.0, 1.8}}};
    ring->swing = [rad_s](double t) { return 1.2 * std::sin(rad_s / 1.2 * t); };
    while (ring->time_s() < 20.0) ASSERT_FALSE(ring->step()) << rad_s << " rad/s, " << ring->time_s() << " s: " << ring->where();
  }
}

}  // namespace
}  // namespace berm::kernel::test
