// A kernel that lets out less than is asked: the passes go on, slower, as they were planned.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <optional>
#include <vector>

#include "app_bench/loading.hpp"
#include "motion/arm_kinematics.hpp"

namespace {

using namespace berm;
using namespace berm::app;
using app_bench::Loading;
using app_bench::start_pose;

constexpr double quarter = 0.25;

double at_most(const Loading& run, double share) { return share * limits_of(run.machine, swing, 8.0).velocity; }

// The tip on the way back, in every cycle: swing angle and z.
struct Height { double deg, z; };
using Heights = std::vector<Height>;

void note(const Loading& run, Heights& heights) {
  if (run.last.phase != BERM_PHASE_SWING_TO_DIG) return;
  heights.push_back({degrees(run.plant.angle()[swing]), forward(run.machine, run.plant.angle()).tip.z});
}

// z where the swing comes to an angle, on the line between two cycles; nothing where it never does.
std::optional<double> height_at(const Heights& heights, double deg) {
  for (std::size_t i = 1; i < heights.size(); ++i)
    if (heights[i].deg <= deg && heights[i - 1].deg > deg)
      return heights[i].z + (heights[i - 1].z - heights[i].z) * (deg - heights[i].deg) / (heights[i - 1].deg - heights[i].deg);
  return std::nullopt;
}

void go_to_swing(Loading& run, int pass) {
  const double end = 60.0 * pass;
  for (std::uint16_t before = run.last.phase; pass > 0 && run.seconds < end; before = run.last.phase) {
    run.step();
    pass -= before != BERM_PHASE_SWING_TO_TRUCK && run.last.phase == BERM_PHASE_SWING_TO_TRUCK;
  }
  ASSERT_EQ(pass, 0) << "no swing to the truck";
}

// One pass from the start of its swing to the next dig, with the swing's speed cut; heights of the way back.
// at_most_spans: how often the swing was asked for at the speed that it was cut to, not counting pauses of less than 0.3 s.
Heights one_pass(Loading& run, int pass, double share, int* at_most_spans = nullptr) {
  Heights heights;
  double asked_s = -1.0;
  go_to_swing(run, pass);
  const double had = run.plant.site().bed_mass();
  const auto dumped = [&run, had] { return run.plant.site().bed_mass() > had + 700.0; };
  run.plant.most_speed[swing] = at_most(run, share);
  const double end = run.seconds + 120.0;
  while (run.seconds < end && !(dumped() && run.last.phase == BERM_PHASE_DIG)) {
    run.step();
    note(run, heights);
    if (std::fabs(run.request.joint_velocity_urad_s[swing]) < 0.98e6 * at_most(run, share)) continue;
    if (at_most_spans != nullptr && (asked_s < 0.0 || run.seconds - asked_s > 0.3)) ++*at_most_spans;
    asked_s = run.seconds;
  }
  EXPECT_LT(run.seconds, end) << "the pass did not end; in the bed: " << run.plant.site().bed_mass() << " kg";
  run.plant.most_speed[swing] = run.machine.joint[swing].velocity_max;
  return heights;
}

TEST(SlowedSwing, IsNeverAskedBeyondWhatIsPermitted) {
  Loading run(1, start_pose());
  constexpr double bus_step = 500.0;
  int cut = 0;
  bool was_cut = false;
  const double lag = response_of(run.machine, swing).lag, dead_time = response_of(run.machine, swing).dead_time, acceleration = limits_of(run.machine, swing, 8.0, 0.0).acceleration;
  double before_urad_s = 0.0, most_jump = 0.0;
  for (int k = 0; k < 6000; ++k) {
    run.plant.most_speed[swing] = k / 150 % 2 == 0 ? run.machine.joint[swing].velocity_max : at_most(run, 0.1 + 0.2 * (k / 300 % 4));
    const berm_state now = run.plant.state();
    run.step();
    for (std::size_t j = 0; j < joints; ++j) {
      ASSERT_LE(run.request.joint_velocity_urad_s[j], now.permitted_high_urad_s[j]) << "joint " << j << " at " << run.seconds << " s";
      ASSERT_GE(run.request.joint_velocity_urad_s[j], now.permitted_low_urad_s[j]) << "joint " << j << " at " << run.seconds << " s";
    }
    // Against what was let out, as the machine saw it.
    const double asked = run.request.joint_velocity_urad_s[swing];
    // A joint that lags, and is to speed up as it can, is asked for so much more than its speed when that acts; of a speed that was cut none of it.
    const double way = asked < 0.0 ? -1.0 : 1.0, speed = std::max(0.0, way * now.joint_velocity_urad_s[swing]), ahead = was_cut ? 0.0 : speed + 1e6 * acceleration * (dead_time + lag);
    if (std::fabs(asked) > std::fabs(before_urad_s)) most_jump = std::max(most_jump, way * asked - std::max(way * before_urad_s, ahead));
    before_urad_s = run.plant.state().commanded_urad_s[swing];
    was_cut = std::fabs(asked - before_urad_s) >= bus_step;
    cut += was_cut;
  }
  EXPECT_GT(cut, 200) << "hardly anything was cut: the test shows nothing";
  EXPECT_LE(most_jump, acceleration * run.machine.cycle * 1e6 + bus_step + 1.0);
}

TEST(SlowedSwing, AtAQuarterOfItsSpeedStillDumpsIntoTheBedAndReturns) {
  Loading free(1, start_pose()), slow(1, start_pose());
  // The second pass: the first has not seen enough yet to reach out over the dig early.
  const Heights planned = one_pass(free, 2, 1.0), found = one_pass(slow, 2, quarter);
  EXPECT_EQ(free.sequencer.slow_down().spans(), 0);
  EXPECT_EQ(free.sequencer.slow_down().seconds(), 0.0);
  EXPECT_GT(slow.seconds, free.seconds + 6.0) << "it was not slowed: the test shows nothing";
  EXPECT_GE(slow.plant.site().bed_mass(), 0.95 * free.plant.site().bed_mass());
  EXPECT_LE(slow.plant.site().spilled_mass(), 20.0);
  const app_bench::Findings& f = slow.plant.findings();
  EXPECT_EQ(f.wall_contacts, 0) << "lowest over the truck: " << f.lowest_over_truck;
  EXPECT_EQ(f.ground_contacts, 0);
  EXPECT_EQ(f.range_contacts, 0);
  // What the swing times keeps to the swing: at every angle of the way back from which the arm may reach out over the dig, the tip is no lower than the
  // plan has it. Before, while the emptied bucket is folded whatever the swing does, it is nowhere lower than the lowest that the plan has there.
  constexpr double reaches_out = 55.0;  // deg, and beyond that
  // (0.18 m: what the arm does at its speed in a look of the script and while its joints lag.)
  int compared = 0;
  const auto lowest = [](const Heights& heights) {
    double z = 1e9;
    for (const Height& h : heights)
      if (h.deg >= reaches_out) z = std::min(z, h.z);
    return z;
  };
  EXPECT_GT(lowest(found), lowest(planned) - 0.10);
  for (const auto& [deg, z] : found) {
    if (deg < 8.0 || deg >= reaches_out) continue;  // the last degrees, where the swing lands, differ by a cycle of the script
    const auto plan = height_at(planned, deg);
    if (!plan) continue;
    ++compared;
    EXPECT_GT(z, *plan - 0.18) << "swing at " << deg << " deg";
  }
  EXPECT_GT(compared, 300);
}

TEST(SlowedSwing, IsCounted) {
  Loading run(1, start_pose());
  int spans = 0;
  one_pass(run, 1, quarter, &spans);
  const SlowDown& slowed = run.sequencer.slow_down();
  // To the truck and back, as long as the swing was wanted faster: where the app's own guard wants it slower for a while that is another span.
  EXPECT_EQ(slowed.spans(), spans);
  EXPECT_GE(spans, 2);
  EXPECT_GT(slowed.seconds(), 10.0);
  EXPECT_LT(slowed.seconds(), run.seconds);
  EXPECT_NEAR(slowed.least_share(), quarter, 0.02);
  const double until_here = slowed.seconds();
  go_to_swing(run, 1);
  for (int k = 0; k < 500; ++k) run.step();
  EXPECT_EQ(slowed.seconds(), until_here) << "nothing is cut any more";
  EXPECT_EQ(slowed.spans(), spans);
}

// Every joint at a tenth of its speed, as while the kernel learns a truck's lane: the arm, which is drawn in as the bucket opens, keeps to the bucket, or what
// is poured falls short of the bed.
TEST(SlowedJoints, TheArmIsDrawnInAsTheBucketOpens) {
  Loading free(1, start_pose()), slow(1, start_pose());
  for (Loading* run : {&free, &slow}) {
    go_to_swing(*run, 2);
    const double had = run->plant.site().bed_mass();
    if (run == &slow)
      for (std::size_t j = 0; j < joints; ++j) run->plant.most_speed[j] = 0.1 * run->machine.joint[j].velocity_max;
    for (const double end = run->seconds + 120.0; run->seconds < end && run->last.phase != BERM_PHASE_SWING_TO_DIG;) run->step();
    for (std::size_t j = 0; j < joints; ++j) run->plant.most_speed[j] = run->machine.joint[j].velocity_max;
    for (const double end = run->seconds + 60.0; run->seconds < end && run->last.phase != BERM_PHASE_DIG;) run->step();
    EXPECT_GT(run->plant.site().bed_mass(), had + 700.0) << "nothing was dumped";
  }
  EXPECT_GT(slow.seconds, free.seconds + 15.0) << "it was not slowed: the test shows nothing";
  EXPECT_GE(slow.plant.site().bed_mass(), 0.95 * free.plant.site().bed_mass());
  EXPECT_LE(slow.plant.site().spilled_mass(), 20.0);
}

// All of a pass at a tenth: the swing has its little speed at once there, and one that turned round with as much left in the bucket as at full speed has left
// the bed before that runs out. (On this bench the bucket does not open before its lip is over the bed: slow_pour_test has that.)
TEST(SlowedJoints, LittleRunsOutBesideTheBed) {
  for (const int pass : {1, 2, 3, 4, 5}) {
    Loading run(1, start_pose());
    run.plant.pours_by_tilt = true;
    go_to_swing(run, pass);
    const double had = run.plant.site().bed_mass(), spilled = run.plant.site().spilled_mass(), began = run.seconds;
    for (std::size_t j = 0; j < joints; ++j) run.plant.most_speed[j] = 0.1 * run.machine.joint[j].velocity_max;
    for (const double end = run.seconds + 180.0; run.seconds < end && run.last.phase != BERM_PHASE_DIG;) run.step();
    ASSERT_EQ(run.last.phase, BERM_PHASE_DIG) << "pass " << pass;
    EXPECT_GT(run.seconds - began, 40.0) << "it was not slowed: the test shows nothing";
    EXPECT_GT(run.plant.site().bed_mass(), had + 1500.0) << "pass " << pass << ": the rest fell between bed and dig";
    EXPECT_LE(run.plant.site().spilled_mass() - spilled, 20.0) << "pass " << pass;
    std::cout << "pass " << pass << ": " << run.plant.site().bed_mass() - had << " kg in the bed, " << run.seconds - began << " s\n";
  }
}

// Which ends of the scanners' ranges are asked for during a swing to the truck whose first seconds are slowed to a tenth.
int ends_asked_for(double slowed_s) {
  Loading run(1, start_pose());
  go_to_swing(run, 1);
  std::array<std::array<bool, 2>, 2> asked{};
  const double begin = run.seconds;
  for (std::size_t j = 0; j < joints; ++j) run.plant.most_speed[j] = 0.1 * run.machine.joint[j].velocity_max;
  while (run.seconds < begin + slowed_s || (run.seconds < begin + slowed_s + 20.0 && run.last.phase == BERM_PHASE_SWING_TO_TRUCK)) {
    if (run.seconds >= begin + slowed_s) std::fill(run.plant.most_speed.begin(), run.plant.most_speed.end(), 10.0);
    run.step();
    for (std::size_t i = 0; i < asked.size(); ++i) {
      asked[i][0] = asked[i][0] || run.last.pan[i].goal <= run.machine.scanner[i].pan_low;
      asked[i][1] = asked[i][1] || run.last.pan[i].goal >= run.machine.scanner[i].pan_high;
    }
  }
  return asked[0][0] + asked[0][1] + asked[1][0] + asked[1][1];
}

TEST(SlowedSwing, ForLongHasBothScannersLookAtTheirWholeRanges) {
  EXPECT_EQ(ends_asked_for(15.0), 4) << "else the ground that its looks leave out grows old";
  EXPECT_LT(ends_asked_for(2.0), 4) << "for a moment changes nothing";
}

TEST(SlowedSwing, WhatIsHeldIsNotSlowed) {
  Loading run(1, start_pose());
  go_to_swing(run, 1);
  for (int k = 0; k < 100; ++k) run.step();
  run.plant.kernel_runs = false;
  for (int k = 0; k < 200; ++k) run.step();
  run.plant.kernel_runs = true;
  for (int k = 0; k < 200; ++k) run.step();
  EXPECT_EQ(run.sequencer.slow_down().spans(), 0);
  EXPECT_EQ(run.sequencer.slow_down().seconds(), 0.0);
}

TEST(SlowedBucket, IsGivenTheTimeToOpen) {
  const auto opened_to = [](double share) {
    Loading run(1, start_pose());
    run.plant.weighs = false;  // so that nothing but the time since it opened tells when it is empty
    go_to_swing(run, 1);
    run.plant.most_speed[bucket] = share * run.machine.joint[bucket].velocity_max;
    const double end = run.seconds + 60.0;
    while (run.seconds < end && run.last.phase != BERM_PHASE_SWING_TO_DIG) run.step();
    EXPECT_LT(run.seconds, end) << "it did not swing back";
    return degrees(run.plant.angle()[bucket]);
  };
  EXPECT_GT(opened_to(quarter), opened_to(1.0) - 3.0);
}

// As while the kernel learns the ground: a drag at a tenth comes after its path late, and is no stall.
TEST(SlowedDig, AtATenthStillFillsTheBucket) {
  constexpr double tenth = 0.1;
  Loading run(1, start_pose());
  for (std::size_t j = 0; j < joints; ++j) run.plant.most_speed[j] = tenth * run.machine.joint[j].velocity_max;
  double dig_s = 0.0;
  for (; run.seconds < 300.0 && run.last.phase != BERM_PHASE_SWING_TO_TRUCK; run.step()) dig_s += run.last.phase == BERM_PHASE_DIG ? run.machine.cycle : 0.0;
  ASSERT_LT(run.seconds, 300.0) << "it did not dig";
  EXPECT_GT(dig_s, 10.0) << "it was not slowed: the test shows nothing";
  EXPECT_GT(run.plant.payload_kg(), 1100.0);
}

TEST(SlowedArm, EveryJointAtAQuarterStillDumpsIntoTheBed) {
  Loading run(1, start_pose());
  go_to_swing(run, 1);
  for (std::size_t j = 0; j < joints; ++j) run.plant.most_speed[j] = quarter * run.machine.joint[j].velocity_max;
  const double end = run.seconds + 120.0;
  while (run.seconds < end && run.last.phase != BERM_PHASE_SWING_TO_DIG) run.step();
  ASSERT_LT(run.seconds, end) << "it did not dump";
  for (int k = 0; k < 300; ++k) run.step();
  EXPECT_GE(run.plant.site().bed_mass(), 1400.0);
  EXPECT_LE(run.plant.site().spilled_mass(), 20.0);
  EXPECT_LE(run.plant.payload_kg(), 30.0) << "swung back before it was empty";
  EXPECT_EQ(run.plant.findings().wall_contacts, 0);
}

}  // namespace
