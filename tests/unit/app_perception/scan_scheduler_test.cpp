#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "app_bench/bench_machine.hpp"
#include "perception/scan_scheduler.hpp"

namespace {

using namespace berm::app;

struct Pans {
  explicit Pans(const MachineModel& m, double truck_bearing = radians(96.0), double dig_bearing = 0.0) : machine(m), scheduler(m), truck(truck_bearing), dig(dig_bearing) {}
  void step(std::uint16_t phase, double swing_angle, double swing_speed, bool slowed = false) {
    const auto request = scheduler.step(phase, dig, truck, swing_angle, swing_speed, pan, slowed);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_GE(request[i].goal, machine.scanner[i].pan_low);
      EXPECT_LE(request[i].goal, machine.scanner[i].pan_high);
      EXPECT_GE(request[i].rate, 0.0);
      EXPECT_LE(request[i].rate, machine.scanner[i].pan_rate_max);
      const double move = std::clamp(request[i].goal - pan[i], -request[i].rate * 0.01, request[i].rate * 0.01);
      fastest = std::max(fastest, std::fabs(move / 0.01 + swing_speed));
      pan[i] += move;
      low[i] = std::min(low[i], pan[i] + swing_angle);
      high[i] = std::max(high[i], pan[i] + swing_angle);
    }
  }
  MachineModel machine;
  ScanScheduler scheduler;
  double truck, dig;
  std::array<double, 2> pan{}, low{1e9, 1e9}, high{-1e9, -1e9};
  double fastest = 0.0;
};

TEST(ScanScheduler, SweepsBothWholeRangesOnceWithinTenSeconds) {
  Pans pans(berm::app_bench::zx200());
  pans.scheduler.begin_full_sweep();
  double seconds = 0.0;
  while (!pans.scheduler.full_sweep_done() && seconds < 20.0) {
    pans.step(BERM_PHASE_DIG, 0.0, 0.0);
    seconds += 0.01;
  }
  EXPECT_LT(seconds, 10.0);
  EXPECT_LT(pans.low[0], radians(-16.0));
  EXPECT_GT(pans.high[0], radians(126.0));
  EXPECT_LT(pans.low[1], radians(-126.0));
  EXPECT_GT(pans.high[1], radians(16.0));
}

TEST(ScanScheduler, DuringTheDigTheComingSectorIsSeenEveryNineSeconds) {
  Pans pans(berm::app_bench::zx200());
  for (int k = 0; k < 2000; ++k) pans.step(BERM_PHASE_DIG, 0.0, 0.0);
  std::vector<double> seen(121, 0.0);
  double t = 0.0, worst = 0.0;
  for (int k = 0; k < 3000; ++k) {
    pans.step(BERM_PHASE_DIG, 0.0, 0.0);
    t += 0.01;
    seen[static_cast<std::size_t>(std::clamp(std::lround(degrees(pans.pan[0])), 0L, 120L))] = t;
    if (t > 9.0)
      for (int a = 3; a <= 117; ++a) worst = std::max(worst, t - seen[static_cast<std::size_t>(a)]);
  }
  EXPECT_LT(worst, 9.0);  // under half of what the kernel calls fresh
}

// What the truck recogniser needs: every bearing once, a scanline a degree, by a scanner that stands still afterwards.
TEST(ScanScheduler, WhatIsToBeSeenAnewIsOnTheSwingBackSeenBeyondTheDigFirst) {
  for (const double side : {1.0, -1.0}) {
    for (const std::uint16_t phase : {BERM_PHASE_SWING_TO_DIG, BERM_PHASE_DUMP}) {
      Pans pans(berm::app_bench::zx200(), side * radians(96.0));
      const std::size_t leads = side > 0.0 ? 1 : 0;
      const double far = side > 0.0 ? pans.machine.scanner[1].pan_low : pans.machine.scanner[0].pan_high, near = side > 0.0 ? pans.machine.scanner[1].pan_high : pans.machine.scanner[0].pan_low;
      // On its way away from there.
      pans.pan[leads] = 0.5 * (far + near);
      pans.scheduler.begin_full_sweep();
      while (std::fabs(pans.pan[leads] - far) > radians(5.0)) pans.step(BERM_PHASE_WAIT, 0.0, 0.0);
      while (std::fabs(pans.pan[leads] - far) < radians(60.0)) pans.step(BERM_PHASE_WAIT, 0.0, 0.0);
      pans.scheduler.begin_full_sweep();
      int to_far = 0;
      for (; std::fabs(pans.pan[leads] - far) > radians(2.0) && to_far < 2000; ++to_far) pans.step(phase, 0.0, 0.0);
      if (phase == BERM_PHASE_SWING_TO_DIG) EXPECT_LT(to_far, 200) << side;
      else EXPECT_GT(to_far, 500) << side << ": in its turn";
      for (int k = 0; k < 2000 && !pans.scheduler.full_sweep_done(); ++k) pans.step(phase, 0.0, 0.0);
      EXPECT_TRUE(pans.scheduler.full_sweep_done()) << side << ": and then the rest";
    }
  }
}

// How far from the dig a swing back still is, after a dump that was slowed for so many cycles and went on for some more, when it is seen what lies 27 degrees beyond the
// dig; negative: not seen. Then the rest of both ranges is. From over the truck a scanner reaches no farther than 24 degrees beyond.
double beyond_dig_seen_from(double side, int slow_cycles, int more_cycles) {
  const double over_truck = side * radians(94.0), dig = side * radians(-12.0), beyond = dig - side * radians(27.0);
  Pans pans(berm::app_bench::zx200(), over_truck, dig);
  const std::size_t trails = side > 0.0 ? 1 : 0;
  for (int k = 0; k < slow_cycles; ++k) pans.step(BERM_PHASE_DUMP, over_truck, 0.0, true);
  EXPECT_LE(pans.fastest, radians(40.0));
  for (int k = 0; k < more_cycles; ++k) pans.step(BERM_PHASE_DUMP, over_truck, 0.0);
  double angle = over_truck, speed = 0.0, seen_from = -1.0;
  while (side * (angle - dig) > 0.0 && seen_from < 0.0) {
    const double before = pans.pan[trails] + angle;
    speed = std::min(speed + radians(20.0) * 0.01, radians(45.0));
    angle -= side * speed * 0.01;
    pans.step(BERM_PHASE_SWING_TO_DIG, angle, -side * speed);
    if ((before - beyond) * (pans.pan[trails] + angle - beyond) <= 0.0) seen_from = side * (angle - dig);
  }
  for (int k = 0; k < 2000 && !pans.scheduler.full_sweep_done(); ++k) pans.step(BERM_PHASE_SWING_TO_DIG, angle, 0.0);
  EXPECT_TRUE(pans.scheduler.full_sweep_done());
  return seen_from;
}

// Wherever the sweep of the slow dump happened to be.
TEST(ScanScheduler, AfterASlowDumpWhatLiesBeyondTheDigIsSeenEarlyOnTheSwingBack) {
  for (const double side : {1.0, -1.0})
    for (int slow_cycles = 400; slow_cycles < 1400; slow_cycles += 25) {
      EXPECT_GT(beyond_dig_seen_from(side, slow_cycles, 130), radians(60.0)) << side << ", slow for " << slow_cycles << " cycles";
      EXPECT_GT(beyond_dig_seen_from(side, slow_cycles, 0), radians(45.0)) << side << ", slow for " << slow_cycles << " cycles, to its end";
    }
}

// One that stands on its swing back has seen all of its range a little later.
TEST(ScanScheduler, AfterASlowDumpASwingThatDoesNotComeIsNotWaitedFor) {
  Pans pans(berm::app_bench::zx200());
  for (int k = 0; k < 500; ++k) pans.step(BERM_PHASE_DUMP, radians(94.0), 0.0, true);
  int cycles = 0;
  for (; !pans.scheduler.full_sweep_done() && cycles < 3000; ++cycles) pans.step(BERM_PHASE_SWING_TO_DIG, radians(94.0), 0.0);
  EXPECT_LT(cycles, 1400);
}

// A swing to a dig that creeps at a tenth for all of its way, as while the kernel learns the ground: no ground that a pan reaches grows old.
TEST(ScanScheduler, OnASlowSwingToTheDigBothWholeRangesAreSeenAgainAndAgainBeyondTheDigFirst) {
  constexpr double speed = radians(4.0);
  for (const double side : {1.0, -1.0})
    for (int before = 400; before < 1400; before += 50) {
      const double over_truck = side * radians(94.0), dig = side * radians(-12.0);
      Pans pans(berm::app_bench::zx200(), over_truck, dig);
      const std::size_t trails = side > 0.0 ? 1 : 0;
      for (int k = 0; k < before; ++k) pans.step(BERM_PHASE_DUMP, over_truck, 0.0, true);
      std::array<std::vector<double>, 2> seen{std::vector<double>(300, 0.0), std::vector<double>(300, 0.0)};
      double worst = 0.0, seconds = 0.0, end_seen = -1.0;
      const double end = side > 0.0 ? pans.machine.scanner[trails].pan_low : pans.machine.scanner[trails].pan_high;
      for (double angle = over_truck; side * (angle - dig) > 0.0; angle -= side * speed * 0.01) {
        pans.step(BERM_PHASE_SWING_TO_DIG, angle, -side * speed, true);
        seconds += 0.01;
        if (end_seen < 0.0 && std::fabs(pans.pan[trails] - end) < radians(2.0)) end_seen = seconds;
        for (std::size_t i = 0; i < 2; ++i) {
          const int low = static_cast<int>(std::ceil(degrees(pans.machine.scanner[i].pan_low))), high = static_cast<int>(degrees(pans.machine.scanner[i].pan_high));
          seen[i][static_cast<std::size_t>(150 + std::lround(degrees(pans.pan[i])))] = seconds;
          for (int pan = low + 3; pan <= high - 3; ++pan) worst = std::max(worst, seconds - seen[i][static_cast<std::size_t>(150 + pan)]);
        }
      }
      EXPECT_GT(seconds, 26.0);
      EXPECT_LT(worst, 13.0) << side << ", slow for " << before << " cycles";
      EXPECT_GE(end_seen, 0.0);
      EXPECT_LT(end_seen, 5.0) << side << ", slow for " << before << " cycles: a range at 40 degrees a second";
    }
}

// The look on the way goes on while the swing creeps: the other scanner comes to the feet all the same.
TEST(ScanScheduler, OnASlowSwingToTheDigTheFeetAreSeenBesideALook) {
  const MachineModel machine = berm::app_bench::zx200();
  constexpr double speed = radians(4.0);
  for (const double side : {1.0, -1.0}) {
    const std::size_t looker = side > 0.0 ? 0 : 1, other = 1 - looker;
    const double waits = side * radians(20.0), one = side * radians(40.0), far = side * radians(150.0);
    for (double began = machine.scanner[other].pan_low; began <= machine.scanner[other].pan_high; began += radians(5.0)) {
      Pans pans(machine, side * radians(96.0), side * radians(-12.0));
      for (int k = 0; k < 2000; ++k) pans.step(BERM_PHASE_WAIT, waits, 0.0);
      pans.pan[other] = began;
      pans.scheduler.begin_look_on_the_way(looker, {std::min(one, far), std::max(one, far)});
      double seconds = 0.0;
      for (double angle = waits; side * (angle - pans.dig) > 0.0 && !pans.scheduler.feet_seen(); angle -= side * speed * 0.01, seconds += 0.01)
        pans.step(BERM_PHASE_SWING_TO_DIG, angle, -side * speed, true);
      EXPECT_TRUE(pans.scheduler.feet_seen()) << side << " " << degrees(began);
    }
  }
}

TEST(ScanScheduler, ALookSweepsItsSectorOnceAndSlowly) {
  Pans pans(berm::app_bench::zx200());
  const double swing_angle = radians(36.0);
  const PanSector bearings{radians(40.0), radians(150.0)};
  pans.scheduler.begin_look(0, bearings);
  double low = 1e9, high = -1e9, before = pans.pan[0], seconds = 0.0, other = pans.pan[1];
  int turns = 0;
  for (double way = 0.0; !pans.scheduler.look_done() && seconds < 20.0; seconds += 0.01) {
    pans.step(BERM_PHASE_WAIT, swing_angle, 0.0);
    const double step = pans.pan[0] - before;
    before = pans.pan[0];
    if (!pans.scheduler.look_sweeps()) continue;
    EXPECT_LE(std::fabs(step) / 0.01, ScanScheduler::look_rate + 1e-9);
    turns += step * way < 0.0 ? 1 : 0;
    if (step != 0.0) way = step;
    low = std::min(low, pans.pan[0] + swing_angle);
    high = std::max(high, pans.pan[0] + swing_angle);
  }
  ASSERT_TRUE(pans.scheduler.look_done());
  EXPECT_EQ(turns, 0);
  EXPECT_LT(low, bearings.low + radians(1.0));
  EXPECT_GT(high, bearings.high - radians(1.0));
  EXPECT_LT(seconds, 8.0);
  EXPECT_LT(pans.fastest, radians(50.0)) << "nor on the way to its beginning";
  EXPECT_NE(pans.pan[1], other) << "the other scanner goes on";
  const double stays = pans.pan[0];
  for (int k = 0; k < 100; ++k) pans.step(BERM_PHASE_WAIT, swing_angle, 0.0);
  EXPECT_NEAR(pans.pan[0], stays, radians(0.6));
  pans.scheduler.end_look();
  for (int k = 0; k < 100; ++k) pans.step(BERM_PHASE_WAIT, swing_angle, 0.0);
  EXPECT_GT(std::fabs(pans.pan[0] - stays), radians(5.0));
}

// From the far end, which the dig does not see, inward, at its rate over the ground also while the machine swings away faster than that.
TEST(ScanScheduler, ALookOnTheWayKeepsItsRateOverTheGroundWhileTheMachineSwings) {
  for (const double side : {1.0, -1.0}) {
    const std::size_t looker = side > 0.0 ? 0 : 1;
    Pans pans(berm::app_bench::zx200(), side * radians(96.0));
    double angle = side * radians(24.0), speed = 0.0, seconds = 0.0, goes_s = 0.0, farthest = 0.0, fastest_swing = 0.0;
    const double one = side * radians(25.0), far = side * radians(150.0), dig = side * radians(-12.0);
    pans.pan[looker] = side * radians(10.0);
    pans.scheduler.begin_look_on_the_way(looker, {std::min(one, far), std::max(one, far)});
    double before = 0.0;
    for (; !pans.scheduler.look_done() && seconds < 12.0; seconds += 0.01) {
      const bool sweeps = pans.scheduler.look_sweeps(), free = sweeps && side * before < side * dig + radians(125.0);
      const double way = side * (angle - dig);
      speed = free && way > 0.0 ? -side * std::min({radians(45.0), std::fabs(speed) + 0.006, std::sqrt(2.0 * 0.6 * way)}) : 0.0;
      angle += 0.01 * speed;
      fastest_swing = std::max(fastest_swing, std::fabs(speed));
      pans.step(BERM_PHASE_SWING_TO_DIG, angle, speed);
      const double bearing = pans.pan[looker] + angle;
      if (!sweeps) goes_s += 0.01;
      if (sweeps && !pans.scheduler.look_done()) {
        EXPECT_NEAR(side * (before - bearing) / 0.01, ScanScheduler::look_rate, radians(0.1)) << side << " " << seconds;
      }
      if (pans.scheduler.look_sweeps()) farthest = std::max(farthest, side * bearing);
      before = bearing;
    }
    ASSERT_TRUE(pans.scheduler.look_done()) << side;
    EXPECT_GT(fastest_swing, ScanScheduler::look_rate);
    EXPECT_NEAR(angle, dig, radians(2.0));
    EXPECT_LT(goes_s, 1.2) << "116 degrees at the pan's largest speed";
    EXPECT_GT(farthest, side * far - radians(2.5)) << "the place's end is 3 degrees short of it";
    EXPECT_LT(side * before, side * one + radians(1.0));
  }
}

// Of the ground at the machine's feet on the way from there to the dig, which the boom hides during the dig: wherever the other scanner was when the look
// began, and not much after the shortest look. A truck on the right is looked at by the right scanner.
TEST(ScanScheduler, BesideALookTheOtherScannerSeesTheGroundAtTheFeet) {
  const MachineModel machine = berm::app_bench::zx200();
  for (const double side : {1.0, -1.0}) {
    const std::size_t looker = side > 0.0 ? 0 : 1, other = 1 - looker;
    const double swing_angle = side * radians(37.0), one = side * radians(40.0), far = side * radians(150.0);
    for (double began = machine.scanner[other].pan_low; began <= machine.scanner[other].pan_high; began += radians(5.0)) {
      Pans pans(machine, side * radians(96.0));
      for (int k = 0; k < 2000; ++k) pans.step(BERM_PHASE_WAIT, swing_angle, 0.0);
      pans.pan[other] = began;
      pans.pan[looker] = one - swing_angle;
      pans.scheduler.begin_look(looker, {std::min(one, far), std::max(one, far)});
      ASSERT_FALSE(pans.scheduler.feet_seen());
      double inmost = side * began, after_look = 0.0;
      for (int k = 0; k < 2000 && !(pans.scheduler.look_done() && pans.scheduler.feet_seen()); ++k) {
        pans.step(BERM_PHASE_WAIT, swing_angle, 0.0);
        inmost = std::max(inmost, side * pans.pan[other]);
        if (pans.scheduler.look_done()) after_look += 0.01;
      }
      EXPECT_GT(inmost, radians(35.0)) << side << " " << degrees(began);
      EXPECT_LT(after_look, 1.0) << side << " " << degrees(began);
    }
  }
}

TEST(ScanScheduler, WhatLookedAtTheTruckIsNotTheOtherScanner) {
  Pans pans(berm::app_bench::zx200());
  const double outmost = pans.machine.scanner[1].pan_low;
  const auto go_on = [&](int cycles) {
    for (int k = 0; k < cycles; ++k) {
      pans.pan[1] = outmost;
      pans.step(BERM_PHASE_WAIT, radians(37.0), 0.0);
    }
  };
  pans.scheduler.begin_look(0, {radians(40.0), radians(150.0)});
  go_on(1000);
  ASSERT_TRUE(pans.scheduler.look_done());
  pans.scheduler.end_look();
  pans.pan[0] = pans.machine.scanner[0].pan_low;  // it is under the boom itself now
  go_on(10);
  EXPECT_FALSE(pans.scheduler.feet_seen());
}

TEST(ScanScheduler, BesideALookTheOtherScannerKeepsToTheWayToTheDig) {
  for (const double side : {1.0, -1.0}) {
    const std::size_t looker = side > 0.0 ? 0 : 1, other = 1 - looker;
    const double swing_angle = side * radians(37.0), one = side * radians(40.0), far = side * radians(150.0);
    Pans pans(berm::app_bench::zx200(), side * radians(96.0));
    for (int k = 0; k < 2000; ++k) pans.step(BERM_PHASE_WAIT, swing_angle, 0.0);
    pans.scheduler.begin_look(looker, {std::min(one, far), std::max(one, far)});
    for (int k = 0; k < 1500; ++k) pans.step(BERM_PHASE_WAIT, swing_angle, 0.0);
    double outmost = 1e9;
    for (int k = 0; k < 1000; ++k) {
      pans.step(BERM_PHASE_WAIT, swing_angle, 0.0);
      outmost = std::min(outmost, side * degrees(pans.pan[other] + swing_angle));
    }
    EXPECT_NEAR(outmost, -60.0, 3.0) << side << ": beyond the dig by the implements' width and the columns beside it";
  }
}

TEST(ScanScheduler, ALookBeyondThePansRangeEndsWhereTheRangeDoes) {
  Pans pans(berm::app_bench::zx200());
  pans.scheduler.begin_look(0, {radians(60.0), radians(300.0)});
  for (int k = 0; !pans.scheduler.look_done() && k < 2000; ++k) pans.step(BERM_PHASE_WAIT, 0.0, 0.0);
  EXPECT_TRUE(pans.scheduler.look_done());
}

TEST(ScanScheduler, NoScanlineTurnsTooFastWhateverTheSwing) {
  for (const double speed : {-38.0, -20.0, 0.0, 20.0, 38.0})
    for (std::uint16_t phase = 0; phase < BERM_PHASE_COUNT; ++phase) {
      Pans pans(berm::app_bench::zx200());
      double swing_angle = speed > 0.0 ? 0.0 : radians(96.0);
      for (int k = 0; k < 250; ++k) {
        pans.step(phase, swing_angle, radians(speed));
        swing_angle += radians(speed) * 0.01;
      }
      EXPECT_LE(pans.fastest, radians(40.0)) << "phase " << phase << " swing speed " << speed;
    }
}

TEST(ScanScheduler, TheGroundBeyondTheTruckIsSeenBeforeTheSwingIsFast) {
  // From the rightmost dig the pan's far end reaches past the truck only once the swing has begun.
  Pans pans(berm::app_bench::zx200());
  const double dig = radians(-12.0);
  for (int k = 0; k < 2000; ++k) pans.step(BERM_PHASE_DIG, dig, 0.0);
  for (int k = 0; k < 500; ++k) pans.step(BERM_PHASE_LIFT, dig, 0.0);
  pans.high[0] = -1e9;
  double swing_angle = dig, speed = 0.0;
  while (speed < radians(38.0)) {
    speed += radians(20.0) * 0.01;
    swing_angle += speed * 0.01;
    pans.step(BERM_PHASE_SWING_TO_TRUCK, swing_angle, speed);
  }
  EXPECT_GT(pans.high[0], radians(96.0 + 45.0));
}

TEST(ScanScheduler, TheLeadingScannerStaysAheadOfTheSwing) {
  Pans pans(berm::app_bench::zx200());
  for (int k = 0; k < 2000; ++k) pans.step(BERM_PHASE_DIG, 0.0, 0.0);
  for (int k = 0; k < 150; ++k) pans.step(BERM_PHASE_LIFT, 0.0, 0.0);
  double swing_angle = 0.0, least = 1e9;
  for (int k = 0; k < 250; ++k) {
    pans.step(BERM_PHASE_SWING_TO_TRUCK, swing_angle, radians(36.0));
    swing_angle += radians(0.36);
    least = std::min(least, pans.pan[0]);
  }
  EXPECT_GT(least, radians(20.0));
}

// A swing between two bearings at the joint's limits, from standing to standing: its angle and speed, cycle by cycle.
template <class Visit>
void swing_over(double from, double to, Visit visit) {
  constexpr double fastest = radians(45.0), acceleration = radians(40.0), cycle = 0.01;
  const double sense = to > from ? 1.0 : -1.0;
  double gone = 0.0, speed = 0.0;
  for (const double way = std::fabs(to - from); gone < way - 1e-3;) {
    speed = std::min({speed + acceleration * cycle, fastest, std::max(radians(0.5), std::sqrt(2.0 * acceleration * (way - gone)))});
    gone = std::min(way, gone + speed * cycle);
    visit(from + sense * gone, sense * speed);
  }
}

// From a dig to the truck, where it is poured for so long, and back; the scanners as passes before have left them.
struct Pass {
  explicit Pass(double side) : pans(berm::app_bench::zx200(), side * radians(96.0)), truck(side * radians(94.0)), ahead(side > 0.0 ? 0 : 1) {
    for (int k = 0; k < 2; ++k) to_truck([](std::size_t, double, double, double) {}), to_dig([](std::size_t, double, double, double) {});
  }
  // visit: of each scanner, the bearings between which it looked in that cycle, and the swing's angle.
  template <class Visit>
  void to_truck(Visit visit) {
    for (int k = 0; k < dig_cycles; ++k) cycle(BERM_PHASE_DIG, 0.0, 0.0, visit);
    for (int k = 0; k < lift_cycles; ++k) cycle(BERM_PHASE_LIFT, 0.0, 0.0, visit);
    swing_over(0.0, truck, [&](double angle, double speed) { cycle(BERM_PHASE_SWING_TO_TRUCK, angle, speed, visit); });
    for (int k = 0; k < pour_cycles; ++k) cycle(BERM_PHASE_DUMP, truck, 0.0, visit);
  }
  template <class Visit>
  void to_dig(Visit visit) {
    swing_over(truck, 0.0, [&](double angle, double speed) { cycle(BERM_PHASE_SWING_TO_DIG, angle, speed, visit); });
  }
  template <class Visit>
  void cycle(std::uint16_t phase, double angle, double speed, Visit visit) {
    const auto before = pans.pan;
    pans.step(phase, angle, speed);
    for (std::size_t i = 0; i < 2; ++i) visit(i, before[i] + angle - speed * 0.01, pans.pan[i] + angle, angle);
  }
  Pans pans;
  int dig_cycles = 300, lift_cycles = 150, pour_cycles = 150;
  double truck;
  std::size_t ahead;  // the scanner on the truck's side
};

bool passed(double from, double to, double bearing) { return (from - bearing) * (to - bearing) <= 0.0; }

// What was poured is measured by the scanner on the truck's side during the swing back (stentz-1999, 3), over all of the bed, so that the next dump is planned by it.
// Where that scanner is on its way inward then, what lies beyond was seen in the pour's last second instead.
TEST(ScanScheduler, TheBedIsSeenOnTheSwingBackOrJustBefore) {
  for (const double side : {1.0, -1.0}) {
    int whole = 0, pours = 0;
    for (int pour_cycles = 50; pour_cycles <= 300; pour_cycles += 10, ++pours) {
      Pass pass(side);
      pass.pour_cycles = pour_cycles;
      std::vector<int> seen(49, -1);  // when last; of the bed on the site, which lies from 72 to 120 degrees off
      int now = 0;
      const auto look = [&](std::size_t scanner, double from, double to, double) {
        now += scanner == 0;
        for (std::size_t a = 0; a < seen.size(); ++a)
          if (scanner == pass.ahead && passed(from, to, side * radians(72.0 + static_cast<double>(a)))) seen[a] = now;
      };
      pass.to_truck(look);
      const int turns = now;
      pass.to_dig(look);
      for (std::size_t a = 0; a < seen.size(); ++a) EXPECT_GT(seen[a], turns - 100) << side << ": " << 72 + a << " degrees off, " << pour_cycles << " cycles of pouring";
      whole += std::all_of(seen.begin(), seen.end(), [&](int when) { return when > turns; });
    }
    EXPECT_GT(whole, pours / 2) << side << ": mostly all of it is seen on the swing itself";
  }
}

// The new surface of the face is measured when the swing has left it, by the other scanner, for the next dig to be planned by it.
TEST(ScanScheduler, TheDigFaceIsSeenOnTheSwingToTheTruck) {
  for (const double side : {1.0, -1.0}) {
    Pass pass(side);
    std::vector<int> seen(25, 0);  // from 12 degrees on one side to 12 on the other
    pass.to_truck([&](std::size_t scanner, double from, double to, double angle) {
      for (std::size_t a = 0; a < seen.size(); ++a)
        if (scanner != pass.ahead && side * angle > radians(30.0) && passed(from, to, radians(-12.0 + static_cast<double>(a)))) ++seen[a];
    });
    for (std::size_t a = 0; a < seen.size(); ++a) EXPECT_GE(seen[a], 1) << side << ": " << static_cast<int>(a) - 12 << " degrees";
  }
}

// And again, against obstacles, before the implements come back there: by the scanner that leads on that way, farther ahead than a swing stops in (28 degrees
// from 45 degrees a second, with what it takes to see).
TEST(ScanScheduler, TheDigFaceIsSeenOnTheSwingBackBeforeTheImplementsAreThere) {
  for (const double side : {1.0, -1.0}) {
    Pass pass(side);
    std::vector<double> seen_from(37, -1.0);  // how far the swing still was from there; from 12 degrees on the truck's side to 24 beyond the middle
    pass.to_truck([](std::size_t, double, double, double) {});
    pass.to_dig([&](std::size_t scanner, double from, double to, double angle) {
      for (std::size_t a = 0; a < seen_from.size(); ++a) {
        const double bearing = side * radians(12.0 - static_cast<double>(a));
        if (scanner != pass.ahead && passed(from, to, bearing)) seen_from[a] = std::max(seen_from[a], side * (angle - bearing));
      }
    });
    for (std::size_t a = 0; a < seen_from.size(); ++a) EXPECT_GT(seen_from[a], radians(40.0)) << side << ": " << 12 - static_cast<int>(a) << " degrees";
  }
}

// Nothing waits for it, so that how far it is ahead goes by the time that a dig's end and the curl take, and by where the dig's own looks were: the least of all, in
// the first second of the swing.
double least_ahead(double side, int lift_cycles) {
  double least = 1e9;
  for (int dig_cycles = 100; dig_cycles <= 700; dig_cycles += 50) {
    Pass pass(side);
    pass.dig_cycles = dig_cycles;
    pass.lift_cycles = lift_cycles;
    int cycles = 0;
    pass.to_truck([&](std::size_t scanner, double, double to, double angle) {
      if (scanner == pass.ahead && angle != 0.0 && ++cycles <= 100) least = std::min(least, side * (to - angle));
    });
  }
  return least;
}

TEST(ScanScheduler, TheLeadingScannerHasPassedOverWhatComesFirstWhenTheSwingBegins) {
  for (const double side : {1.0, -1.0}) {
    EXPECT_GT(least_ahead(side, 200), radians(40.0)) << side;
    EXPECT_GT(least_ahead(side, 150), radians(20.0)) << side << ": after a dig that ended soon";
  }
}

}  // namespace
