// Trucks that come and go otherwise than the cycle would have it: while the kernel keeps the machine, not at all, too early.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "app_bench/events.hpp"
#include "app_bench/loading.hpp"

namespace {

using namespace berm;
using namespace berm::app;
using app_bench::Loading;
using app_bench::start_pose;

class SequencerTrucks : public ::testing::Test {
protected:
  // Calls for the operator with that reason.
  long calls(const std::string& reason) const {
    const auto all = events_.named("operator_needed");
    return std::count_if(all.begin(), all.end(), [&](const auto& e) { return e.at("reason") == reason; });
  }
  // The face has soil for two of these.
  static SiteModel small_trucks() {
    SiteModel site = app_bench::bench();
    site.place.target_kg = 6000.0;
    return site;
  }
  static void fill(Loading& run) {
    while (!run.last.horn && run.seconds < 600.0) run.step();
    ASSERT_TRUE(run.last.horn) << "the truck is not full after " << run.seconds << " s";
  }
  static void carry_a_bucket_to_the_truck(Loading& run) {
    while (run.last.phase != BERM_PHASE_SWING_TO_TRUCK && run.seconds < 120.0) run.step();
    ASSERT_LT(run.seconds, 120.0);
    run.go(1.0);
    ASSERT_GT(run.plant.payload_kg(), 500.0);
  }
  // The spotter's truck drives off.
  static void leave(Loading& run) {
    run.plant.truck_parked = false;
    run.plant.truck_leaves = true;
    run.go(8.0);
    run.plant.truck_leaves = false;
  }
  static void come(Loading& run) {
    run.plant.site().new_truck();
    run.plant.truck_parked = true;
  }

  app_bench::Events events_;
};

TEST_F(SequencerTrucks, AreExchangedWhileTheKernelKeepsTheMachine) {
  Loading run(2, start_pose(), events_.fd(), small_trucks());
  fill(run);
  run.go(0.4);  // in the middle of the horn
  run.plant.stop_reason = BERM_STOP_INTRUDER;
  run.plant.kernel_runs = false;
  run.go(1.0);
  EXPECT_FALSE(run.last.horn) << "one blast, though the kernel keeps the machine";
  leave(run);
  run.go(8.0);
  const std::size_t looks = run.finder.looks.size();
  come(run);
  run.go(5.0);
  run.plant.kernel_runs = true;
  run.go(60.0);
  EXPECT_GT(run.finder.looks.size(), looks) << "the second truck was taken for the first";
  EXPECT_GT(run.plant.site().bed_mass(), 500.0) << "and is not loaded";
}

TEST_F(SequencerTrucks, AFullOneThatStaysHearsTheHornAgainAndTheOperatorIsTold) {
  Loading run(2, start_pose(), events_.fd(), small_trucks());
  fill(run);
  while (run.last.horn) run.step();
  int blasts = 0;
  for (bool before = false; run.seconds < 600.0 && blasts < 3;) {
    run.step();
    blasts += run.last.horn && !before;
    before = run.last.horn;
  }
  EXPECT_EQ(blasts, 3);
  run.go(1.0);
  EXPECT_EQ(calls("truck stays"), 1);
  leave(run);
  const std::size_t looks = run.finder.looks.size();
  come(run);
  run.go(60.0);
  EXPECT_GT(run.finder.looks.size(), looks);
}

TEST_F(SequencerTrucks, TheOperatorIsToldOnceThatNoneComes) {
  Loading run(1, start_pose(), events_.fd());
  run.plant.truck_parked = false;
  run.go(280.0);
  EXPECT_EQ(calls("no truck comes"), 0);
  run.go(400.0);
  EXPECT_EQ(calls("no truck comes"), 1);
}

TEST_F(SequencerTrucks, WhatWasMeantForOneThatLeftEarlyGoesBackToTheFace) {
  Loading run(2, start_pose(), events_.fd());
  carry_a_bucket_to_the_truck(run);
  const double carried = run.plant.payload_kg(), spilled = run.plant.site().spilled_mass();
  leave(run);
  ASSERT_EQ(events_.named("truck_lost").size(), 1u);
  EXPECT_EQ(events_.named("truck_lost").front().at("why"), "left");
  run.go(30.0);
  EXPECT_NEAR(run.plant.payload_kg(), carried, 0.05 * carried) << "poured where no truck stands";
  EXPECT_NEAR(run.plant.site().spilled_mass(), spilled, 0.05 * carried);
  for (const double v : run.last.velocity) EXPECT_NEAR(v, 0.0, 0.01);
  const std::size_t looks = run.finder.looks.size();
  come(run);
  while (run.last.phase != BERM_PHASE_DIG && run.seconds < 300.0) run.step();
  EXPECT_GT(run.finder.looks.size(), looks);
  EXPECT_EQ(run.plant.site().bed_mass(), 0.0) << "it digs anew first";
  while (!run.sequencer.finished() && run.seconds < 900.0) run.step();
  ASSERT_TRUE(run.sequencer.finished());
  EXPECT_EQ(run.plant.findings().wall_contacts, 0);
  EXPECT_EQ(run.plant.findings().ground_contacts, 0);
  EXPECT_GE(run.plant.site().bed_mass(), 0.96 * app_bench::bench().place.target_kg);
  EXPECT_LE(run.plant.site().bed_mass(), 1.04 * app_bench::bench().place.target_kg);
}

// A spotter who falls silent has not said that another truck stands there: what was put into this one is not forgotten.
TEST_F(SequencerTrucks, OneThatIsAdmittedAgainIsNotOverloaded) {
  Loading run(1, start_pose(), events_.fd());
  while (run.plant.site().bed_mass() < 6000.0 && run.seconds < 400.0) run.step();
  const double had = run.plant.site().bed_mass();
  ASSERT_GE(had, 6000.0);
  run.plant.truck_parked = false;
  run.go(20.0);
  ASSERT_EQ(events_.named("truck_lost").size(), 1u);
  EXPECT_EQ(events_.named("truck_lost").front().at("why"), "no longer admitted");
  run.plant.truck_parked = true;
  while (!run.sequencer.finished() && run.seconds < 900.0) run.step();
  ASSERT_TRUE(run.sequencer.finished());
  EXPECT_GE(run.plant.site().bed_mass(), 0.96 * app_bench::bench().place.target_kg);
  EXPECT_LE(run.plant.site().bed_mass(), 1.04 * app_bench::bench().place.target_kg);
}

TEST_F(SequencerTrucks, AShortSilenceOfTheSpotterChangesNothing) {
  Loading run(1, start_pose(), events_.fd());
  carry_a_bucket_to_the_truck(run);
  run.plant.truck_parked = false;
  run.go(1.0);
  run.plant.truck_parked = true;
  run.go(20.0);
  EXPECT_TRUE(events_.named("truck_lost").empty());
  EXPECT_EQ(run.finder.looks.size(), 1u);
  EXPECT_GT(run.plant.site().bed_mass(), 500.0);
}

// The second truck's place is swept from where the machine waits for it, and the sweep goes on while it swings to its first dig.
class LooksOnTheWay : public SequencerTrucks {
protected:
  LooksOnTheWay() : run(2, start_pose(), events_.fd(), small_trucks()) {
    fill(run);
    first_kg_ = run.plant.site().bed_mass();
    leave(run);
    run.go(10.0);
  }
  void to_phase(std::uint16_t phase) {
    for (const double end = run.seconds + 60.0; run.last.phase != phase && run.seconds < end;) run.step();
    ASSERT_EQ(run.last.phase, phase);
  }
  void finish() {
    while (!run.sequencer.finished() && run.seconds < 1200.0) run.step();
    ASSERT_TRUE(run.sequencer.finished());
    EXPECT_EQ(run.plant.findings().wall_contacts, 0);
    EXPECT_GE(run.plant.site().bed_mass(), 0.94 * small_trucks().place.target_kg);
    EXPECT_LE(run.plant.site().bed_mass(), 1.02 * first_kg_) << "buckets of this bench are always full";
  }

  Loading run;

private:
  double first_kg_ = 0.0;
};

TEST_F(LooksOnTheWay, TheNextTruckIsKnownBeforeTheDigAndTheFirstWasLookedAtInAStop) {
  const auto first = run.finder.looks.front();
  EXPECT_TRUE(std::all_of(first.turned.begin(), first.turned.end(), [](double turned) { return turned == 0.0; }));
  const double waits = run.plant.angle()[swing];
  EXPECT_GT(waits, radians(15.0)) << "the far end is not seen from the dig";
  EXPECT_LT(waits, radians(30.0)) << "trucks pass there";
  come(run);
  to_phase(BERM_PHASE_SWING_TO_DIG);
  EXPECT_EQ(events_.named("recognised").size(), 1u) << "the first one's";
  to_phase(BERM_PHASE_DIG);
  ASSERT_EQ(run.finder.looks.size(), 2u);
  const auto& look = run.finder.looks.back();
  EXPECT_NEAR(look.turned.front(), 0.0, 1e-3);
  EXPECT_LT(look.turned.back(), radians(-5.0));
  EXPECT_NEAR(look.turned.back(), run.plant.angle()[swing] - waits, radians(12.0));
  ASSERT_EQ(events_.named("recognised").size(), 2u);
  const auto came = events_.named("truck"), began = events_.named("dig");
  double first_dig = 0.0, second_dig = 0.0;
  for (const auto& phase : events_.named("phase")) {
    if (phase.at("phase") != "dig" || phase.at("pass") != 1) continue;
    (phase.at("truck") == 1 ? first_dig : second_dig) = phase.at("time_s").get<double>();
  }
  EXPECT_LT(second_dig - came[1].at("time_s").get<double>(), first_dig - came[0].at("time_s").get<double>() - 1.5);
  // Bearings from the head, of each scanline where it was then: beyond the bed's far end.
  double farthest = 0.0;
  for (const ScanPoint& p : look.points) {
    if (static_cast<double>(p.y) < look.viewpoint[1] + 2.0) continue;
    farthest = std::max(farthest, std::atan2(static_cast<double>(p.y) - look.viewpoint[1], static_cast<double>(p.x) - look.viewpoint[0]));
  }
  const TruckBed bed = app_bench::bench_bed();
  EXPECT_GT(farthest, std::atan2(bed.centre_y - 0.5 * bed.width - look.viewpoint[1], bed.centre_x - 0.5 * bed.length - look.viewpoint[0]));
  finish();
  EXPECT_EQ(run.finder.looks.size(), 2u);
}

TEST_F(LooksOnTheWay, OneThatIsNotRecognisedIsLookedAtAgainInAStop) {
  run.finder.truck.found = false;
  come(run);
  for (const double end = run.seconds + 60.0; events_.named("no_truck").empty() && run.seconds < end;) {
    run.step();
    ASSERT_NE(run.last.phase, BERM_PHASE_DIG);
  }
  ASSERT_EQ(events_.named("no_truck").size(), 1u);
  run.finder.truck.found = true;
  to_phase(BERM_PHASE_DIG);
  ASSERT_EQ(run.finder.looks.size(), 3u);
  const auto& again = run.finder.looks.back();
  EXPECT_TRUE(std::all_of(again.turned.begin(), again.turned.end(), [](double turned) { return turned == 0.0; }));
  finish();
}

TEST_F(LooksOnTheWay, ADigDoesNotBeginBeforeTheTruckIsKnown) {
  run.finder.cycles = 1500;  // of a slow recogniser
  come(run);
  to_phase(BERM_PHASE_DIG);
  const auto known = events_.named("recognised");
  ASSERT_EQ(known.size(), 2u);
  EXPECT_GT(run.seconds, known.back().at("time_s").get<double>());
  finish();
}

// The boom hides them from then on. A pan that never comes there keeps no machine standing without a word.
TEST_F(LooksOnTheWay, AKnownTruckIsNotDugForBeforeTheOtherScannerHasSeenTheFeet) {
  const double outmost = run.machine.scanner[1].pan_low;
  come(run);
  for (const double end = run.seconds + 60.0; events_.named("stands").empty() && run.seconds < end; run.plant.put_pan(1, outmost)) {
    run.step();
    ASSERT_NE(run.last.phase, BERM_PHASE_DIG);
  }
  ASSERT_EQ(events_.named("stands").size(), 1u);
  ASSERT_EQ(events_.named("recognised").size(), 2u);
  to_phase(BERM_PHASE_DIG);
  finish();
}

// Over its dig it waits for what does not come: no dead end.
TEST_F(LooksOnTheWay, WhereNoAnswerComesItIsLookedAtInAStop) {
  run.finder.cycles = 1000000;
  come(run);
  for (const double end = run.seconds + 60.0; run.finder.looks.size() < 3 && run.seconds < end;) run.step();
  ASSERT_EQ(run.finder.looks.size(), 3u);
  ASSERT_EQ(events_.named("stands").size(), 1u);
  run.finder.cycles = 10;
  finish();
}

TEST_F(LooksOnTheWay, AKernelStopOnTheWayEndsItAndItIsLookedAtInAStop) {
  run.finder.cycles = 300;
  come(run);
  to_phase(BERM_PHASE_SWING_TO_DIG);
  run.go(1.0);
  run.plant.stop_reason = BERM_STOP_INTRUDER;
  run.plant.kernel_runs = false;
  run.go(3.0);
  run.plant.kernel_runs = true;
  to_phase(BERM_PHASE_DIG);
  EXPECT_EQ(run.finder.looks.size(), 3u);
  EXPECT_EQ(events_.named("recognised").size(), 2u);
  finish();
}

TEST_F(LooksOnTheWay, OneThatLeavesMeanwhileIsNobodys) {
  run.finder.cycles = 300;
  come(run);
  to_phase(BERM_PHASE_SWING_TO_DIG);
  run.go(1.0);
  run.plant.truck_parked = false;
  run.plant.truck_leaves = true;
  run.go(10.0);
  run.plant.truck_leaves = false;
  EXPECT_EQ(events_.named("recognised").size(), 1u);
  ASSERT_EQ(events_.named("truck_lost").size(), 1u);
  EXPECT_TRUE(run.sequencer.finished()) << "it was the last";
  EXPECT_EQ(run.last.phase, BERM_PHASE_WAIT);
}

}  // namespace
