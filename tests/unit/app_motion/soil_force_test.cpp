#include "motion/soil_force.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "app_bench/bench_machine.hpp"
#include "motion/bucket_weight.hpp"

namespace berm::app {
namespace {

constexpr double gravity = 9.81;

// Weights on a frame of this test's own: moments by virtual work.
struct Weights { double boom = 2000.0, stick = 1000.0, bucket = 700.0; };

Moments held_by(const MachineModel& machine, const Joints& q, const Weights& w, double load_kg, const PlaneForce& soil) {
  const auto energy = [&](const Joints& at) {
    const ArmPoints arm = forward(machine, at);
    const auto middle = [](const PlanePoint& a, const PlanePoint& b) { return 0.5 * (a.z + b.z); };
    return gravity * (w.boom * middle(arm.boom_pin, arm.stick_pin) + w.stick * middle(arm.stick_pin, arm.bucket_pin) + (w.bucket + load_kg) * middle(arm.bucket_pin, arm.tip)) -
           (soil.r * arm.tip.r + soil.z * arm.tip.z);
  };
  Moments m{};
  for (const Joint j : {boom, stick, bucket}) {
    Joints low = q, high = q;
    low[j] -= 1e-6;
    high[j] += 1e-6;
    m[j - 1] = (energy(high) - energy(low)) / 2e-6;
  }
  return m;
}

ImplementWeight learned(const MachineModel& machine, const Weights& w, double noise_nm, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, noise_nm);
  ImplementWeight weight;
  for (int k = 0; k < 600; ++k) {
    const double t = k / 600.0;
    const Joints q{0.0, radians(45.0 - 40.0 * t), radians(-60.0 - 35.0 * t), radians(-100.0 + 65.0 * t)};
    Moments m = held_by(machine, q, w, 0.0, {});
    for (double& x : m) x += noise(random);
    weight.learn(q, m, machine.cycle);
  }
  return weight;
}

TEST(ImplementWeight, IsLearnedFromAnEmptyBucketsWay) {
  const MachineModel machine = app_bench::zx200();
  ImplementWeight none;
  EXPECT_FALSE(none.known({0.0, 0.1, -1.0, -1.0}));
  const ImplementWeight weight = learned(machine, {}, 3000.0, 1);
  const Joints dig{0.0, radians(-5.0), radians(-55.0), radians(-60.0)};
  ASSERT_TRUE(weight.known(dig));
  const Moments truth = held_by(machine, dig, {}, 0.0, {}), told = weight.of(dig);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(told[i], truth[i], 1500.0) << "pin " << i;
}

TEST(BucketWeight, IsWhatTheBucketHoldsInEveryPoseOfAPass) {
  const MachineModel machine = app_bench::zx200();
  const ImplementWeight weight = learned(machine, {}, 0.0, 1);
  for (const double kg : {0.0, 60.0, 700.0, 1600.0})
    for (const auto& [b, st, bu] : {std::array{39.0, -91.0, -126.0}, std::array{28.0, -56.0, -126.0}, std::array{30.0, -63.0, -20.0}}) {
      const Joints q{0.0, radians(b), radians(st), radians(bu)};
      EXPECT_NEAR(weight_in_bucket(machine, q, held_by(machine, q, {}, kg, {}), weight.of(q)), kg, 1.0) << "boom " << b << ", bucket " << bu;
    }
  const Joints steep{0.0, radians(80.0), radians(-60.0), radians(-100.0)};
  EXPECT_LT(weight_in_bucket(machine, steep, held_by(machine, steep, {}, 800.0, {}), weight.of(steep)), 0.0) << "no lever to weigh with";
}

// Soil that sticks is in the bucket while the implements' weight is learned, another lot each time: without its moments what is learned is theirs alone.
TEST(BucketWeight, WhatSticksIsNoPartOfTheImplements) {
  const MachineModel machine = app_bench::zx200();
  ImplementWeight weight;
  for (int k = 0; k < 600; ++k) {
    const double t = k / 600.0, stuck = k < 200 ? 0.0 : k < 400 ? 210.0 : 130.0;
    const Joints q{0.0, radians(45.0 - 40.0 * t), radians(-60.0 - 35.0 * t), radians(-100.0 + 65.0 * t)};
    weight.learn(q, without_load(machine, q, held_by(machine, q, {}, stuck, {}), stuck), machine.cycle);
  }
  const Joints q{0.0, radians(28.0), radians(-56.0), radians(-126.0)};
  EXPECT_NEAR(weight_in_bucket(machine, q, held_by(machine, q, {}, 1400.0, {}), weight.of(q)), 1400.0, 1.0);
}

TEST(ImplementWeight, OnePoseSaysNothingOfOthers) {
  const MachineModel machine = app_bench::zx200();
  ImplementWeight weight;
  const Joints q{0.0, 0.6, -1.7, -1.7};
  for (int k = 0; k < 1000; ++k) weight.learn(q, held_by(machine, q, {}, 0.0, {}), machine.cycle);
  EXPECT_FALSE(weight.known({0.0, 0.0, -1.0, -0.6}));
}

TEST(SoilForce, IsWhatActsOnTheBucketWhereverItActs) {
  const MachineModel machine = app_bench::zx200();
  for (const Joints& q : {Joints{0.0, radians(-5.0), radians(-55.0), radians(-40.0)}, Joints{0.0, radians(10.0), radians(-75.0), radians(-110.0)}})
    for (const PlaneForce& soil : {PlaneForce{40e3, 0.0}, PlaneForce{-10e3, 55e3}, PlaneForce{0.0, 0.0}}) {
      const PlaneForce found = force_on_bucket(machine, q, held_by(machine, q, {}, 900.0, soil), held_by(machine, q, {}, 0.0, {}));
      EXPECT_NEAR(found.r, soil.r, 20.0);
      EXPECT_NEAR(found.z, soil.z - 900.0 * gravity, 20.0);
    }
}

TEST(SoilForce, AnArmInLineTellsNothing) {
  const MachineModel machine = app_bench::zx200();
  const PlaneForce found = force_on_bucket(machine, {0.0, 0.2, 0.0, -1.0}, {1e4, 2e4, 3e4}, {0.0, 0.0, 0.0});
  EXPECT_EQ(found.r, 0.0);
  EXPECT_EQ(found.z, 0.0);
}

TEST(SoilForce, ResistanceIsThePartAgainstTheMotion) {
  const MachineModel machine = app_bench::zx200();
  const Joints q{0.0, radians(0.0), radians(-60.0), radians(-40.0)};
  EXPECT_EQ(resistance(machine, q, {}, {50e3, 0.0}), 0.0) << "at rest";
  const Joints crowding{0.0, 0.0, -0.3, 0.0};
  const ArmPoints arm = forward(machine, q);
  const double r = arm.tip.r - arm.stick_pin.r, z = arm.tip.z - arm.stick_pin.z, length = std::hypot(r, z);
  const PlaneForce against{-z / length * 30e3, r / length * 30e3};  // crowding moves the tip along (z, -r)
  EXPECT_NEAR(resistance(machine, q, crowding, against), 30e3, 300.0);
  EXPECT_NEAR(resistance(machine, q, crowding, {-against.r, -against.z}), -30e3, 300.0);
}

TEST(DigFill, LearnsWhatAnImpulseBrings) {
  DigFill fill;
  fill.begin();
  for (int k = 0; k < 200; ++k) fill.add(50e3, 0.01);
  EXPECT_FALSE(fill.known());
  fill.learn(1000.0, 1600.0);
  ASSERT_TRUE(fill.known());
  EXPECT_NEAR(fill.kg(), 1000.0, 1e-6);
  fill.begin();
  for (int k = 0; k < 300; ++k) fill.add(50e3, 0.01);
  EXPECT_NEAR(fill.kg(), 1500.0, 1e-6);
  for (int k = 0; k < 300; ++k) fill.add(2e3, 0.01);
  EXPECT_NEAR(fill.kg(), 1500.0, 1e-6) << "noise is no soil";
}

// A soil that brings 12 kg per kN s, a bucket of 1600 kg: after one dig that went on with a full bucket the next ones come to an end soon after it is full.
TEST(DigFill, FullBucketsEndSooner) {
  constexpr double brings = 12e-3, most = 1600.0;
  DigFill fill;
  fill.begin();
  for (int k = 0; k < 600; ++k) fill.add(50e3, 0.01);
  fill.learn(most, most);  // 3.6 t had been moved
  double sum = 0.0;
  constexpr int settling = 30, passes = 40;
  for (int pass = 0; pass < passes; ++pass) {
    fill.begin();
    double moved = 0.0;
    while (fill.kg() < 1550.0) {
      fill.add(50e3, 0.01);
      moved += brings * 50e3 * 0.01;
    }
    fill.learn(std::min(most, moved), most);
    if (pass < settling) continue;
    EXPECT_GT(moved, 1430.0) << "pass " << pass;
    EXPECT_LT(moved, 1700.0) << "pass " << pass;
    sum += moved / (passes - settling);
  }
  EXPECT_GT(sum, 1450.0);
}

// Some of a full one is lost on its way up: what comes up with nine tenths is taken for full, with less for not full.
TEST(DigFill, ABucketThatLostATenthOnItsWayUpWasFull) {
  constexpr double most = 1600.0;
  for (const auto& [share, full] : {std::pair{0.92, true}, {0.88, false}}) {
    DigFill fill;
    for (int pass = 0; pass < 2; ++pass) {
      fill.begin();
      for (int k = 0; k < 400; ++k) fill.add(50e3, 0.01);
      fill.learn(share * most, most);
    }
    const double seen = share * most / fill.impulse();
    if (full) EXPECT_GT(fill.kg_per_impulse(), 1.02 * seen);
    else EXPECT_NEAR(fill.kg_per_impulse(), seen, 1e-9);
  }
}

TEST(DigFill, WithoutForceNothingIsLearned) {
  DigFill fill;
  fill.begin();
  fill.learn(1500.0, 1600.0);
  EXPECT_FALSE(fill.known());
}

}  // namespace
}  // namespace berm::app
