// The scanner that leads a swing: out at its trigger angle when the swing begins, and ahead of it at each moment from then on.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "app_bench/bench_machine.hpp"
#include "perception/scan_scheduler.hpp"

namespace {

using namespace berm::app;

constexpr double cycle = 0.01;

// Passes between a dig straight ahead and a truck, with the pans as the requests have them.
struct Scanning {
  explicit Scanning(double truck_side) : machine(berm::app_bench::zx200()), scheduler(machine), table(machine), side(truck_side), truck(side * radians(94.0)) {
    while (!scheduler.full_sweep_done()) step(BERM_PHASE_DIG, 0.0, 0.0);
  }
  void step(std::uint16_t phase, double angle, double speed, double begins_in_s = 1e9) {
    ++cycles;
    const auto before = pan;
    const auto request = scheduler.step(phase, 0.0, truck, angle, speed, pan, false, {begins_in_s, machine.braking.reach.front()});
    for (std::size_t i = 0; i < 2; ++i) {
      const double turn = std::fabs(std::copysign(std::min(request[i].rate, std::fabs(request[i].goal - pan[i]) / cycle), request[i].goal - pan[i]) + speed);
      fastest_turn = std::max(fastest_turn, turn);
      pan[i] += std::clamp(request[i].goal - pan[i], -request[i].rate * cycle, request[i].rate * cycle);
      const double from = before[i] + angle - speed * cycle, to = pan[i] + angle;
      for (std::size_t a = 0; a < seen.size(); ++a)
        if (const double bearing = side * radians(static_cast<double>(a)); (i == 0) == (side > 0.0) && (from - bearing) * (to - bearing) <= 0.0) seen[a] = cycles;
      for (std::size_t a = 0; a < way_seen.size(); ++a)
        if (const double bearing = truck - side * radians(static_cast<double>(a)); (i == 0) == (side < 0.0) && (from - bearing) * (to - bearing) <= 0.0) way_seen[a] = cycles;
    }
  }
  // Before a swing, for so long, told when it will begin.
  void wait(std::uint16_t phase, double angle, double seconds, double then_s = 0.0) {
    for (double left = seconds; left > 0.0; left -= cycle) step(phase, angle, 0.0, left + then_s);
  }
  // As fast as the machine swings; the least by which the leading pan is ahead of what the speed needs.
  double swing(std::uint16_t phase, double from, double to) {
    return swing(phase, from, to, [](double, double) {});
  }
  template <class Visit>
  double swing(std::uint16_t phase, double from, double to, Visit visit) {
    constexpr double fastest = radians(38.75), speeds_up = radians(20.0), brakes = radians(15.0);
    const double sense = to > from ? 1.0 : -1.0, way = std::fabs(to - from);
    double gone = 0.0, speed = 0.0, least = 1e9;
    while (gone < way - radians(0.1)) {
      speed = std::min({speed + speeds_up * cycle, fastest, std::max(radians(0.5), std::sqrt(2.0 * brakes * (way - gone)))});
      gone += speed * cycle;
      step(phase, from + sense * gone, sense * speed);
      visit(gone, speed);
      const std::size_t leads = sense > 0.0 ? 0 : 1;
      least = std::min(least, sense * pan[leads] - table.required(leads, speed, machine.braking.reach.front()));
    }
    return least;
  }

  MachineModel machine;
  ScanScheduler scheduler;
  LookaheadTable table;
  double side, truck;
  std::array<double, 2> pan{};
  double fastest_turn = 0.0;  // turn of a scanline in the base frame
  std::vector<int> way_seen = std::vector<int>(110, -1);  // by the scanner that leads the swing back: when last, by the degrees from the truck on the way back
  int cycles = 0;
  std::vector<int> seen = std::vector<int>(180, -1);  // by the scanner on the truck's side: when last, by the bearing towards the truck, degrees
};

TEST(ScanLead, ItIsAtTheTriggerAngleWhenTheSwingBeginsAndAheadOfItFromThenOn) {
  for (const double side : {1.0, -1.0})
    for (double dig_s = 0.9; dig_s < 8.0; dig_s += 0.35) {
      Scanning s(side);
      for (int pass = 0; pass < 4; ++pass) {
        s.wait(BERM_PHASE_DIG, 0.0, pass == 0 ? 3.0 : dig_s, 0.9);  // wherever the sweep of the whole range had it
        s.wait(BERM_PHASE_LIFT, 0.0, 0.9);
        const Lead out = s.scheduler.lead();
        EXPECT_TRUE(out.triggered) << side << ": a dig of " << dig_s << " s";
        EXPECT_GE(out.ahead, out.needed.trigger) << side << ": a dig of " << dig_s << " s";
        EXPECT_GT(s.swing(BERM_PHASE_SWING_TO_TRUCK, 0.0, s.truck), 0.0) << side << ": to the truck after a dig of " << dig_s << " s";
        s.wait(BERM_PHASE_DUMP, s.truck, 1.2 + 0.25 * dig_s);
        s.swing(BERM_PHASE_SWING_TO_DIG, s.truck, 0.0);
      }
    }
}

// On the swing back the sweeps turn outward again where the kernel's box will soon end, and no farther out: who comes onto the way is looked at as late as he can be for the machine to stand
// before him.
TEST(ScanLead, OnTheSwingBackItLooksWhereTheSpeedNeedsItAndNoFartherOut) {
  for (const double side : {1.0, -1.0})
    for (const double speed : {0.1, 0.2, 0.3, 0.4}) {
      Scanning s(side);
      const std::size_t leads = side > 0.0 ? 1 : 0;
      const double needs = s.table.required(leads, speed + 0.1, s.machine.braking.reach.front());
      double inmost = 1e9, outmost = 0.0;
      for (int i = 0; i < 1600; ++i) {
        s.step(BERM_PHASE_SWING_TO_DIG, s.truck - side * 0.2, -side * speed);
        if (i < 800) continue;
        const double ahead = -side * s.pan[leads];
        inmost = std::min(inmost, ahead);
        outmost = std::max(outmost, ahead);
      }
      EXPECT_NEAR(inmost, std::max(needs, radians(12.0)), radians(3.0)) << side << ", " << speed << " rad/s";
      EXPECT_NEAR(outmost, std::max(needs, radians(12.0)) + radians(40.0), radians(3.0)) << side << ", " << speed << " rad/s";
      EXPECT_LE(s.fastest_turn, radians(40.0));
    }
}

// While the bucket pours the way back is swept over and over, so that after a long pour none of its first 70 degrees was seen longer ago than a sweep out and in takes.
TEST(ScanLead, TheFirstOfTheWayBackIsSweptWhileTheBucketPours) {
  for (const double side : {1.0, -1.0})
    for (double pour = 4.2; pour < 8.0; pour += 0.1) {
      Scanning s(side);
      s.wait(BERM_PHASE_DIG, 0.0, 4.0, 0.9);
      s.wait(BERM_PHASE_LIFT, 0.0, 0.9);
      s.swing(BERM_PHASE_SWING_TO_TRUCK, 0.0, s.truck);
      s.wait(BERM_PHASE_DUMP, s.truck, pour);
      for (std::size_t a = 7; a < 70; ++a) EXPECT_LT((s.cycles - s.way_seen[a]) * cycle, 4.2) << side << ": " << a << " degrees, " << pour << " s";
    }
}

// Under the boom when a dig ends sooner than expected: the swing may not begin until it has come out.
TEST(ScanLead, ASwingMayNotBeginBeforeIt) {
  for (const double side : {1.0, -1.0}) {
    Scanning s(side);
    s.pan[side > 0.0 ? 0 : 1] = side * radians(-10.0);
    s.step(BERM_PHASE_LIFT, 0.0, 0.0, 0.0);
    EXPECT_FALSE(s.scheduler.lead().triggered);
    double waited = 0.0;
    for (; !s.scheduler.lead().triggered && waited < 5.0; waited += cycle) s.step(BERM_PHASE_LIFT, 0.0, 0.0, 0.0);
    EXPECT_NEAR(waited, (s.scheduler.lead().needed.trigger + radians(10.0)) / ScanScheduler::azimuth_rate, 0.1);
    EXPECT_GT(s.swing(BERM_PHASE_SWING_TO_TRUCK, 0.0, s.truck), 0.0);
  }
}

// Not only out of the way: in a long dig it sees the ground under the boom, too, and what the swing passes first.
TEST(ScanLead, InALongDigItComesInUnderTheBoom) {
  for (const double side : {1.0, -1.0}) {
    Scanning s(side);
    double inmost = 1e9;
    for (double left = 9.0; left > 0.0; left -= cycle) {
      s.step(BERM_PHASE_DIG, 0.0, 0.0, left);
      inmost = std::min(inmost, s.scheduler.lead().ahead);
    }
    EXPECT_LT(inmost, radians(-30.0)) << side;
  }
}

// After short pours, too: the scanner begins towards the bed's nearer end.
TEST(ScanLead, AllOfTheBedIsSeenOnTheSwingBackItself) {
  for (const double side : {1.0, -1.0})
    for (double pour_s = 0.5; pour_s < 3.0; pour_s += 0.1) {
      Scanning s(side);
      for (int pass = 0; pass < 2; ++pass) {
        s.wait(BERM_PHASE_DIG, 0.0, 2.5, 0.9);
        s.wait(BERM_PHASE_LIFT, 0.0, 0.9);
        s.swing(BERM_PHASE_SWING_TO_TRUCK, 0.0, s.truck);
        s.wait(BERM_PHASE_DUMP, s.truck, pour_s);
        const int turns = s.cycles;
        s.swing(BERM_PHASE_SWING_TO_DIG, s.truck, 0.0);
        for (std::size_t a = 71; a <= 117; ++a) EXPECT_GT(s.seen[a], turns) << side << ": " << a << " degrees off, " << pour_s << " s of pouring";
      }
    }
}

// A swing that brakes harder is fast for longer on a short way: the table is made anew.
TEST(ScanLead, WhatAnEmptySwingsLandingsTeachChangesWhatItNeeds) {
  Scanning s(1.0);
  const auto needed = [&] {
    s.step(BERM_PHASE_SWING_TO_DIG, radians(45.0), 0.0);
    return s.scheduler.lead().needed.lookahead;
  };
  const double before = needed();
  s.scheduler.learn_braking(0.9);
  EXPECT_GT(needed(), before + radians(0.5));
}

}  // namespace
