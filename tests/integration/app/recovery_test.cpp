// What the app does while the kernel does not permit motion.
#include <gtest/gtest.h>

#include <vector>

#include "app/recovery.hpp"
#include "app_bench/bench_machine.hpp"
#include "motion/arm_kinematics.hpp"
#include "recovery_observations.hpp"

namespace {

using namespace berm::app;
using namespace berm::app_bench;

TEST(Recovery, HoldsLooksAgainThenRetreatsAtCreepSpeed) {
  const MachineModel m = berm::app_bench::zx200();
  Recovery recovery(m);
  const ProgressLog log(-1);
  int rescans = 0;
  bool raised = false, swung_away = false;
  for (int k = 0; k < 1200; ++k) {
    const double t = 0.01 * k;
    const auto advice = recovery.step(stopped(t, BERM_STOP_COLLISION_PREDICTED), log);
    ASSERT_TRUE(advice.in_charge);
    rescans += advice.rescan;
    for (std::size_t j = 0; j < joints; ++j) {
      ASSERT_LE(std::fabs(advice.velocity[j]), m.joint[j].creep_velocity);
      if (t < 2.0) {
        ASSERT_EQ(advice.velocity[j], 0.0);
      }
    }
    raised = raised || advice.velocity[boom] > 0.0;
    swung_away = swung_away || advice.velocity[swing] < 0.0;
    ASSERT_LE(advice.velocity[swing], 0.0) << "toward what blocks";
  }
  EXPECT_EQ(rescans, 2);  // after 0.5 s, and again 6 s later
  EXPECT_TRUE(raised);
  EXPECT_TRUE(swung_away);
  auto advice = recovery.step(permitted(12.0), log);
  EXPECT_TRUE(advice.in_charge) << "a retreat that is permitted is used, not given up at once";
  EXPECT_LT(advice.velocity[bucket], 0.0);
  EXPECT_TRUE(recovery.step(permitted(12.9), log).in_charge);
  advice = recovery.step(permitted(13.1), log);
  EXPECT_FALSE(advice.in_charge);
  EXPECT_TRUE(advice.resumed);
  EXPECT_TRUE(advice.moved);
  EXPECT_FALSE(recovery.step(permitted(13.2), log).resumed);
}

// Whoever came must leave: no motion is asked for meanwhile, both scanners look; the operator is called when the kernel would know by now that he had left;
// and then the plan goes on from where it was.
TEST(Recovery, WaitsForAnIntruderWithoutMoving) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  int rescans = 0;
  std::vector<double> calls;
  const auto intruder = [](double t) {
    Observation o = stopped(t, BERM_STOP_INTRUDER);
    o.blocked_x = 7.0;
    o.blocked_y = 1.0;
    return o;
  };
  for (int k = 0; k < 4000; ++k) {
    const auto advice = recovery.step(intruder(0.01 * k), log);
    ASSERT_TRUE(advice.in_charge);
    ASSERT_EQ(advice.velocity, Joints{}) << "at " << 0.01 * k << " s";
    rescans += advice.rescan;
    if (advice.operator_called) calls.push_back(0.01 * k);
  }
  EXPECT_GE(rescans, 6);
  ASSERT_EQ(calls.size(), 1U);
  EXPECT_NEAR(calls[0], 38.0, 0.05);
  const auto advice = recovery.step(permitted(40.0), log);
  EXPECT_TRUE(advice.resumed) << "nothing to retreat from, nothing to look at from elsewhere";
  EXPECT_FALSE(advice.moved);
}

// A direction that was not seen for too long: both scanners look, nothing is asked for, and the plan goes on from where it was.
TEST(Recovery, WaitsUntilTheSeparationIsKeptAgain) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  int rescans = 0, calls = 0;
  for (int k = 0; k < 4000; ++k) {
    const auto advice = recovery.step(stopped(0.01 * k, BERM_STOP_SEPARATION), log);
    ASSERT_TRUE(advice.in_charge);
    ASSERT_EQ(advice.velocity, Joints{}) << "at " << 0.01 * k << " s";
    rescans += advice.rescan;
    calls += advice.operator_called;
  }
  EXPECT_GE(rescans, 6);
  EXPECT_EQ(calls, 1);
  const auto advice = recovery.step(permitted(40.0), log);
  EXPECT_TRUE(advice.resumed);
  EXPECT_FALSE(advice.moved);
}

TEST(Recovery, WaitsUntilTheDustHasSettled) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  int calls = 0;
  for (int k = 0; k < 4000; ++k) {
    const auto advice = recovery.step(stopped(0.01 * k, BERM_STOP_DUST), log);
    ASSERT_TRUE(advice.in_charge);
    ASSERT_EQ(advice.velocity, Joints{}) << "at " << 0.01 * k << " s";
    calls += advice.operator_called;
  }
  EXPECT_EQ(calls, 1);
  const auto advice = recovery.step(permitted(40.0), log);
  EXPECT_TRUE(advice.resumed);
  EXPECT_FALSE(advice.moved);
}

// The bucket in the face while dust hid the ground under it: when the dust has settled the ground keeps the machine.
TEST(Recovery, RetreatsFromTheGroundThatKeepsItAfterTheDust) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  for (double t = 0.0; t < 40.0; t += 0.01) ASSERT_EQ(recovery.step(stopped(t, BERM_STOP_DUST), log).velocity, Joints{});
  Observation ground = stopped(40.0, BERM_STOP_UNKNOWN_GROUND);
  ground.blocked_x = 5.0 * std::cos(ground.blocked_bearing);
  ground.blocked_y = 5.0 * std::sin(ground.blocked_bearing);
  const PlaceInMap unseen{false, true};
  EXPECT_GT(recovery.step(ground, log, unseen).velocity[boom], 0.0) << "patience has run since the dust";
  // Standing is permitted: after the retreat, which does not help, it swings away from the place that the dust's stop did not have, to look from there.
  double away = 0.0;
  for (double t = 40.1; t < 52.0; t += 0.01) away = std::min(away, recovery.step(permitted(t), log, unseen).velocity[swing]);
  EXPECT_EQ(away, 0.0);
  for (double t = 52.0; t < 54.0; t += 0.01) away = std::min(away, recovery.step(permitted(t), log, unseen).velocity[swing]);
  EXPECT_LT(away, -radians(7.0));
}

// Standing is permitted, moving is not: no more than a few attempts, and in the end the operator.
TEST(Recovery, AttemptsThatFailAtOnceFollowAtGrowingPauses) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  int attempts = 0, calls = 0;
  bool stops = true;
  double moving_since = -1.0;
  for (int k = 0; k < 6000; ++k) {
    const double t = 0.01 * k;
    const auto advice = recovery.step(stops ? stopped(t, BERM_STOP_COLLISION_PREDICTED) : permitted(t), log);
    attempts += advice.resumed;
    calls += advice.operator_called;
    if (advice.resumed) moving_since = t;
    ASSERT_EQ(advice.velocity, Joints{}) << "nothing to retreat from where standing is permitted";
    if (!stops && !advice.in_charge && t - moving_since > 0.3) stops = true;  // the plan's motion is stopped after 0.3 s
    else if (stops && k % 30 == 29) stops = false;                           // to stand is permitted
  }
  EXPECT_GE(attempts, 8);
  EXPECT_LE(attempts, 25) << "three a second would be 180";
  EXPECT_EQ(calls, 1) << "short attempts do not put off the call";
}

// What the implements hide the kernel's map keeps: attempts from the same place fail for ever. So away from it, and a look from there.
TEST(Recovery, SwingsBackToLookAtWhatStopsItAgainAndAgain) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  const auto at_place = [](Observation o) {
    o.blocked_x = 5.0 * std::cos(o.blocked_bearing);
    o.blocked_y = 5.0 * std::sin(o.blocked_bearing);
    return o;
  };
  double angle = radians(60.0), farthest = angle, back_at = -1.0, handed_back = -1.0;
  int rescans_there = 0, attempts = 0, calls = 0;
  bool stops = true;
  double resumed_s = 0.0;
  for (int k = 0; k < 3500 && handed_back < 0.0; ++k) {
    const double t = 0.01 * k;
    Observation o = at_place(stops ? stopped(t, BERM_STOP_COLLISION_PREDICTED) : permitted(t));
    o.angle[swing] = angle;
    const auto advice = recovery.step(o, log);
    calls += advice.operator_called;
    angle += 0.01 * advice.velocity[swing];
    ASSERT_LE(advice.velocity[swing], 0.0) << "toward what blocks";
    ASSERT_LE(std::fabs(advice.velocity[swing]), radians(8.01));
    farthest = std::min(farthest, angle);
    if (angle < radians(59.0) && back_at < 0.0) back_at = t;
    rescans_there += back_at > 0.0 && advice.rescan;
    if (advice.resumed) {
      ++attempts;
      resumed_s = t;
      if (back_at > 0.0) handed_back = t;
      EXPECT_EQ(advice.moved, back_at > 0.0);
    }
    if (!stops && !advice.in_charge && t - resumed_s > 0.3) stops = true;  // the plan's motion is stopped after 0.3 s
    else if (stops && k % 30 == 29) stops = false;
  }
  EXPECT_GE(attempts, 3) << "first it tries from where it is";
  EXPECT_GE(back_at, 9.0);
  EXPECT_NEAR(farthest, radians(40.0), radians(0.5));
  EXPECT_EQ(rescans_there, 1);
  EXPECT_GT(handed_back, back_at + 9.5) << "two sweeps of the scanners";
  EXPECT_EQ(calls, 0);
  // Stopped at the same place once more, after seconds of good motion: still the same trouble, and the operator hears of it.
  for (int k = 0; k < 1500; ++k) {
    const double t = handed_back + 3.0 + 0.01 * k;
    calls += recovery.step(at_place(stopped(t, BERM_STOP_COLLISION_PREDICTED)), log).operator_called;
  }
  EXPECT_EQ(calls, 1);
}

// What lies under the implements, on either side of the arm's bearing: back the way they came, which was clear. Beyond the truck's bed is its cab.
TEST(Recovery, SwingsBackTheWayItCameFromWhatLiesUnderTheImplements) {
  for (const double came : {1.0, -1.0})
    for (const double beside_deg : {-6.0, 6.0}) {
      Recovery recovery(berm::app_bench::zx200());
      const ProgressLog log(-1);
      Observation moving = permitted(0.0);
      moving.velocity[swing] = came * radians(20.0);
      recovery.step(moving, log);
      double angle = radians(60.0), before = angle;
      bool stops = true;
      for (int k = 1; k < 3000 && std::fabs(angle - before) < radians(19.0); ++k) {
        const double t = 0.01 * k;
        Observation o = stops ? stopped(t, BERM_STOP_COLLISION_PREDICTED) : permitted(t);
        o.angle[swing] = angle;
        o.blocked_bearing = radians(60.0 + beside_deg);
        o.blocked_x = 4.0 * std::cos(o.blocked_bearing);
        o.blocked_y = 4.0 * std::sin(o.blocked_bearing);
        const auto advice = recovery.step(o, log);
        angle += 0.01 * advice.velocity[swing];
        if (!advice.in_charge) stops = true;
        else if (k % 30 == 29) stops = false;
      }
      EXPECT_NEAR(degrees(angle - before), -came * 19.0, 1.0) << "came " << came << ", place at " << beside_deg;
    }
}

// What may not be passed over is ground like any other: looked at again, crept away from.
TEST(Recovery, GoesRoundWhatMayNotBePassedOver) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  int rescans = 0, calls = 0;
  bool swung_away = false;
  for (int k = 0; k < 4000; ++k) {
    const auto advice = recovery.step(stopped(0.01 * k, BERM_STOP_OVERPASS), log);
    rescans += advice.rescan;
    calls += advice.operator_called;
    swung_away = swung_away || advice.velocity[swing] < 0.0;
    ASSERT_LE(advice.velocity[swing], 0.0) << "toward what blocks";
  }
  EXPECT_GE(rescans, 5);
  EXPECT_TRUE(swung_away);
  EXPECT_EQ(calls, 1);
}

// Each attempt would be a stop more. From another place the scanners may see that it is gone.
TEST(Recovery, WhatIsTooHighIsLookedAtWhileItStands) {
  for (const double gone_s : {4.0, 1000.0}) {
    Recovery recovery(berm::app_bench::zx200());
    const ProgressLog log(-1);
    // As the kernel shows it: the place while the box meets it, the reason until it permits motion.
    Observation o = stopped(0.0, BERM_STOP_OVERPASS);
    o.blocked_x = 4.35, o.blocked_y = -0.45;
    recovery.step(o, log);
    o.blocked_x = o.blocked_y = 0.0;
    for (int k = 1; k < 30; ++k) o.time_s = 0.01 * k, recovery.step(o, log);
    ASSERT_TRUE(recovery.too_high());
    EXPECT_EQ(recovery.too_high()->x, 4.35);
    EXPECT_EQ(recovery.too_high()->y, -0.45);
    double resumed_s = -1.0, looks = 0, swings_s = -1.0;
    for (int k = 30; k < 6000 && resumed_s < 0.0; ++k) {
      const double t = 0.01 * k;
      const auto advice = recovery.step(permitted(t), log, {t > 0.8 && t < gone_s, false});  // the map is half a second old
      looks += advice.rescan;
      if (swings_s < 0.0 && advice.velocity[swing] != 0.0) swings_s = t;
      if (advice.resumed) resumed_s = t;
    }
    EXPECT_NEAR(resumed_s, gone_s < 100.0 ? gone_s : 25.0, 0.02) << "for ever it is not waited: the operator is called after some attempts";
    EXPECT_GE(looks, 1);
    if (gone_s > 100.0) {
      EXPECT_NEAR(swings_s, 9.0, 0.1);
    }
    Observation other = stopped(resumed_s + 1.0, BERM_STOP_COLLISION_PREDICTED);
    other.blocked_x = 4.35, other.blocked_y = -0.45;
    recovery.step(other, log, {true, false});
    EXPECT_FALSE(recovery.too_high()) << "the newest stop is another one";
  }
}

TEST(Recovery, KnowsThatTheImplementsWereMovedByHand) {
  const MachineModel m = berm::app_bench::zx200();
  const ProgressLog log(-1);
  const auto moved = [&](double boom_after) {
    Recovery recovery(m);
    Observation o = stopped(0.0, BERM_STOP_OPERATOR);
    o.kernel_state = BERM_STATE_STOPPING;
    o.angle[boom] -= radians(9.0);  // the stop's own way
    recovery.step(o, log);
    o.angle = stopped(0.05, BERM_STOP_OPERATOR).angle;
    recovery.step(o, log);
    for (double t = 0.1; t < 20.0; t += 0.1) {
      o = stopped(t, BERM_STOP_OPERATOR);
      if (t > 10.0) o.angle[boom] += boom_after;
      recovery.step(o, log);
    }
    o = permitted(20.0);
    o.angle[boom] += boom_after;
    if (const auto advice = recovery.step(o, log); advice.resumed) return advice.moved;
    o.time_s = 21.0;
    return recovery.step(o, log).moved;
  };
  EXPECT_FALSE(moved(0.0));
  EXPECT_TRUE(moved(radians(20.0)));
}

// The bucket, curled in on a retreat, comes to its range's end: it is not curled on whenever the kernel permits standing.
TEST(Recovery, ARetreatThatIsStoppedItselfIsNotTriedAgain) {
  const MachineModel m = berm::app_bench::zx200();
  Recovery recovery(m);
  const ProgressLog log(-1);
  for (double t = 0.0; t < 11.5; t += 0.01) recovery.step(stopped(t, BERM_STOP_UNKNOWN_GROUND), log);
  Observation o = permitted(11.5);
  ASSERT_LT(recovery.step(o, log).velocity[bucket], 0.0);
  double curled = 0.0, opened = 0.0;
  for (int k = 0; k < 50; ++k) {
    o = stopped(11.6 + 0.02 * k, BERM_STOP_JOINT_RANGE);
    o.angle[bucket] = m.joint[bucket].low + radians(0.5);
    recovery.step(o, log);
    Observation runs = permitted(11.61 + 0.02 * k);
    runs.angle = o.angle;
    const double v = recovery.step(runs, log).velocity[bucket];
    curled = std::min(curled, v);
    opened = std::max(opened, v);
  }
  EXPECT_EQ(curled, 0.0);
  EXPECT_GT(opened, 0.0) << "back into its range";
}

// The bucket hides the ground that keeps it, and to stand over that is not permitted: a retreat of a second was a stop each time, and the plan after it
// another.
TEST(Recovery, ARetreatFromGroundThatWasNotSeenGoesOnUntilItIs) {
  for (const std::uint8_t reason : {BERM_STOP_STALE_GROUND, BERM_STOP_UNKNOWN_GROUND, BERM_STOP_COLLISION_PREDICTED})
    for (const double seen_s : {39.0, 1000.0}) {
      Recovery recovery(berm::app_bench::zx200());
      const ProgressLog log(-1);
      Observation o;
      for (double t = 0.0; t < 34.0; t += 0.1) {
        o = stopped(t, BERM_STOP_INTRUDER);
        o.blocked_x = -14.0;
        recovery.step(o, log, {false, true});
      }
      EXPECT_FALSE(recovery.unseen()) << "whoever came is another matter";
      o = stopped(34.0, reason);
      o.blocked_x = o.blocked_y = 0.0;
      EXPECT_GT(recovery.step(o, log, {false, true}).velocity[boom], 0.0) << "up first, however long he stood there";
      const bool of_unseen = reason != BERM_STOP_COLLISION_PREDICTED;
      ASSERT_EQ(recovery.unseen().has_value(), of_unseen);
      if (of_unseen) {
        const Point tip = in_base(forward(berm::app_bench::zx200(), o.angle).tip, o.angle[swing]);
        EXPECT_NEAR(recovery.unseen()->x, tip.x, 1e-9) << "the kernel named no place";
        EXPECT_NEAR(recovery.unseen()->y, tip.y, 1e-9);
        o.blocked_x = 5.85, o.blocked_y = 1.05;
        recovery.step(o, log, {false, true});
        EXPECT_EQ(recovery.unseen()->x, 5.85);
      }
      double raised_until = 0.0, resumed_s = -1.0;
      int looks = 0;
      for (int k = 0; k < 4000 && resumed_s < 0.0; ++k) {
        const double t = 34.01 + 0.01 * k;
        const auto advice = recovery.step(permitted(t), log, {false, t < seen_s});
        looks += advice.rescan;
        if (advice.velocity[boom] > 0.0) raised_until = t;
        if (!advice.resumed) continue;
        resumed_s = t;
        EXPECT_TRUE(advice.moved);
      }
      EXPECT_NEAR(raised_until, of_unseen ? std::min(seen_s, 46.0) : 35.0, 0.03) << int{reason} << ", seen after " << seen_s;
      EXPECT_GE(resumed_s, raised_until);
      if (of_unseen && seen_s < 100.0) {
        EXPECT_NEAR(resumed_s, seen_s, 0.03) << "and the plan is in charge again at once";
      } else if (of_unseen) {
        EXPECT_GE(looks, 2) << "while it goes on";
      }
    }
}

// What it was to look at from elsewhere it has seen by then.
TEST(Recovery, ARetreatThatHasUncoveredTheGroundIsFollowedByNoSwingBack) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  for (double t = 0.0; t < 15.0; t += 0.01) {
    Observation o = stopped(t, BERM_STOP_STALE_GROUND);
    o.blocked_x = 5.0 * std::cos(o.blocked_bearing);
    o.blocked_y = 5.0 * std::sin(o.blocked_bearing);
    recovery.step(o, log, {false, true});
  }
  double resumed_s = -1.0;
  for (double t = 15.0; t < 40.0 && resumed_s < 0.0; t += 0.01) {
    const auto advice = recovery.step(permitted(t), log, {false, t < 18.0});
    EXPECT_EQ(advice.velocity[swing], 0.0) << t;
    if (advice.resumed) resumed_s = t;
  }
  EXPECT_NEAR(resumed_s, 18.0, 0.03);
}

// The third creep curls the bucket: where that goes on for seconds it ends short of the range, not in another stop.
TEST(Recovery, ALongRetreatEndsShortOfAJointsRange) {
  const MachineModel m = berm::app_bench::zx200();
  Recovery recovery(m);
  const ProgressLog log(-1);
  Observation o;
  const auto curled = [&](Observation at) {
    at.angle[bucket] = o.angle[bucket];
    at.blocked_x = 5.0;
    return at;
  };
  o.angle[bucket] = m.joint[bucket].low + radians(20.0);
  for (double t = 0.0; t < 11.5; t += 0.01) recovery.step(curled(stopped(t, BERM_STOP_STALE_GROUND)), log, {false, true});
  double least = o.angle[bucket];
  bool moved = false;
  for (double t = 11.5; t < 23.0; t += 0.01) {
    o.angle[bucket] += 0.01 * recovery.step(curled(permitted(t)), log, {false, true}).velocity[bucket];
    moved = moved || o.angle[bucket] < least;
    least = std::min(least, o.angle[bucket]);
  }
  EXPECT_TRUE(moved);
  EXPECT_NEAR(least, m.joint[bucket].low + radians(8.0), radians(0.2));
}

// With the bucket in the face a swing to look from elsewhere is a stop more: who stood there for half a minute has not used up what creeping is given.
TEST(Recovery, SwingsBackOnlyAfterTheGroundHasKeptItForLong) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  for (double t = 0.0; t < 30.0; t += 0.01) recovery.step(stopped(t, BERM_STOP_INTRUDER), log);
  double swung_s = -1.0;
  bool stops = true;
  for (int k = 3000; k < 6000 && swung_s < 0.0; ++k) {
    const double t = 0.01 * k;
    Observation o = stops ? stopped(t, BERM_STOP_COLLISION_PREDICTED) : permitted(t);
    o.blocked_x = 5.0 * std::cos(o.blocked_bearing);
    o.blocked_y = 5.0 * std::sin(o.blocked_bearing);
    const auto advice = recovery.step(o, log);
    if (!stops && std::fabs(advice.velocity[swing]) > radians(5.0)) swung_s = t;
    if (!advice.in_charge) stops = true;
    else if (k % 30 == 29) stops = false;
  }
  EXPECT_GT(swung_s, 38.9);
  EXPECT_LT(swung_s, 50.0);
}

// Standing is permitted for a moment now and then, for the joints' noise decides whether the bucket is over a cell that nothing has seen: 300 stops in five
// minutes, for each put the retreat off by its patience.
TEST(Recovery, AKernelThatWaversPutsARetreatOffNoLonger) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  double raised_s = -1.0;
  for (int k = 0; k < 1000 && raised_s < 0.0; ++k) {
    const double t = 0.01 * k;
    const bool permits = k % 15 >= 10;
    const auto advice = recovery.step(permits ? permitted(t) : stopped(t, BERM_STOP_UNKNOWN_GROUND), log);
    if (permits && advice.velocity[boom] > 0.0) raised_s = t;
    if (t < 2.5) {
      ASSERT_EQ(advice.velocity, Joints{}) << t;
    }
  }
  EXPECT_GT(raised_s, 2.5);
  EXPECT_LT(raised_s, 3.0);
  // That is stopped as well: not the same again at once.
  int tried = 0;
  for (int k = 0; k < 240; ++k) {
    const double t = raised_s + 0.01 * (k + 1);
    tried += recovery.step(k % 15 >= 10 ? permitted(t) : stopped(t, BERM_STOP_UNKNOWN_GROUND), log).velocity[boom] > 0.0;
  }
  EXPECT_EQ(tried, 0);
}

TEST(Recovery, AfterGoodMotionAStopIsANewOne) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  for (int n = 0; n < 5; ++n) {
    const double t = 10.0 * n;
    recovery.step(stopped(t, BERM_STOP_STALE_GROUND), log);
    EXPECT_TRUE(recovery.step(permitted(t + 0.5), log).resumed) << "without a pause";
    EXPECT_FALSE(recovery.step(permitted(t + 9.9), log).in_charge);
  }
}

TEST(Recovery, WaitsForTheOperator) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  for (int k = 0; k < 3000; ++k) {
    const auto advice = recovery.step(stopped(0.01 * k, BERM_STOP_OPERATOR), log);
    ASSERT_TRUE(advice.in_charge);
    ASSERT_EQ(advice.operator_called, k == 0) << "at once, for nothing else can help; and once";
    for (const double v : advice.velocity) ASSERT_EQ(v, 0.0);
  }
}

TEST(Recovery, ComesBackIntoTheJointsRange) {
  Recovery recovery(berm::app_bench::zx200());
  const ProgressLog log(-1);
  Observation o = stopped(0.0, BERM_STOP_JOINT_RANGE);
  o.angle[bucket] = radians(-135.0);
  Recovery::Advice advice;
  for (int k = 0; k < 300; ++k) {
    o.time_s = 0.01 * k;
    advice = recovery.step(o, log);
  }
  EXPECT_GT(advice.velocity[bucket], 0.0);
  EXPECT_EQ(advice.velocity[swing], 0.0);
}

}  // namespace
