// How the sequencer digs on the miniature bench: into the soil, down to the zone's floor, out of it, and for how much.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app_bench/events.hpp"
#include "app_bench/loading.hpp"

namespace {

using namespace berm;
using namespace berm::app;
using app_bench::Loading;
using app_bench::start_pose;

// Over the start its way turns, and the bucket is not to be curled yet.
TEST(Sequencer, TheBucketComesDownIntoTheSoilWithoutStandingOverIt) {
  Loading run(1, start_pose());
  run.plant.has_pressures = true;
  std::uint32_t phase = 0;
  ArmPoints before;
  double began_s = 0.0, way = 0.0;
  int cycles = 0;
  for (int digs = 0; digs < 7 && run.seconds < 200.0; run.step()) {
    const ArmPoints now = forward(run.machine, run.plant.angle());
    const double speed = std::hypot(now.tip.r - before.tip.r, now.tip.z - before.tip.z) / run.machine.cycle;
    before = now;
    if (run.last.phase == BERM_PHASE_DIG && phase != BERM_PHASE_DIG) ++digs, began_s = run.seconds;
    phase = run.last.phase;
    if (digs > 1 && phase == BERM_PHASE_DIG && run.seconds < began_s + 0.5) {
      ASSERT_GT(speed, 1.2) << "dig " << digs << ", " << run.seconds - began_s << " s";
      way += speed * run.machine.cycle;
      ++cycles;
    }
  }
  ASSERT_GT(cycles, 200);
  EXPECT_GT(way / (cycles * run.machine.cycle), 2.75) << "m/s in the mean";
}

// Nothing but the app slows a bucket that comes down into a dig before the kernel foresees its stop under the zone's floor: where the soil lies low, the soil does not.
TEST(Sequencer, TheBucketComesDownIntoADigSlowlyEnoughToStopOverTheZonesFloor) {
  Loading run(2, start_pose());
  run.plant.has_pressures = true;
  double zone_floor = -9.0, least = 9.0;
  for (const DigZone& zone : app_bench::bench().dig_zones) zone_floor = std::max(zone_floor, zone.floor);
  int digs = 0;
  std::uint32_t phase = 0;
  for (; digs < 12 && run.seconds < 250.0; run.step()) {
    digs += run.last.phase == BERM_PHASE_DIG && phase != BERM_PHASE_DIG;
    phase = run.last.phase;
    const Observation o = observe(run.plant.state());
    if (phase == BERM_PHASE_DIG) least = std::min(least, LowerEdge(run.machine, preview(run.machine, o.angle, o.velocity)).lowest() - zone_floor);
  }
  EXPECT_EQ(digs, 12);
  EXPECT_GT(least, Skyline::over_floor);
  EXPECT_LT(least, 0.5) << "no dig comes near the floor: the test shows nothing";
}

// A full bucket curls as fast as it can while the boom is on its way up: soil slides off one that comes up open. Stick and swing stand.
TEST(Sequencer, AFullBucketCurlsAndRisesAtOnce) {
  const app_bench::Events events;
  Loading run(1, start_pose(), events.fd());
  while (events.named("dug").empty() && run.seconds < 60.0) run.step();
  ASSERT_LT(run.seconds, 60.0);
  const double stick_was = run.plant.angle()[stick];
  double fastest_curl = 0.0, fastest_rise = 0.0;
  int cycles = 0;
  for (; run.last.phase == BERM_PHASE_DIG && cycles < 300; ++cycles) {
    fastest_curl = std::min(fastest_curl, run.last.velocity[bucket]);
    fastest_rise = std::max(fastest_rise, run.last.velocity[boom]);
    EXPECT_EQ(run.last.velocity[swing], 0.0);
    run.step();
  }
  EXPECT_LT(cycles, 150) << "the script takes over while the bucket curls";
  EXPECT_LT(fastest_curl, -0.9 * run.machine.joint[bucket].velocity_max);
  EXPECT_GT(fastest_rise, 0.4 * run.machine.joint[boom].velocity_max);
  EXPECT_NEAR(run.plant.angle()[stick], stick_was, radians(3.0));
}

// Digs until soil comes into the bucket in the dig after this many.
void go_into_dig(Loading& run, const app_bench::Events& events, std::size_t digs) {
  constexpr double some_kg = 300.0;
  while (run.seconds < 300.0 && !(events.named("dig").size() == digs + 1 && events.named("dug").size() == digs && run.plant.payload_kg() > some_kg)) run.step();
  ASSERT_LT(run.seconds, 300.0);
}

// What soil holds is given up after a second, what stands without a force after three: by the cylinders' pressures, which the implements' weight has to be known for.
TEST(Sequencer, AStallIsToldByWhatPressesOnTheBucket) {
  constexpr double until_held = 0.4;  // s, until the path's reference is so far ahead that it waits
  struct Held { double force_n, after_s; const char* why; };
  for (const Held& held : {Held{150e3, 1.0, "stalled"}, Held{5e3, 3.0, "standing"}}) {
    const app_bench::Events events;
    Loading run(1, start_pose(), events.fd());
    run.plant.has_pressures = true;
    go_into_dig(run, events, 2);
    if (HasFatalFailure()) return;
    const std::size_t dug = events.named("dug").size();
    run.plant.held_by_n = held.force_n;
    const double begin = run.seconds;
    while (events.named("dug").size() == dug && run.seconds < begin + 10.0) run.step();
    ASSERT_GT(events.named("dug").size(), dug) << held.why;
    EXPECT_EQ(events.named("dug").back().at("why"), held.why);
    EXPECT_NEAR(run.seconds - begin, until_held + held.after_s, 0.3) << held.why;
  }
}

// By the force a bucket is full at its goal.
TEST(Sequencer, DigsEndWhenTheBucketIsFull) {
  const app_bench::Events events;
  Loading run(1, start_pose(), events.fd());
  run.plant.has_pressures = true;
  while (run.seconds < 110.0) run.step();
  const auto dug = events.named("dug");
  ASSERT_GE(dug.size(), 5u);
  int full = 0;
  for (std::size_t k = 1; k < dug.size(); ++k) {
    if (dug[k].at("why") != "full") continue;
    ++full;
    EXPECT_NEAR(dug[k].at("felt_kg").get<double>(), events.named("dig")[k].at("goal_kg").get<double>(), 60.0) << "dig " << k;
  }
  EXPECT_GE(full, 3);
}

// A dig is priced with the work that the soil took in the digs before, and with the swing to the bed.
TEST(Sequencer, TheWorkOfTheDigsBeforeAndTheSwingAreInTheNextDigsPrice) {
  const app_bench::Events events;
  Loading run(1, start_pose(), events.fd());
  run.plant.has_pressures = true;
  while (run.seconds < 110.0) run.step();
  const auto dug = events.named("dug"), digs = events.named("dig"), next = events.named("next_dig");
  ASSERT_GE(dug.size(), 4u);
  ASSERT_GT(next.size(), dug.size());
  const double usual_kj = 135.0, tip_speed = 1.2;
  EXPECT_NEAR(next[0].at("effort_kj").get<double>(), usual_kj, 1e-9);
  for (std::size_t k = 2; k < dug.size(); ++k) {  // the first was weighed
    const double goal_kg = digs[k].at("goal_kg"), took_kj = tip_speed * goal_kg * dug[k].at("impulse_kns").get<double>() / dug[k].at("felt_kg").get<double>();
    EXPECT_NEAR(next[k + 1].at("effort_kj").get<double>(), took_kj, 0.01) << "after dig " << k;
    EXPECT_GT(std::fabs(took_kj - usual_kj), 2.0);
    EXPECT_GT(next[k + 1].at("dig_s").get<double>(), 2.5);
    EXPECT_GT(next[k + 1].at("swing_s").get<double>(), 5.5) << "to the bed and back";
    EXPECT_GT(next[k + 1].at("cost_s").get<double>(), next[k + 1].at("dig_s").get<double>() + next[k + 1].at("swing_s").get<double>());
  }
}

// The loop on the force does not go under the site's goal either.
TEST(Sequencer, NoDigGoesUnderTheSitesGoal) {
  SiteModel site = app_bench::bench();
  constexpr double level = -1.2;
  site.goal = {{3.9, -4.2, 10.5, 4.2, level}};
  Loading run(1, start_pose(), -1, site);
  run.plant.has_pressures = true;
  double lowest = 0.0;
  int digs = 0;
  for (std::uint32_t phase = 0; digs < 8 && run.seconds < 200.0; phase = run.last.phase) {
    run.step();
    digs += run.last.phase == BERM_PHASE_DIG && phase != BERM_PHASE_DIG;
    if (run.last.phase == BERM_PHASE_DIG) lowest = std::min(lowest, bucket_underside(run.machine, run.plant.angle()));
  }
  EXPECT_EQ(digs, 8);
  EXPECT_GT(lowest, level - 0.3) << "as it comes down; else a decimetre";
  EXPECT_LT(lowest, level + 0.3) << "no dig comes near it: the test shows nothing";
}

// Dug for a truck that stands as usual, and for one whose bed lies at the end of the arm's reach: there a heap would slide off before the near wall.
TEST(Sequencer, DigsLessForADumpThatTheArmHardlyReaches) {
  const auto first_goal_kg = [](double farther) {
    const app_bench::Events events;
    Loading run(1, start_pose(), events.fd());
    run.finder.truck.pose.middle[1] += farther;
    while (events.named("dig").empty() && run.seconds < 60.0)
      for (int k = 0; k < 10; ++k) run.step();
    const auto digs = events.named("dig");
    return digs.empty() ? 0.0 : digs[0].at("goal_kg").get<double>();
  };
  const TruckBed bed = app_bench::bench_bed();
  const double heaped_kg = app_bench::zx200().bucket_payload_kg, whole_kg = TruckFill::aim_share * app_bench::bench().place.target_kg / 12.0;
  ASSERT_GT(whole_kg, 0.92 * heaped_kg);
  EXPECT_NEAR(first_goal_kg(0.0), whole_kg, 1.0);
  const double at_the_end = first_goal_kg(farthest_dump(app_bench::zx200(), bed.wall_top) - std::hypot(bed.centre_x, bed.centre_y));
  EXPECT_LT(at_the_end, 0.91 * heaped_kg);
  EXPECT_GT(at_the_end, 0.84 * heaped_kg);
}

}  // namespace
