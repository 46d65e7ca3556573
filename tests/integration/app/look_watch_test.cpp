// A look that does not end: a pan that is stuck, a recogniser that does not answer, a swing that creeps. Never without a word to the operator.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "app/look_watch.hpp"
#include "app_bench/events.hpp"
#include "app_bench/loading.hpp"

namespace {

using namespace berm;
using namespace berm::app;
using app_bench::Loading;
using app_bench::start_pose;

TEST(LookWatch, TellsOfEachThingOnceAndBeginsAnewEachTime) {
  const app_bench::Events events;
  const ProgressLog log(events.fd());
  LookWatch watch;
  Observation o;
  const auto anew = [&](double seconds, Awaited awaited) {
    int times = 0;
    for (const double end = o.time_s + seconds; o.time_s < end; o.time_s += 0.01) times += watch.step(o, awaited, log);
    return times;
  };
  const auto calls = [&] { return events.named("operator_needed").size(); };
  EXPECT_EQ(anew(29.0, Awaited::left_pan), 0);
  EXPECT_EQ(anew(0.1, Awaited::nothing), 0);
  EXPECT_EQ(anew(29.0, Awaited::left_pan), 0);
  EXPECT_EQ(anew(62.0, Awaited::left_pan), 3);
  EXPECT_EQ(calls(), 1u);
  EXPECT_EQ(anew(31.0, Awaited::recogniser), 1);
  EXPECT_EQ(calls(), 2u);
  anew(1.0, Awaited::nothing);
  EXPECT_EQ(anew(31.0, Awaited::left_pan), 1);
  EXPECT_EQ(calls(), 3u) << "another time";
  for (const Awaited a : {Awaited::right_pan, Awaited::both_pans, Awaited::standstill}) anew(31.0, a);
  EXPECT_EQ(events.named("look_stands").size(), 8u);
  std::vector<std::string> advices;
  for (const auto& call : events.named("operator_needed")) advices.push_back(call.at("advice"));
  ASSERT_EQ(advices.size(), 6u);
  std::sort(advices.begin(), advices.end());
  EXPECT_EQ(std::unique(advices.begin(), advices.end()) - advices.begin(), 5) << "what wants another thing of him has another text";
}

class SequencerLook : public ::testing::Test {
protected:
  std::vector<std::string> reasons() const {
    std::vector<std::string> out;
    for (const auto& call : events_.named("operator_needed")) out.push_back(call.at("reason"));
    return out;
  }
  // Until then, a pan stuck where it is.
  void go_with_stuck(std::size_t scanner, double until) {
    const double pan = run_.plant.state().pan_angle_urad[scanner] * 1e-6;
    while (run_.seconds < until) {
      run_.plant.put_pan(scanner, pan);
      run_.step();
    }
  }
  void go(double until) {
    while (run_.seconds < until) run_.step();
  }
  bool begins_to_look() {
    while (run_.finder.looks.empty() && run_.seconds < 60.0) run_.step();
    return !run_.finder.looks.empty();
  }
  bool digs() {
    for (const double end = run_.seconds + 60.0; run_.last.phase != BERM_PHASE_DIG && run_.seconds < end;) run_.step();
    return run_.last.phase == BERM_PHASE_DIG;
  }
  app_bench::Events events_;
  Loading run_{1, start_pose(), events_.fd()};
};

using Reasons = std::vector<std::string>;

// Also while the kernel lets motions out at a tenth: pans have their speed, and nothing else moves.
TEST(SequencerLookTime, IsNoHalfOfThePatienceWhenItGoesWell) {
  for (const double share : {1.0, 0.1}) {
    app_bench::Events events;
    Loading run(1, start_pose(), events.fd());
    for (double& most : run.plant.most_speed) most *= share;
    while (events.named("truck").empty() && run.seconds < 60.0) run.step();
    EXPECT_LT(run.seconds, 0.5 * LookWatch::patience) << "the survey";
    while (run.finder.looks.empty() && run.seconds < 120.0) run.step();
    ASSERT_FALSE(run.finder.looks.empty());
    const double began = run.seconds;
    while (run.sequencer.bed() == nullptr && run.seconds < began + 60.0) run.step();
    EXPECT_LT(run.seconds - began, 0.5 * LookWatch::patience) << "the look at the truck";
    EXPECT_TRUE(events.named("operator_needed").empty());
    EXPECT_TRUE(events.named("look_stands").empty());
  }
}

TEST_F(SequencerLook, RoundWithAStuckPanIsToldAndGoesOnWhenItTurns) {
  go_with_stuck(1, 100.0);
  EXPECT_EQ(reasons(), Reasons{"right scanner's pan"});
  EXPECT_TRUE(events_.named("truck").empty());
  EXPECT_TRUE(digs());
}

// The kernel keeps the machine, and the app looks again and again meanwhile: the look round has an end all the same, and what keeps it is told.
TEST_F(SequencerLook, RoundWithAStuckPanIsToldWhileTheKernelKeepsTheMachine) {
  run_.plant.kernel_runs = false;
  run_.plant.stop_reason = BERM_STOP_UNKNOWN_GROUND;
  go_with_stuck(0, 50.0);
  const Reasons told = reasons();
  EXPECT_NE(std::find(told.begin(), told.end(), "left scanner's pan"), told.end());
}

TEST_F(SequencerLook, AtATruckWithAStuckPanIsToldAndBegunAnew) {
  ASSERT_TRUE(begins_to_look());
  go_with_stuck(0, run_.seconds + 70.0);
  EXPECT_EQ(reasons(), Reasons{"left scanner's pan"});
  EXPECT_EQ(events_.named("look_stands").size(), 2u);
  EXPECT_EQ(run_.finder.ended(), 0u);
  EXPECT_TRUE(digs());
}

TEST_F(SequencerLook, ForWhichTheOtherScannerNeverSeesTheFeetIsTold) {
  run_.plant.put_pan(1, run_.machine.scanner[1].pan_low);
  while (events_.named("truck").empty() && run_.seconds < 60.0) run_.step();
  while (run_.finder.looks.empty() && run_.seconds < 60.0) {
    run_.plant.put_pan(1, run_.machine.scanner[1].pan_low);
    run_.step();
  }
  go_with_stuck(1, run_.seconds + 50.0);
  EXPECT_EQ(events_.named("recognised").size(), 2u) << "begun anew, once";
  EXPECT_EQ(reasons(), Reasons{"right scanner's pan"});
  EXPECT_TRUE(digs());
}

TEST_F(SequencerLook, WithoutAnAnswerIsToldAndBegunAnew) {
  run_.finder.cycles = 1000000;
  ASSERT_TRUE(begins_to_look());
  go(run_.seconds + 50.0);
  EXPECT_EQ(reasons(), Reasons{"truck recogniser"});
  EXPECT_EQ(run_.finder.looks.size(), 2u) << "what was lost once may come the second time";
  EXPECT_EQ(run_.last.phase, BERM_PHASE_WAIT);
  run_.finder.cycles = 10;
  go(run_.seconds + 25.0);
  EXPECT_TRUE(digs());
  EXPECT_EQ(reasons().size(), 1u);
}

TEST_F(SequencerLook, WhileTheSwingCreepsIsTold) {
  ASSERT_TRUE(begins_to_look());
  for (const double end = run_.seconds + 40.0; run_.seconds < end;) {
    run_.plant.put(swing, run_.plant.angle()[swing] + radians(0.2) * run_.machine.cycle);
    run_.step();
  }
  EXPECT_EQ(reasons(), Reasons{"swing creeps"});
}

}  // namespace
