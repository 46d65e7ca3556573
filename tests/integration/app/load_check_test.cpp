// A bucket that is weighed before it opens over the bed, and of what is too much pours a part only: on a bucket that pours as it tilts, and a weighing that
// is blind at first, noisy, and comes ten times a second.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "app/load_check.hpp"
#include "motion/angles.hpp"

namespace {

using namespace berm::app;

constexpr double target = 4500.0, full_bucket = 1560.0, cycle = 0.01;

struct Bucket {
  explicit Bucket(double mass, unsigned seed) : kg(mass), random(seed) {}

  // What rests at a tilt: a full bucket loses from 20 degrees on; the rest slides within a third of a second.
  void step(double tilt_rate) {
    attitude += std::max(0.0, tilt_rate) * cycle;
    const double rests = 1608.0 * std::clamp(1.0 - (degrees(attitude) + 158.0) / 100.0, 0.0, 1.0);
    if (kg > rests) kg -= (kg - rests) * cycle / 0.35;
  }
  double weighed(int k) {
    if (k % 10 == 0) last = std::max(0.0, kg * (1.0 + 0.02 * noise(random)) + 10.0 * noise(random));
    return last;
  }

  double kg, attitude = radians(-178.0), last = 0.0;
  std::mt19937 random;
  std::uniform_real_distribution<double> noise{-1.0, 1.0};
};

struct Outcome { double poured = 0.0, lifted = 0.0, seconds = 0.0; bool tilted = false, keeps = false; };

// lifted_s: until then it is on its way up. pressures: what it weighs by them is known, too, a hundred times a second.
Outcome run(double loaded, double in_bucket, unsigned seed, double blind_s = 3.0, double over_bed_s = 5.0, double lifted_s = 0.0, bool pressures = false, double truck = target, double beside_kg = 0.0) {
  TruckFill fill(truck, full_bucket);
  fill.add_pass(loaded, 0.0);
  Bucket bucket(in_bucket, seed);
  LoadCheck check;
  check.begin(0.0, fill.must_weigh(1600.0));
  const ProgressLog log(-1);
  Outcome out;
  int k = 0;
  for (; !check.passed() && k < 6000; ++k) {
    const double t = k * cycle;
    const double pressed = pressures ? bucket.kg + 16.0 * bucket.noise(bucket.random) : -1.0;
    const double rate = check.step({t, t < blind_s ? -1.0 : bucket.weighed(k), bucket.attitude, t >= over_bed_s, 0.0, t < lifted_s, pressed, pressures ? in_bucket : -1.0, beside_kg}, fill, log);
    if (rate > 0.0) {
      EXPECT_GE(t, over_bed_s) << "it is not over the bed yet";
      out.tilted = true;
    }
    bucket.step(rate);
  }
  for (int later = 0; later < 100; ++later) bucket.step(0.0);  // what slides comes to rest
  out.poured = in_bucket - bucket.kg;
  out.keeps = check.keeps_rest();
  out.lifted = check.lifted_kg();
  out.seconds = k * cycle;
  return out;
}

TEST(LoadCheck, EarlyPassesAreNotHeldUp) {
  const Outcome out = run(0.0, 1600.0, 1);
  EXPECT_EQ(out.seconds, 0.0);
  EXPECT_LT(out.lifted, 0.0) << "not weighed";
}

TEST(LoadCheck, OfWhatIsTooMuchAPartIsPoured) {
  for (unsigned seed = 1; seed <= 20; ++seed)
    for (const double loaded : {3050.0, 3300.0, 3900.0, 4300.0}) {
      const Outcome out = run(loaded, 1600.0, seed);
      EXPECT_TRUE(out.tilted && out.keeps);
      EXPECT_NEAR(out.lifted, 1600.0, 30.0);
      EXPECT_GE(loaded + out.poured, 0.98 * target) << loaded << " loaded, seed " << seed;
      EXPECT_LE(loaded + out.poured, 1.0 * target) << loaded << " loaded, seed " << seed;
      EXPECT_LT(out.seconds, 12.0);
    }
}

// Shaken off a full bucket before its lip was over the bed.
TEST(LoadCheck, AsMuchMoreIsPouredAsFellBeside) {
  constexpr double beside_kg = 60.0;
  double more = 0.0;
  constexpr unsigned seeds = 20;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const Outcome all_in = run(3050.0, 1600.0, seed), some_beside = run(3050.0, 1600.0, seed, 3.0, 5.0, 0.0, false, target, beside_kg);
    EXPECT_TRUE(some_beside.keeps);
    more += (some_beside.poured - all_in.poured) / seeds;
  }
  EXPECT_NEAR(more, beside_kg, 10.0);
}

TEST(LoadCheck, WhatFitsGoesWholeAsSoonAsItIsWeighed) {
  const Outcome out = run(2900.0, 1550.0, 5, 2.0);
  EXPECT_FALSE(out.tilted || out.keeps);
  EXPECT_NEAR(out.seconds, 2.5, 0.1);
}

TEST(LoadCheck, PoursOnlyOverTheBed) {
  const Outcome out = run(3300.0, 1600.0, 3, 0.0, 9.0);
  EXPECT_TRUE(out.tilted);
  EXPECT_GT(out.seconds, 9.0);
}

// A small load lies still in its bucket up to a steep tilt: it is not waited for at the speed at which the last soil is poured.
TEST(LoadCheck, AHandfulOfASmallLoadIsPouredWithoutAWaitForItToSlide) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Outcome out = run(4250.0, 700.0, seed);
    EXPECT_TRUE(out.keeps);
    EXPECT_NEAR(4250.0 + out.poured, TruckFill::part_share * target, 0.02 * target) << "seed " << seed;
    EXPECT_LT(out.seconds, 12.0) << "seed " << seed;
  }
}

// Of so little a part only runs out at a steep tilt.
// It lies still up to a steep tilt, which is gone to at once; at the pace of what may slide that alone would take 5 s.
TEST(LoadCheck, ASmallLoadIsTiltedFastUntilItMaySlide) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Outcome out = run(target - 350.0, 600.0, seed);
    EXPECT_TRUE(out.keeps);
    EXPECT_NEAR(out.poured, 290.0, 75.0) << "seed " << seed;
    EXPECT_LT(out.seconds, 5.0 + 5.0) << "seed " << seed;
  }
}

// What goes on sliding when the tilt ends is less of it.
TEST(LoadCheck, APartIsPouredFasterIntoALargeTruck) {
  constexpr double large = 18000.0, over_bed_s = 5.0;
  for (const double lacks : {600.0, 1000.0, 1400.0}) {
    double mean_s = 0.0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const double loaded = TruckFill::part_share * large - lacks;
      const Outcome out = run(loaded, 1600.0, seed, 3.0, over_bed_s, 0.0, false, large);
      EXPECT_TRUE(out.keeps);
      EXPECT_NEAR(loaded + out.poured, TruckFill::part_share * large, 0.004 * large) << lacks << " kg, seed " << seed;
      mean_s += (out.seconds - over_bed_s) / 20.0;
    }
    if (lacks == 600.0) {
      EXPECT_LT(mean_s, 2.4) << "2.64 at a small truck's pace";
    }
  }
}

TEST(LoadCheck, OfAHandfulTooMuchAPartIsPouredToo) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Outcome out = run(4294.0, 395.0, seed);
    EXPECT_TRUE(out.tilted);
    EXPECT_LE(4294.0 + out.poured, 1.0 * target) << "seed " << seed;
  }
}

// What is 28 kg more than it is to keep may yet be on its way out, and be it: of a small truck 28 kg are a lot.
TEST(LoadCheck, OfASmallTruckLittleIsLeftToWhatIsOnItsWayOut) {
  for (const double truck : {target, 18000.0}) {
    TruckFill fill(truck, full_bucket);
    fill.add_pass(TruckFill::part_share * truck - 546.0, 0.0);
    LoadCheck check;
    check.begin(0.0, true);
    double rate = -1.0;
    for (int k = 0; k < 800 && !check.passed(); ++k)
      rate = check.step({.time_s = k * cycle, .payload_kg = k < 300 ? 900.0 : 382.0, .attitude = radians(-100.0), .over_bed = k >= 200}, fill, ProgressLog(-1));
    EXPECT_EQ(check.passed(), truck > target);
    EXPECT_EQ(rate > 0.0, truck == target);
  }
}

TEST(LoadCheck, WithoutAWeighingItGoesInTheEnd) {
  const Outcome out = run(3300.0, 1600.0, 3, 1e9);
  EXPECT_FALSE(out.tilted);
  EXPECT_LT(out.lifted, 0.0);
  EXPECT_LT(out.seconds, 7.0);
}

// The soil held it for long, and the weighing is blind until three seconds after it: a truck was overloaded by 5 % because it was not waited for.
TEST(LoadCheck, AWeighingThatComesLateAfterALongWayUpIsWaitedFor) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Outcome out = run(4300.0, 1600.0, seed, 8.5, 9.0, 5.5);
    EXPECT_NEAR(out.lifted, 1600.0, 30.0);
    EXPECT_LE(4300.0 + out.poured, 1.0 * target) << "seed " << seed;
  }
}

TEST(LoadCheck, WithoutAWeighingThePressuresSayWhatItHolds) {
  for (unsigned seed = 1; seed <= 20; ++seed)
    for (const double loaded : {3050.0, 3900.0, 4300.0}) {
      const Outcome out = run(loaded, 1600.0, seed, 1e9, 5.0, 0.0, true);
      EXPECT_TRUE(out.tilted && out.keeps);
      EXPECT_GE(loaded + out.poured, 0.98 * target) << loaded << " loaded, seed " << seed;
      EXPECT_LE(loaded + out.poured, 1.0 * target) << loaded << " loaded, seed " << seed;
      EXPECT_LT(out.seconds, 14.0);
    }
}

TEST(LoadCheck, AWeighingThatFailsDoesNotHoldItForEver) {
  TruckFill fill(target, full_bucket);
  fill.add_pass(3300.0, 0.0);
  LoadCheck check;
  check.begin(0.0, true);
  const ProgressLog log(-1);
  double t = 0.0;
  for (; !check.passed() && t < 60.0; t += cycle) check.step({t, t < 0.02 ? 1600.0 : -1.0, radians(-178.0), true}, fill, log);
  EXPECT_LT(t, 21.0);
}

// The kernel may stop the machine meanwhile: the check goes on afterwards.
TEST(LoadCheck, AStopDoesNotEndIt) {
  TruckFill fill(target, full_bucket);
  fill.add_pass(3300.0, 0.0);
  LoadCheck check;
  check.begin(0.0, true);
  const ProgressLog log(-1);
  check.step({0.01, -1.0, radians(-178.0), true}, fill, log);
  double rate = 0.0;
  for (double t = 40.0; t < 42.0; t += cycle) rate = std::max(rate, check.step({t, 1600.0, radians(-178.0), true}, fill, log));
  EXPECT_FALSE(check.passed());
  EXPECT_GT(rate, 0.0);
}

}  // namespace
