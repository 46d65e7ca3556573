// A pass that was stopped on its way to the truck, and goes on from where the stop and its mending left it.
#include <gtest/gtest.h>

#include "app_bench/events.hpp"
#include "app_bench/loading.hpp"

namespace {

using namespace berm::app;
using berm::app_bench::Loading;
using berm::app_bench::start_pose;

class ReachAgainOnTheBench : public testing::Test {
protected:
  // From the beginning; a phase that does not come in a minute does not come.
  static void run_to(Loading& run, std::uint16_t phase) {
    while (run.last.phase != phase && run.seconds < 60.0) run.step();
  }
  static void stop(Loading& run) {
    run.plant.kernel_runs = false;
    for (int k = 0; k < 100; ++k) run.step();
  }
  static void expect_no_contact(const Loading& run) {
    EXPECT_EQ(run.plant.findings().wall_contacts, 0);
    EXPECT_EQ(run.plant.findings().ground_contacts, 0);
  }
  berm::app_bench::Events events_;
};

// Short of the dump and beyond it: the arm, which had begun to reach out, waits for the swing again.
TEST_F(ReachAgainOnTheBench, TheArmWaitsUntilTheSwingStandsOverTheBed) {
  for (const double moved_deg : {-25.0, -8.0, 9.0}) {
    Loading run(1, start_pose(), events_.fd());
    const std::size_t before = events_.named("reaches_again").size();
    run_to(run, BERM_PHASE_SWING_TO_TRUCK);
    double folded = 0.0;
    while (run.plant.angle()[stick] < folded + radians(4.0) && run.seconds < 60.0) {
      run.step();
      folded = std::min(folded, run.plant.angle()[stick]);
    }
    ASSERT_EQ(run.last.phase, BERM_PHASE_SWING_TO_TRUCK) << "it was to reach out now";
    stop(run);
    const double out = run.plant.angle()[stick], over_bed = run.plant.angle()[swing], dump = radians(events_.named("script").back().at("truck_bearing_deg").get<double>());
    run.plant.put(swing, over_bed + radians(moved_deg));
    for (int k = 0; k < 100; ++k) run.step();
    const double carried_kg = run.plant.payload_kg();
    run.plant.kernel_runs = true;
    const double resumed = run.seconds;
    bool drew_in = false;
    while (run.last.phase != BERM_PHASE_DUMP && run.seconds < resumed + 30.0) {
      run.step();
      const Joints& q = run.plant.angle();
      drew_in = drew_in || q[stick] < out - radians(2.0);
      if (std::fabs(q[swing] - dump) > radians(3.0)) {
        ASSERT_LT(q[stick], out + radians(1.0)) << "reached out " << degrees(q[swing] - dump) << " degrees from the dump";
      }
      ASSERT_GT(run.plant.payload_kg(), 0.97 * carried_kg) << "spilled on the way";
    }
    ASSERT_LT(run.seconds, resumed + 30.0) << "the pass did not go on, from " << moved_deg;
    EXPECT_TRUE(drew_in) << moved_deg;
    while (run.plant.site().bed_mass() < 1000.0 && run.seconds < resumed + 40.0) run.step();
    EXPECT_GE(run.plant.site().bed_mass(), 1000.0);
    EXPECT_EQ(events_.named("reaches_again").size(), before + 1);
    expect_no_contact(run);
  }
}

// The bucket had begun to open: it is held level until it is over the bed again.
TEST_F(ReachAgainOnTheBench, NothingIsPouredBesideTheBed) {
  for (const double moved_deg : {-25.0, 9.0}) {
    Loading run(1, start_pose(), events_.fd());
    run_to(run, BERM_PHASE_DUMP);
    ASSERT_LT(run.seconds, 60.0);
    stop(run);
    const double over_bed = run.plant.angle()[swing], carried_kg = run.plant.payload_kg();
    ASSERT_GT(carried_kg, 1000.0);
    run.plant.put(swing, over_bed + radians(moved_deg));
    for (int k = 0; k < 100; ++k) run.step();
    run.plant.kernel_runs = true;
    const double resumed = run.seconds;
    while (std::fabs(run.plant.angle()[swing] - over_bed) > radians(4.0) && run.seconds < resumed + 30.0) {
      run.step();
      ASSERT_GT(run.plant.payload_kg(), 0.97 * carried_kg) << "poured " << degrees(run.plant.angle()[swing] - over_bed) << " degrees from the dump";
    }
    ASSERT_LT(run.seconds, resumed + 30.0);
    const double before_kg = run.plant.site().bed_mass();
    while (run.last.phase != BERM_PHASE_SWING_TO_DIG && run.seconds < resumed + 40.0) run.step();
    for (int k = 0; k < 200; ++k) run.step();  // the last of it slides when the swing has turned round
    EXPECT_GE(run.plant.site().bed_mass() - before_kg, 0.9 * carried_kg) << "the pass did not go on, from " << moved_deg;
    expect_no_contact(run);
  }
}

// A bucket that was wide open with its load stuck in it is none that has emptied while it is brought back.
TEST_F(ReachAgainOnTheBench, WhatIsHeldIsNotTakenForPoured) {
  Loading run(1, start_pose(), events_.fd());
  run.plant.sticks = 0.8;
  run_to(run, BERM_PHASE_DUMP);
  while (run.plant.angle()[bucket] < radians(-25.0) && run.seconds < 60.0) run.step();
  ASSERT_EQ(run.last.phase, BERM_PHASE_DUMP);
  stop(run);
  const double over_bed = run.plant.angle()[swing];
  run.plant.put(swing, over_bed - radians(25.0));
  run.plant.most_speed[swing] = radians(6.0);  // longer on its way than a bucket takes to empty
  run.plant.kernel_runs = true;
  const double resumed = run.seconds;
  while (run.last.phase == BERM_PHASE_DUMP && run.seconds < resumed + 30.0) run.step();  // until the plan is in charge again
  while (run.last.phase != BERM_PHASE_DUMP && run.seconds < resumed + 30.0) {
    run.step();
    ASSERT_NE(run.last.phase, BERM_PHASE_SWING_TO_DIG) << degrees(run.plant.angle()[swing] - over_bed) << " degrees from the dump";
  }
  EXPECT_LT(std::fabs(run.plant.angle()[swing] - over_bed), radians(3.0));
  // There it is given its time to empty anew.
  run.plant.sticks = 0.0;
  const double held_kg = run.plant.payload_kg(), before_kg = run.plant.site().bed_mass();
  ASSERT_GT(held_kg, 800.0);
  while (run.last.phase == BERM_PHASE_DUMP && run.seconds < resumed + 40.0) run.step();
  for (int k = 0; k < 200; ++k) run.step();
  EXPECT_GE(run.plant.site().bed_mass() - before_kg, 0.9 * held_kg);
}

// On the way back with the last of its load still running out nothing is held back.
TEST_F(ReachAgainOnTheBench, OnTheWayBackItGoesOn) {
  Loading run(1, start_pose(), events_.fd());
  run_to(run, BERM_PHASE_DUMP);
  run_to(run, BERM_PHASE_SWING_TO_DIG);
  ASSERT_GT(run.plant.payload_kg(), 100.0);
  stop(run);
  run.plant.kernel_runs = true;
  const double resumed = run.seconds;
  while (run.last.phase != BERM_PHASE_DIG && run.seconds < resumed + 15.0) run.step();
  EXPECT_LT(run.seconds, resumed + 15.0);
  EXPECT_TRUE(events_.named("reaches_again").empty());
}

// Stopped with half of it poured: what was poured before the stop is in the truck, and in its books.
TEST_F(ReachAgainOnTheBench, WhatWasPouredBeforeAStopIsBooked) {
  for (const double moved_deg : {0.0, -8.0}) {
    Loading run(1, start_pose(), events_.fd());
    const std::size_t before = events_.named("pass").size();
    run_to(run, BERM_PHASE_DUMP);
    const double carried_kg = run.plant.payload_kg();
    while (run.plant.payload_kg() > 0.6 * carried_kg && run.seconds < 60.0) run.step();
    stop(run);
    const double poured_kg = run.plant.site().bed_mass();
    ASSERT_GT(poured_kg, 0.3 * carried_kg);
    run.plant.put(swing, run.plant.angle()[swing] + radians(moved_deg));
    run.plant.kernel_runs = true;
    while (events_.named("pass").size() == before && run.seconds < 90.0)
      for (int k = 0; k < 10; ++k) run.step();
    ASSERT_EQ(events_.named("pass").size(), before + 1);
    EXPECT_NEAR(events_.named("pass").back().at("payload_kg").get<double>(), run.plant.site().bed_mass(), 0.03 * carried_kg) << "moved by " << moved_deg << " degrees";
  }
}

// By the cylinders' pressures, which a first pass has taught what the implements weigh: what left the bucket during the stop fell into the bed, and the weight
// that changes while it is brought back over it is none that fell beside.
TEST_F(ReachAgainOnTheBench, NothingOfAStopIsBookedAsFallenBeside) {
  for (const double moved_deg : {0.0, -20.0}) {
    Loading run(1, start_pose(), events_.fd());
    run.plant.has_pressures = true;
    const std::size_t before = events_.named("pass").size();
    while (events_.named("pass").size() == before && run.seconds < 60.0)
      for (int k = 0; k < 10; ++k) run.step();
    const double first_kg = run.plant.site().bed_mass();
    while (run.last.phase != BERM_PHASE_DUMP && run.seconds < 90.0) run.step();
    const double carried_kg = run.plant.payload_kg();
    while (run.plant.payload_kg() > 0.9 * carried_kg && run.seconds < 90.0) run.step();
    stop(run);
    ASSERT_LT(run.plant.payload_kg(), 0.8 * carried_kg) << "it poured on meanwhile";
    run.plant.put(swing, run.plant.angle()[swing] + radians(moved_deg));
    run.plant.kernel_runs = true;
    while (events_.named("pass").size() == before + 1 && run.seconds < 120.0)
      for (int k = 0; k < 10; ++k) run.step();
    ASSERT_EQ(events_.named("pass").size(), before + 2);
    EXPECT_EQ(events_.named("pass").back().at("beside_kg"), 0.0) << "moved by " << moved_deg << " degrees";
    EXPECT_NEAR(events_.named("pass").back().at("payload_kg").get<double>(), run.plant.site().bed_mass() - first_kg, 0.03 * carried_kg) << "moved by " << moved_deg << " degrees";
  }
}

// It is drawn in at its own pace, not at that of a swing that is held because it is out.
TEST_F(ReachAgainOnTheBench, ASwingThatIsHeldDoesNotHoldTheArm) {
  Loading run(1, start_pose(), events_.fd());
  run_to(run, BERM_PHASE_DUMP);
  ASSERT_LT(run.seconds, 60.0);
  stop(run);
  run.plant.put(swing, run.plant.angle()[swing] - radians(25.0));
  run.plant.put(stick, run.plant.angle()[stick] + radians(10.0));  // farther out than where a bucket begins to open: a long way in
  run.plant.most_speed[swing] = radians(0.5);
  run.plant.kernel_runs = true;
  while (events_.named("reaches_again").empty() && run.seconds < 90.0) run.step();
  const double out = run.plant.angle()[stick];
  for (int k = 0; k < 150; ++k) run.step();
  EXPECT_LT(run.plant.angle()[stick], out - radians(20.0)) << "in a second and a half";
}

// Where it stands over the bed nothing is begun anew.
TEST_F(ReachAgainOnTheBench, OverTheBedItGoesOn) {
  Loading run(1, start_pose(), events_.fd());
  run_to(run, BERM_PHASE_DUMP);
  for (int k = 0; k < 30; ++k) run.step();
  stop(run);
  run.plant.kernel_runs = true;
  const double resumed = run.seconds;
  while (run.last.phase != BERM_PHASE_SWING_TO_DIG && run.seconds < resumed + 8.0) run.step();
  EXPECT_LT(run.seconds, resumed + 8.0);
  EXPECT_TRUE(events_.named("reaches_again").empty());
}

}  // namespace
