// The app's horn signals, through frames of 50 ms, in the ears of the plant's people; and what the operator does then.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "app/bench_move.hpp"
#include "contract/berm_contract.h"
#include "plant/process/horn_listener.hpp"
#include "plant/process/operator.hpp"

namespace berm::plant {
namespace {

constexpr double kCycle = 0.01;
constexpr int kFrameEvery = 5;  // cycles: Machine_Setting_Cmd

std::vector<HornSignal> heard(double seconds, const std::function<bool(double)>& horn) {
  HornListener listener;
  std::vector<HornSignal> all;
  bool sounds = false;
  for (int k = 0; k * kCycle < seconds; ++k) {
    if (k % kFrameEvery == 0) sounds = horn(k * kCycle);
    if (const HornSignal s = listener.step(k * kCycle, sounds); s.what != HornSignal::What::none) all.push_back(s);
  }
  return all;
}

TEST(Horn, EveryDistanceIsHeardAsItIsSounded) {
  for (int steps = 1; steps <= 8; ++steps)
    for (const double offset : {0.0, 0.013, 0.037}) {
      const double distance = 0.5 * steps;
      const auto signals = heard(20.0, [&](double t) { return t >= offset && app::sounds_move_back(t - offset, distance); });
      ASSERT_EQ(signals.size(), 1U) << distance;
      EXPECT_EQ(signals[0].what, HornSignal::What::move_back);
      EXPECT_DOUBLE_EQ(signals[0].distance_m, distance);
    }
}

TEST(Horn, ItIsSoundedAgainUntilSomebodyComes) {
  EXPECT_EQ(heard(85.0, [](double t) { return app::sounds_move_back(t, 1.0); }).size(), 3U);
}

TEST(Horn, ALongBlastIsAFullTruckAndOneOnly) {
  const auto signals = heard(5.0, [](double t) { return t >= 1.0 && t < 2.0; });
  ASSERT_EQ(signals.size(), 1U);
  EXPECT_EQ(signals[0].what, HornSignal::What::truck_full);
}

TEST(Horn, OtherBlastsAreNoSignal) {
  EXPECT_TRUE(heard(10.0, [](double t) { return t < 0.3; }).empty());
  EXPECT_TRUE(heard(10.0, [](double t) { return t < 1.2 && std::fmod(t, 0.6) < 0.3; }).empty()) << "two short ones";
  EXPECT_TRUE(heard(10.0, [](double t) { return t < 1.8 && std::fmod(t, 0.6) < 0.3; }).empty()) << "three, and no distance";
}

struct Attended {
  explicit Attended(const OperatorConfig& config) : person(config, 3) {}
  void until(double seconds, const HornSignal& first = {}) {
    HornSignal signal = first;
    for (; t < seconds; t += kCycle) {
      person.step(t, signal, {true, truck_about, &panel, 0.0, angle, person.lifts() && lifting_helps, run_switch, dust});
      lifted = lifted || person.lifts();
      relearned_by_hand = relearned_by_hand || (person.lifts() && person.relearn());
      signal = {};
      run_off = run_off || !person.run();
      relearned = relearned || person.relearn();
      reset_with_run_on = reset_with_run_on || (person.reset() && person.run());
      reset_after_relearn = reset_after_relearn || (relearned && person.reset());
      moved = moved || person.moved() != nullptr;
      if (person.wants_place()) truck_about = false;
      moved_with_truck = moved_with_truck || (truck_about && person.base().x < 0.0);
    }
  }
  Operator person;
  berm_heartbeat panel{true, 255, BERM_STATE_RUN, 0, 0, 0};
  std::array<double, 4> angle{};
  bool lifting_helps = true, run_switch = true, lifted = false, relearned_by_hand = false, reset_with_run_on = false;
  double t = 0.0, dust = 0.0;
  bool truck_about = true, run_off = false, relearned = false, reset_after_relearn = false, moved = false, moved_with_truck = false;
};

const OperatorConfig kAttends{{2.0, 4.0}, 0.5, 2.0, std::array<double, 2>{5.0, 6.0}};

TEST(Operator, TramsTheMachineBackWithTheRunSwitchOff) {
  Attended site(kAttends);
  site.until(1.9, {HornSignal::What::move_back, 1.5});
  EXPECT_FALSE(site.run_off) << "before he could react";
  site.until(30.0);
  EXPECT_TRUE(site.run_off && site.reset_after_relearn && site.moved);
  EXPECT_FALSE(site.moved_with_truck) << "the truck had to make way first";
  EXPECT_TRUE(site.person.run());
  EXPECT_NEAR(site.person.base().x, -1.5, 1e-9);
  EXPECT_DOUBLE_EQ(site.person.base().pitch, 0.0);
  ASSERT_EQ(site.person.moves().size(), 1U);
  EXPECT_GT(site.person.moves()[0].to_s - site.person.moves()[0].from_s, 1.5 / 0.5);
}

TEST(Operator, DoesNotTramFartherThanThereIsRoom) {
  Attended site(kAttends);
  site.until(10.0, {HornSignal::What::move_back, 2.5});
  EXPECT_TRUE(site.person.refuses());
  EXPECT_TRUE(site.person.run());
  EXPECT_DOUBLE_EQ(site.person.base().x, 0.0);
}

TEST(Operator, ResetsAfterAStopThatLatchedAndNotBefore) {
  Attended site(kAttends);
  site.panel = {false, 1, BERM_STATE_STOPPED, BERM_STOP_TAIL, 0, 0};
  site.until(4.9);
  EXPECT_TRUE(site.person.presses().empty());
  site.until(9.0);
  ASSERT_EQ(site.person.presses().size(), 1U);
  EXPECT_TRUE(site.person.presses()[0].reset && site.reset_after_relearn);
  EXPECT_TRUE(site.run_off) << "what was left on through the reset starts nothing";
  EXPECT_FALSE(site.reset_with_run_on);
  site.panel = {false, 255, BERM_STATE_STANDBY, BERM_STOP_NONE, 0, 0};
  site.until(11.0);
  EXPECT_TRUE(site.person.run());
}

TEST(Operator, LeavesAHeldMachineAlone) {
  Attended site(kAttends);
  site.panel = {true, 2, BERM_STATE_STOPPED, BERM_STOP_INTRUDER, 0, 0};
  site.until(40.0);
  EXPECT_TRUE(site.person.presses().empty());
  site.until(60.0);
  EXPECT_EQ(site.person.presses().size(), 1U) << "after a minute he has the map learned anew";
}

TEST(Operator, InThickDustHeWaitsUntilItHasSettled) {
  for (const double dust : {0.0, 0.1, 0.5}) {
    Attended site(kAttends);
    site.panel = {true, 2, BERM_STATE_STOPPED, BERM_STOP_INTRUDER, 0, 0};
    site.dust = dust;
    site.until(70.0);
    EXPECT_EQ(site.person.presses().size(), dust < 0.3 ? 1U : 0U) << dust;
    site.dust = 0.0;
    if (dust < 0.3) continue;
    site.until(115.0);
    EXPECT_EQ(site.person.presses().size(), 0U) << "45 s, in which it might have ended by itself";
    site.until(130.0);
    EXPECT_EQ(site.person.presses().size(), 1U);
  }
  Attended latched(kAttends);
  latched.panel = {false, 1, BERM_STATE_FAULT, BERM_STOP_SENSOR_BLOCKED, 0, 0};
  latched.dust = 0.5;
  latched.until(60.0);
  EXPECT_GE(latched.person.presses().size(), 1U) << "what latches does not end with the dust";
}

TEST(Operator, LiftsByHandWhereHisLastPressDidNotHelp) {
  Attended site(kAttends);
  site.panel = {true, 2, BERM_STATE_STOPPED, BERM_STOP_UNKNOWN_GROUND, 0, 0};
  site.until(60.0);
  ASSERT_EQ(site.person.presses().size(), 1U);
  EXPECT_FALSE(site.lifted || site.run_off) << "the first press may be enough";
  site.until(125.0);
  EXPECT_TRUE(site.lifted && site.run_off) << "nothing has moved since";
  EXPECT_TRUE(site.person.run()) << "and on again";
  EXPECT_FALSE(site.relearned_by_hand) << "the levers are let go before the map is learned anew";
  ASSERT_EQ(site.person.hand_lifts().size(), 1U);
  EXPECT_GT(site.person.hand_lifts()[0].to_s, site.person.hand_lifts()[0].from_s + 3.0);
  EXPECT_TRUE(site.person.moves().empty() && !site.moved);
}

TEST(Operator, AttendsToAMachineThatShouldRunAndStandsBy) {
  Attended site(kAttends);
  site.panel = {false, 255, BERM_STATE_STANDBY, BERM_STOP_NONE, 0, 0};
  site.until(45.0);
  EXPECT_TRUE(site.person.presses().empty());
  site.until(125.0);
  EXPECT_GE(site.person.presses().size(), 2U);
  EXPECT_TRUE(site.lifted) << "his first press has not helped";
  Attended paused(kAttends);
  paused.panel = site.panel;
  paused.run_switch = false;
  paused.until(125.0);
  EXPECT_TRUE(paused.person.presses().empty()) << "somebody else has switched run off";
}

TEST(Operator, KeepsTheLeversUntilTheImplementsAreUp) {
  Attended site(kAttends);
  site.lifting_helps = false;
  site.panel = {true, 2, BERM_STATE_STOPPED, BERM_STOP_OVERPASS, 0, 0};
  site.until(300.0);
  EXPECT_TRUE(site.person.lifts() && !site.person.run());
  EXPECT_FALSE(site.person.reset());
}

TEST(Operator, LeavesTheLeversAloneWhenThePressHelpedOrTheGroundIsNotWhatKeepsIt) {
  Attended moved(kAttends);
  moved.panel = {true, 2, BERM_STATE_STOPPED, BERM_STOP_UNKNOWN_GROUND, 0, 0};
  moved.until(60.0);
  moved.angle[1] = 0.1;
  moved.until(125.0);
  EXPECT_EQ(moved.person.presses().size(), 2U);
  EXPECT_FALSE(moved.lifted);
  Attended blocked(kAttends);
  blocked.panel = {false, 1, BERM_STATE_FAULT, BERM_STOP_SENSOR_BLOCKED, 0, 0};
  blocked.until(60.0);
  EXPECT_GE(blocked.person.presses().size(), 2U);
  EXPECT_FALSE(blocked.lifted);
}

TEST(Operator, WhoAttendsNoStopsPressesNothing) {
  OperatorConfig config = kAttends;
  config.resets_after_s.reset();
  Attended site(config);
  site.panel = {false, 1, BERM_STATE_FAULT, BERM_STOP_SENSOR_BLOCKED, 0, 0};
  site.until(200.0);
  EXPECT_TRUE(site.person.presses().empty() && !site.relearned);
}

}  // namespace
}  // namespace berm::plant
