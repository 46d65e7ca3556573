// What falls beside the bed while a bucket is carried over its wall and poured, from a weight that is noisy and comes in every cycle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "app/pour_watch.hpp"
#include "app_bench/bench_machine.hpp"
#include "app_bench/bench_site.hpp"
#include "app_bench/events.hpp"
#include "app_bench/loading.hpp"

namespace {

using namespace berm::app;

constexpr double cycle = 0.01, full_kg = 1600.0;

struct Pour {
  double carried = 1600.0;
  double rests_s = 2.0;     // level, on the way
  double beside_s = 0.5;    // then it slides this long before the lip is over the bed; negative: so long before it slides the lip is there
  double per_s = 200.0;     // kg that slide in a second
  double noise_kg = 75.0;   // of one cycle's weight, evenly to either side
};

PourWatch watched(const Pour& pour, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-pour.noise_kg, pour.noise_kg);
  PourWatch watch(full_kg);
  watch.begin();
  double kg = pour.carried;
  for (double t = 0.0; t < pour.rests_s + 5.0; t += cycle) {
    const bool rests = t < pour.rests_s, beside = t < pour.rests_s + pour.beside_s;
    if (!rests) kg = std::max(0.0, kg - (beside ? pour.per_s : 800.0) * cycle);
    watch.step({std::max(0.0, kg + noise(random)), rests, beside ? 1.0 : 0.0});
  }
  return watch;
}

TEST(PourWatch, CountsWhatLeftTheBucketBeforeItsLipWasOverTheBed) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const PourWatch watch = watched({}, seed);
    ASSERT_TRUE(watch.carried_known());
    EXPECT_NEAR(watch.carried_kg(), 1600.0, 15.0) << "seed " << seed;
    EXPECT_NEAR(watch.beside_kg(), 100.0, 45.0) << "seed " << seed;
    EXPECT_NEAR(watch.booked_beside_kg(true), 1.3 * watch.beside_kg(), 1e-9) << "what falls off the heap meanwhile no lip shows";
    EXPECT_NEAR(watch.booked_beside_kg(false), watch.beside_kg(), 1e-9) << "there is no heap yet";
  }
}

TEST(PourWatch, WhatFallsBeyondTheBedAtTheEndCountsToo) {
  PourWatch watch(full_kg);
  watch.begin();
  double kg = 1500.0;
  for (int k = 0; k < 600; ++k) {
    if (k >= 200) kg = std::max(0.0, kg - 6.0);
    watch.step({kg, k < 200, kg < 120.0 ? 1.0 : 0.0});
  }
  EXPECT_NEAR(watch.beside_kg(), 105.0, 15.0);
}

TEST(PourWatch, NoiseIsNoSpill) {
  for (unsigned seed = 1; seed <= 50; ++seed) EXPECT_EQ(watched({.beside_s = -0.3}, seed).booked_beside_kg(true), 0.0) << "seed " << seed;
}

// The weight dips for a while, with the bucket tilted already and not over the bed yet. What comes back had not left; what had left before, or leaves with it, does not
// come back.
TEST(PourWatch, AWeightThatRisesAgainHasNotLeftTheBucket) {
  for (const double fell_kg : {0.0, 90.0})
    for (const double dip_kg : {0.0, 120.0}) {
      PourWatch watch(full_kg);
      watch.begin();
      double kg = 1500.0;
      const auto pour = [&](int cycles, double each, double dip, bool rests, double beside) {
        for (int k = 0; k < cycles; ++k) watch.step({(kg -= each) - dip, rests, beside});
      };
      pour(200, 0.0, 0.0, true, 1.0);
      pour(20, 0.0, 0.5 * dip_kg, false, 1.0);
      pour(30, fell_kg / 30.0, dip_kg, false, 1.0);
      pour(20, 0.0, 0.0, false, 0.5);
      pour(200, 7.0, 0.0, false, 0.0);
      EXPECT_NEAR(watch.beside_kg(), fell_kg > 0.0 ? fell_kg - 16.0 : 0.0, 10.0) << "fell " << fell_kg << ", dip " << dip_kg;
    }
}

// Half of the load leaves the bucket while its weight is unknown, and most of that over the bed. What is seen to leave it later goes by where its lip is then.
TEST(PourWatch, WhatLeavesItUnseenIsBookedByWhereTheLipWasMeanwhile) {
  for (const int beside_cycles : {0, 6, 30})
    for (const double later_kg : {0.0, 140.0}) {
      PourWatch watch(full_kg);
      watch.begin();
      double kg = 1500.0;
      for (int k = 0; k < 200; ++k) watch.step({kg, true, 1.0});
      for (int k = 0; k < 26; ++k) watch.step({kg, false, 1.0});  // of the last block six cycles
      for (int k = 0; k < 100; ++k) {
        kg -= 7.0;
        watch.step({-1.0, false, k < beside_cycles ? 1.0 : 0.0});
      }
      for (int k = 0; k < 60; ++k) watch.step({kg -= 7.0, false, 0.0});
      for (int k = 0; k < 20; ++k) watch.step({kg, false, 1.0});
      for (int k = 0; k < 20; ++k) watch.step({kg -= later_kg / 20.0, false, 1.0});
      const double gap_kg = 738.5, cycles = 116.0;  // to the middle of the block after it
      EXPECT_NEAR(watch.beside_kg(), gap_kg * (6.0 + beside_cycles) / cycles + later_kg - 16.0, 20.0) << beside_cycles << ", later " << later_kg;
    }
}

// On the way to the truck nothing slides, so how long that took says nothing of where the load fell.
TEST(PourWatch, AWeightThatIsUnknownAtRestAndUntilItPoursIsNotBookedByTheWayThere) {
  PourWatch watch(full_kg);
  watch.begin();
  double kg = 1500.0;
  for (int k = 0; k < 100; ++k) watch.step({kg, true, 1.0});
  for (int k = 0; k < 300; ++k) watch.step({-1.0, true, 1.0});
  for (int k = 0; k < 100; ++k) {
    kg -= 7.0;
    watch.step({-1.0, false, 0.0});
  }
  for (int k = 0; k < 60; ++k) watch.step({kg -= 7.0, false, 0.0});
  EXPECT_EQ(watch.beside_kg(), 0.0);
}

struct Stopped {
  explicit Stopped(int pours_cycles) {
    watch.begin();
    pour(200, 0.0, true, 1.0);
    pour(pours_cycles, 6.0, false, 0.0);
    kg -= 400.0;  // while it stood, open over the bed
    watch.pause(true);
  }
  void pour(int cycles, double each, bool rests, double beside) {
    for (int k = 0; k < cycles; ++k) watch.step({kg -= each, rests, beside});
  }
  PourWatch watch{full_kg};
  double kg = 1500.0;
};

// Stopped amid the pour, which goes on into the bed meanwhile; then the bucket stands open beside the bed, and is brought back level: none of that is spilt. What
// falls beside later counts.
TEST(PourWatch, WhatLeavesItDuringAStopIsNotTakenForSpilt) {
  for (const double later_beside : {0.0, 1.0}) {
    Stopped run(50);
    run.pour(20, 0.0, false, 1.0);
    for (int k = 0; k < 100; ++k) run.watch.pause(true);
    run.pour(100, 0.0, true, 0.0);
    EXPECT_EQ(run.watch.beside_kg(), 0.0);
    run.pour(60, 6.0, false, later_beside);
    EXPECT_NEAR(run.watch.beside_kg(), later_beside * 344.0, later_beside * 45.0);
  }
}

// What it carried is what it carried before, also where it was stopped as soon as it began to pour.
TEST(PourWatch, WhatAStopHasLeftInItIsNotWhatItCarried) {
  for (const int poured_cycles : {5, 50}) {
    Stopped run(poured_cycles);
    run.pour(300, 0.0, true, 0.0);
    EXPECT_NEAR(run.watch.carried_kg(), 1500.0, 1.0) << poured_cycles;
  }
}

TEST(PourWatch, AnEmptyBucketAndOneThatWasNotSeenAtRestSayNothing) {
  EXPECT_FALSE(watched({.carried = 0.0}, 1).carried_known());
  const PourWatch unseen = watched({.rests_s = 0.3}, 1);
  EXPECT_FALSE(unseen.carried_known());
  EXPECT_EQ(unseen.beside_kg(), 0.0);
  EXPECT_EQ(PourWatch(full_kg).beside_kg(), 0.0);
}

// What is lifted after a pour, as a bucket that keeps a rest, is not what was carried there.
TEST(PourWatch, TheCarriedLoadIsThatBeforeTheFirstSlide) {
  PourWatch watch(full_kg);
  watch.begin();
  for (int k = 0; k < 100; ++k) watch.step({1400.0, true, 0.0});
  for (int k = 0; k < 100; ++k) watch.step({1400.0 - 5.0 * k, false, 0.0});
  for (int k = 0; k < 200; ++k) watch.step({900.0, true, 1.0});
  EXPECT_NEAR(watch.carried_kg(), 1400.0, 1e-9);
  EXPECT_EQ(watch.beside_kg(), 0.0);
}

TEST(PourWatch, AStreamIsBesideTheBedShortOfTheWallAndBeyondIt) {
  const MachineModel machine = berm::app_bench::zx200();
  const TruckBed bed = berm::app_bench::bench_bed();
  const double bearing = std::atan2(bed.centre_y, bed.centre_x), middle = std::hypot(bed.centre_x, bed.centre_y);
  const auto share = [&](double r, double swing_angle) {
    auto q = inverse_tip(machine, {r, 2.5}, radians(-120.0));
    EXPECT_TRUE(q) << r;
    if (!q) return -1.0;
    (*q)[swing] = swing_angle;
    return share_beside(machine, bed, *q, 0.5);
  };
  EXPECT_EQ(share(middle, bearing), 0.0);
  EXPECT_EQ(share(middle - bed.width, bearing), 1.0);
  EXPECT_EQ(share(middle, bearing - radians(70.0)), 1.0) << "on the way there";
}

// Each bucket is tilted by hand short of the wall and loses as much there. What slides off a heap meanwhile is booked on top once there is one: from six tenths of
// a truck's load on.
TEST(PourWatch, TheTruckHasAHeapFromSixTenthsOfItsLoadOn) {
  constexpr double lost_kg = 200.0, noise_kg = 16.0, target_kg = 18000.0;
  constexpr int tilted_cycles = 40;
  const berm::app_bench::Events events;
  berm::app_bench::Loading run(1, berm::app_bench::start_pose(), events.fd());
  run.plant.has_pressures = true;
  const TruckBed bed = berm::app_bench::bench_bed();
  int tilted = 0;
  const auto passes = [&events] { return events.named("pass"); };
  const auto loaded_kg = [](const std::vector<nlohmann::json>& all) { return all.empty() ? 0.0 : all.back().at("loaded_kg").get<double>(); };
  for (long k = 0; run.seconds < 400.0 && (k % 100 != 0 || loaded_kg(passes()) < 0.8 * target_kg); ++k) {
    run.step();
    if (run.last.phase == BERM_PHASE_DIG) tilted = 0;
    const Joints& q = run.plant.angle();
    const bool arrives = run.last.phase == BERM_PHASE_SWING_TO_TRUCK && q[swing] > radians(60.0) && share_beside(run.machine, bed, q, 0.5) == 1.0;
    if (!arrives || tilted >= tilted_cycles) continue;
    run.plant.put(bucket, q[bucket] + radians(-158.0) - forward(run.machine, q).bucket_attitude);
    run.plant.take(lost_kg / tilted_cycles);
    ++tilted;
  }
  int onto_floor = 0, onto_heap = 0;
  double had_kg = 0.0;
  for (const nlohmann::json& pass : passes()) {
    const bool heap = had_kg > 0.6 * target_kg;
    had_kg = pass.at("loaded_kg");
    if (pass.at("pass") < 4) continue;  // what a bucket weighs out there is learned first
    ++(heap ? onto_heap : onto_floor);
    EXPECT_NEAR(pass.at("beside_kg").get<double>(), (heap ? 1.3 : 1.0) * (lost_kg - noise_kg), 12.0) << pass;
  }
  EXPECT_GE(onto_floor, 3);
  EXPECT_GE(onto_heap, 2);
}

}  // namespace
