// Where the plan goes no farther: the machine stands although it might move, a truck or the soil is out of reach. Never without a word to the operator.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include "app/standing_watch.hpp"
#include "app_bench/events.hpp"
#include "app_bench/loading.hpp"

namespace {

using namespace berm;
using namespace berm::app;
using app_bench::Loading;
using app_bench::start_pose;

class Watch : public ::testing::Test {
protected:
  // Seconds, of this time of standing or moving, after which it says so; 0: never.
  double told_after(double seconds, bool works = true, double bucket_rad_s = 0.0) {
    for (double t = cycle; t < seconds; t += cycle) {
      o_.time_s += cycle;
      o_.angle[bucket] += bucket_rad_s * cycle;
      if (watch_.step(o_, works)) return t;
    }
    return 0.0;
  }

  static constexpr double cycle = 0.01;
  Observation o_;
  StandingWatch watch_;
};

TEST_F(Watch, TellsEachTimeThatNothingHasMovedForSoLong) {
  EXPECT_NEAR(told_after(60.0), StandingWatch::patience, 0.05);
  EXPECT_NEAR(told_after(60.0), StandingWatch::patience, 0.05);
}

TEST_F(Watch, KnowsACreepFromAStand) {
  EXPECT_EQ(told_after(60.0, true, radians(0.2)), 0.0);
  const double sagging = told_after(60.0, true, radians(0.02));
  EXPECT_GE(sagging, StandingWatch::patience - 0.05);
  EXPECT_LT(sagging, StandingWatch::patience + 5.0);
}

TEST_F(Watch, BeginsAnewWithWhatMovesOrIsWaitedFor) {
  EXPECT_EQ(told_after(19.0), 0.0);
  EXPECT_EQ(told_after(1.0, true, radians(5.0)), 0.0);
  EXPECT_EQ(told_after(19.0), 0.0);
  EXPECT_EQ(told_after(60.0, false), 0.0);
  EXPECT_EQ(told_after(19.0), 0.0);
}

class SequencerStand : public ::testing::Test {
protected:
  long calls(const std::string& reason) const {
    const auto all = events_.named("operator_needed");
    return std::count_if(all.begin(), all.end(), [&](const auto& e) { return e.at("reason") == reason; });
  }
  // The shipped script of a pass with this in it changed.
  static ScriptText changed(const std::string& from, const std::string& to) {
    std::ifstream file(BERM_SCRIPTS "/pass.script");
    std::string text{std::istreambuf_iterator<char>(file), {}};
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
    return ScriptText::parse(text, "changed", pass_vocabulary());
  }
  // A rule of the swing that never comes; the boom's range ends far below.
  static ScriptText never_swings() { return changed("when boom above swing_start_boom and", "when boom above swing_start_boom + 60 deg and"); }
  static ScriptText never_lowers() { return changed("rule \"over the dig: lower\" when swing back_past lower_bearing", "rule \"over the dig: lower\" when boom above back_boom + 60 deg"); }

  app_bench::Events events_;
};

TEST_F(SequencerStand, AScriptThatWaitsForWhatNeverComesIsBegunAnewAndTheOperatorTold) {
  Loading run(1, start_pose(), events_.fd());
  run.scripts.pass = never_swings();
  while (events_.named("stands").empty() && run.seconds < 120.0) run.step();
  const auto stood = events_.named("stands");
  ASSERT_EQ(stood.size(), 1u) << "it stands without a word";
  EXPECT_EQ(stood[0].at("waits").at("swing"), "boom high: swing to truck");
  EXPECT_EQ(stood[0].at("phase"), "lift");
  EXPECT_EQ(calls("work stands"), 0) << "it may help by itself";
  run.go(150.0);
  EXPECT_GE(events_.named("stands").size(), 3u);
  EXPECT_EQ(calls("work stands"), 1);
  EXPECT_EQ(run.plant.site().bed_mass(), 0.0);
  EXPECT_EQ(events_.named("pass").size(), 0u) << "what came back is not booked";
  EXPECT_EQ(run.plant.findings().ground_contacts + run.plant.findings().wall_contacts, 0);
}

TEST_F(SequencerStand, WhatHelpedOnceIsForgotten) {
  Loading run(1, start_pose(), events_.fd());
  const ScriptText shipped = run.scripts.pass;
  for (int time = 0; time < 4; ++time) {
    run.scripts.pass = never_swings();
    const std::size_t before = events_.named("stands").size();
    while (events_.named("stands").size() == before && run.seconds < 400.0) run.step();
    run.scripts.pass = shipped;
    const std::size_t passes = events_.named("pass").size();
    while (events_.named("pass").size() < passes + 2 && run.seconds < 400.0) run.step();
  }
  ASSERT_LT(run.seconds, 400.0) << "it did not go on";
  EXPECT_EQ(events_.named("stands").size(), 4u);
  EXPECT_EQ(calls("work stands"), 0);
}

// On the way back: what was poured is booked, once.
TEST_F(SequencerStand, APassThatStandsAfterItsDumpIsBookedOnce) {
  Loading run(1, start_pose(), events_.fd());
  run.scripts.pass = never_lowers();
  while (events_.named("stands").size() < 3 && run.seconds < 300.0) run.step();
  ASSERT_EQ(events_.named("stands").size(), 3u);
  EXPECT_EQ(events_.named("stands")[0].at("waits").at("boom"), "over the dig: lower");
  EXPECT_EQ(calls("work stands"), 1);
  const auto passes = events_.named("pass");
  ASSERT_EQ(passes.size(), 3u);
  EXPECT_NEAR(passes.back().at("loaded_kg").get<double>(), run.plant.site().bed_mass(), 0.05 * run.plant.site().bed_mass());
  EXPECT_EQ(run.plant.findings().ground_contacts + run.plant.findings().wall_contacts, 0);
}

// Higher than the bucket can be raised: it is refused with a word, looked at again, and loaded when a lower one stands there.
TEST_F(SequencerStand, ATruckOutOfReachIsRefusedAndLookedAtAgain) {
  Loading run(1, start_pose(), events_.fd());
  const RecognisedTruck right = run.finder.truck;
  run.finder.truck.pose.middle.z() = 6.0;
  run.go(120.0);
  EXPECT_EQ(calls("truck out of reach"), 1);
  ASSERT_FALSE(events_.named("truck_lost").empty());
  EXPECT_EQ(events_.named("truck_lost")[0].at("why"), "out of reach");
  EXPECT_EQ(run.plant.site().bed_mass(), 0.0);
  const std::size_t looks = run.finder.looks.size();
  EXPECT_GE(looks, 3u);
  EXPECT_LT(looks, 60u) << "it looks all the time";
  run.finder.truck = right;
  while (events_.named("pass").size() < 2 && run.seconds < 300.0) run.step();
  EXPECT_GT(run.plant.site().bed_mass(), 1000.0);
  EXPECT_EQ(run.plant.findings().ground_contacts + run.plant.findings().wall_contacts, 0);
}

// Not so high that the implements could not be raised over it, but too high to reach out over its bed: that shows with the bucket full.
TEST_F(SequencerStand, ATruckOverWhichNoDumpReachesIsRefusedWithItsLoadBroughtBack) {
  Loading run(1, start_pose(), events_.fd());
  const RecognisedTruck right = run.finder.truck;
  run.finder.truck.pose.middle.z() = 4.5;
  while (events_.named("truck_lost").empty() && run.seconds < 150.0) run.step();
  ASSERT_FALSE(events_.named("truck_lost").empty()) << "it stands with a full bucket, without a word";
  EXPECT_EQ(events_.named("unreachable")[0].at("what"), "dump point");
  EXPECT_EQ(calls("truck out of reach"), 1);
  EXPECT_EQ(events_.named("pass").size(), 0u);
  run.finder.truck = right;
  while (events_.named("pass").size() < 2 && run.seconds < 300.0) run.step();
  EXPECT_NEAR(events_.named("pass").back().at("loaded_kg").get<double>(), run.plant.site().bed_mass(), 0.05 * run.plant.site().bed_mass());
  EXPECT_EQ(run.plant.findings().ground_contacts + run.plant.findings().wall_contacts, 0);
}

// Digs that would end at the machine's feet: there is no way through the soil.
TEST_F(SequencerStand, NoWayThroughTheSoilIsAMoveOfTheMachineToo) {
  SiteModel site = app_bench::bench();
  site.dig_radius_end = 1.0;
  Loading run(1, start_pose(), events_.fd(), site);
  run.go(90.0);
  ASSERT_FALSE(events_.named("move_back").empty());
  EXPECT_EQ(events_.named("move_back")[0].at("why"), "the soil before the machine is out of the bucket's reach");
  EXPECT_EQ(events_.named("unreachable").size(), 3u) << "so often it is tried";
}

// Digs begin where no bucket reaches: the machine is to be moved, and when that helps no more somebody is told that, too.
TEST_F(SequencerStand, SoilOutOfReachIsAMoveOfTheMachine) {
  SiteModel site = app_bench::bench();
  site.dig_radius_start = 14.0, site.dig_radius_end = 13.0;
  Loading run(1, start_pose(), events_.fd(), site);
  run.go(90.0);
  ASSERT_FALSE(events_.named("move_back").empty());
  EXPECT_EQ(events_.named("move_back")[0].at("why"), "the start of the next dig is out of the bucket's reach");
  EXPECT_EQ(calls("move back"), 1);
  EXPECT_LT(events_.named("unreachable").size(), 10u) << "it says so in every cycle";
}

// He trams it, his stops are his own; but when he has switched run on again, what keeps the machine at the new stand is told as anywhere.
TEST_F(SequencerStand, WhatKeepsTheMachineAfterTheMoveIsTold) {
  SiteModel site = app_bench::bench();
  site.dig_radius_start = 14.0, site.dig_radius_end = 13.0;
  Loading run(1, start_pose(), events_.fd(), site);
  run.go(90.0);
  ASSERT_EQ(calls("move back"), 1);
  const auto kept = [&](double seconds, std::uint8_t reason, bool run_switch) {
    for (const double end = run.seconds + seconds; run.seconds < end;) {
      berm_state& state = run.plant.mutable_segment().state;
      state.kernel_state = reason == BERM_STOP_NONE ? BERM_STATE_STANDBY : BERM_STATE_STOPPED;
      state.stop_reason = reason;
      state.stop_category = reason == BERM_STOP_BASE_MOVED ? 1 : 2;
      if (!run_switch) state.panel &= ~BERM_PANEL_OPERATOR_RUN;
      run.step();
    }
  };
  kept(5.0, BERM_STOP_INTRUDER, true);  // at the old stand: no part of what comes
  kept(2.0, BERM_STOP_NONE, false);
  kept(60.0, BERM_STOP_BASE_MOVED, false);
  EXPECT_EQ(events_.named("operator_needed").size(), 1u) << "he moves it";
  kept(29.0, BERM_STOP_UNKNOWN_GROUND, true);
  EXPECT_EQ(events_.named("operator_needed").size(), 1u) << "it may end by itself";
  kept(3.0, BERM_STOP_UNKNOWN_GROUND, true);
  EXPECT_EQ(calls("unknown ground"), 1);
  EXPECT_TRUE(std::all_of(run.last.velocity.begin(), run.last.velocity.end(), [](double v) { return v == 0.0; })) << "nothing moves before it looks round anew";
  run.go(1.0);
  EXPECT_EQ(events_.named("moved").size(), 1u);
}

}  // namespace
