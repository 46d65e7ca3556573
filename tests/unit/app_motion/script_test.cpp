// The script engine on Figure 14 of stentz-1999, with the figure's own parameters.
#include <gtest/gtest.h>

#include <vector>

#include "motion/script.hpp"

namespace {

using namespace berm::app;
using Relation = Condition::Relation;

Condition when(Joint joint, Relation relation, double deg, double tolerance_deg = 0.0) { return {joint, relation, radians(deg), radians(tolerance_deg)}; }

// Literally the figure, but for one word: the boom's "If theta1 < 60" is read as "falls below", or it would hold at once at the dig.
Script figure_14() {
  const auto goal = [](double deg) { return radians(deg); };
  return Script({
      JointScript({{"when digging finishes, wait", {}, event_none, goal(5)},
                   {"swing to truck", {when(boom, Relation::above, 14)}, event_none, goal(101)},
                   {"swing to dig", {when(bucket, Relation::above, 10)}, event_none, goal(0)},
                   {"stop and execute dig", {when(swing, Relation::near, 0, 0.5)}, event_none, goal(0)}}),
      JointScript({{"when digging finishes, raise", {}, event_none, goal(18)}, {"lower to dig", {when(swing, Relation::falls_below, 60)}, event_none, goal(6)}}),
      JointScript({{"when digging finishes, wait", {}, event_none, goal(-100)},
                   {"move to spill point", {when(swing, Relation::above, 31)}, event_none, goal(-76)},
                   {"move to dump point", {when(bucket, Relation::above, -30)}, event_none, goal(-92)},
                   {"move to dig", {when(swing, Relation::below, 65)}, event_none, goal(-75)}}),
      JointScript({{"when digging finishes, curl", {}, event_none, goal(-90)},
                   {"open", {when(swing, Relation::above, 60), when(stick, Relation::above, -89)}, event_none, goal(30)},
                   {"move to dig", {when(swing, Relation::below, 60)}, event_none, goal(7)}}),
  });
}

struct Step { double swing, boom, stick, bucket; std::array<double, 4> goals; };

TEST(Script, PlaysFigure14) {
  Script script = figure_14();
  EXPECT_FALSE(script.running());
  script.start();
  const std::vector<Step> play{
      {5, -5, -100, -60, {5, 18, -100, -90}},    // digging finished: raise and curl, the rest waits
      {5, 10, -100, -90, {5, 18, -100, -90}},    // not high enough to swing
      {5, 14.5, -100, -90, {101, 18, -100, -90}},
      {25, 18, -100, -90, {101, 18, -100, -90}},
      {32, 18, -100, -90, {101, 18, -76, -90}},  // stick to the spill point
      {62, 18, -95, -90, {101, 18, -76, -90}},   // over the truck but the stick is not out
      {70, 18, -88, -90, {101, 18, -76, 30}},    // opens
      {95, 18, -76, -29, {101, 18, -92, 30}},    // pouring: stick to the dump point
      {101, 18, -90, 11, {0, 18, -92, 30}},      // open: back to the dig
      {64, 18, -92, 30, {0, 18, -75, 30}},
      {59, 18, -80, 30, {0, 6, -75, 7}},         // lower, bucket to dig
      {0.2, 6, -75, 7, {0, 6, -75, 7}},
  };
  for (const Step& step : play) {
    script.evaluate({radians(step.swing), radians(step.boom), radians(step.stick), radians(step.bucket)}, event_none);
    const Joints goals = script.goals();
    for (std::size_t j = 0; j < joints; ++j) EXPECT_NEAR(degrees(goals[j]), step.goals[j], 1e-9) << "joint " << j << " at swing " << step.swing;
  }
  EXPECT_TRUE(script.at_last());
}

TEST(Script, ACrossingMustBeSeenFromItsOtherSide) {
  JointScript s({{"first", {}, event_none, 0.0}, {"second", {when(swing, Relation::falls_below, 60)}, event_none, 1.0}});
  s.start();
  s.evaluate({radians(5), 0, 0, 0}, event_none);
  EXPECT_EQ(s.active(), 0);
  s.evaluate({radians(70), 0, 0, 0}, event_none);
  EXPECT_EQ(s.active(), 0);
  s.evaluate({radians(59), 0, 0, 0}, event_none);
  EXPECT_EQ(s.active(), 1);
}

TEST(Script, WhatARuleWaitsForBesidesAnEventIsTold) {
  JointScript s({{"first", {}, event_none, 0.0}, {"second", {when(boom, Relation::above, 10)}, event_scanned | event_emptied, 1.0}});
  const auto waits = [&](double boom_deg, std::uint32_t events) { return s.waits_only_for(event_scanned, {0, radians(boom_deg), 0, 0}, events); };
  EXPECT_FALSE(waits(20.0, event_emptied)) << "not begun";
  s.start();
  EXPECT_TRUE(waits(20.0, event_emptied));
  EXPECT_TRUE(waits(20.0, event_emptied | event_scanned));
  EXPECT_FALSE(waits(5.0, event_emptied)) << "for the boom, too";
  EXPECT_FALSE(waits(20.0, event_none)) << "for another event, too";
  EXPECT_EQ(s.active(), 0) << "told without a step";
  s.evaluate({0, radians(20), 0, 0}, event_emptied | event_scanned);
  EXPECT_EQ(s.active(), 1);
  EXPECT_FALSE(waits(20.0, event_emptied)) << "at its end";
}

// Soil that sticks leaves the bucket late: by then the swing may be past where the arm reaches out.
TEST(Script, ACrossingMayHaveBeenSeenSinceTheScriptsStartWhereTheRuleSaysSo) {
  for (const bool since_start : {true, false}) {
    Condition back = when(swing, Relation::falls_below, 0), farther = when(swing, Relation::falls_below, -10);
    back.since_start = farther.since_start = since_start;
    JointScript s({{"first", {}, event_none, 0.0}, {"emptied", {}, event_emptied, 1.0}, {"back", {back}, event_none, 2.0}, {"farther", {farther}, event_none, 3.0}});
    s.start();
    const auto look = [&](double deg, std::uint32_t events) { s.evaluate({radians(deg), 0, 0, 0}, events); };
    look(-20.0, event_none);
    look(-20.0, event_emptied);
    look(-20.0, event_emptied);
    EXPECT_EQ(s.active(), 1) << "never on the other side";
    look(70.0, event_emptied);
    EXPECT_EQ(s.active(), 1) << "not yet past";
    look(-5.0, event_emptied);
    look(-5.0, event_emptied);
    EXPECT_EQ(s.active(), 2) << "past the first alone";
    s.start();
    look(70.0, event_none);
    for (int k = 0; k < 4; ++k) look(-20.0, event_emptied);
    EXPECT_EQ(s.active(), since_start ? 3 : 1);
    s.start();
    for (int k = 0; k < 4; ++k) look(-20.0, event_emptied);
    EXPECT_EQ(s.active(), 1) << "begun anew it is another script";
  }
}

// A stop may fall between two rules, and what mends it carries the joint past the second one's mark before the first is active.
TEST(Script, AfterAnInterruptionACrossingNeedNotBeSeen) {
  for (const auto relation : {Relation::falls_below, Relation::rises_above})
    for (const bool interrupted : {true, false}) {
      const double side = relation == Relation::falls_below ? 1.0 : -1.0;
      Script s({JointScript({{"first", {}, event_none, 0.0}, {"second", {}, event_emptied, 1.0}, {"third", {when(swing, relation, 0)}, event_none, 2.0}}), JointScript({{"only", {}, event_none, 0.0}}),
                JointScript({{"only", {}, event_none, 0.0}}), JointScript({{"only", {}, event_none, 0.0}})});
      s.start();
      const auto look = [&](double deg, std::uint32_t events) { s.evaluate({radians(side * deg), 0, 0, 0}, events); };
      look(70.0, event_none);
      if (interrupted) s.interrupted();
      for (int k = 0; k < 3; ++k) look(-20.0, event_emptied);
      EXPECT_EQ(s.of(swing).active(), interrupted ? 2 : 1);
      look(70.0, event_emptied);
      EXPECT_EQ(s.of(swing).active(), interrupted ? 2 : 1) << "not yet past";
      s.start();
      for (int k = 0; k < 3; ++k) look(-20.0, event_emptied);
      EXPECT_EQ(s.of(swing).active(), 1) << "begun anew it is another script";
    }
}

TEST(Script, KnowsWhatTheActiveRuleWaitedFor) {
  JointScript s({{"a", {}, event_none, 0.0}, {"b", {when(boom, Relation::above, 10)}, event_none, 1.0}, {"c", {when(swing, Relation::above, 20), when(stick, Relation::above, -90)}, event_none, 2.0}});
  s.start();
  EXPECT_FALSE(s.waited_for(swing));
  s.evaluate({radians(30), radians(12), radians(-80), 0}, event_none);
  ASSERT_EQ(s.active(), 1);
  EXPECT_FALSE(s.waited_for(swing));
  EXPECT_TRUE(s.waited_for(boom));
  s.evaluate({radians(30), radians(12), radians(-80), 0}, event_none);
  ASSERT_EQ(s.active(), 2);
  EXPECT_TRUE(s.waited_for(swing));
  EXPECT_FALSE(s.waited_for(boom));
}

TEST(Script, AnEventIsNeededAndNoRuleIsSkipped) {
  JointScript s({{"a", {}, event_none, 0.0}, {"b", {}, event_emptied, 1.0}, {"c", {}, event_none, 2.0}});
  s.start();
  s.evaluate({}, event_none);
  EXPECT_EQ(s.active(), 0);
  s.evaluate({}, event_emptied);
  EXPECT_EQ(s.active(), 1);  // one step a pass, though c's side holds too
  s.evaluate({}, event_none);
  EXPECT_EQ(s.active(), 2);
  EXPECT_TRUE(s.at_last());
}

// Amid a motion: what is active goes on, what has been seen of a crossing holds where it comes later, and not where it comes sooner.
TEST(Script, TheRulesThatHaveNotFiredMayBeToldToWaitForSomethingElse) {
  const auto bound = [](double back, double open) {
    return JointScript({{"first", {when(boom, Relation::above, back)}, event_none, back}, {"back", {when(swing, Relation::falls_below, back)}, event_none, 1.0},
                        {"open", {when(stick, Relation::above, open)}, event_emptied, 2.0, 0.5}});
  };
  JointScript s = bound(60.0, 10.0);
  s.start();
  const auto look = [&](double deg, std::uint32_t events = event_none) { s.evaluate({radians(deg), 0, radians(20), 0}, events); };
  look(65);
  s.wait_as(bound(40.0, 30.0));
  look(50);
  EXPECT_EQ(s.active(), 0) << "not there yet";
  EXPECT_EQ(s.goal(), 60.0) << "of the active rule";
  s.wait_as(bound(55.0, 30.0));
  look(50);
  EXPECT_EQ(s.active(), 0) << "never seen at 55 and above";
  look(56);
  look(54);
  EXPECT_EQ(s.active(), 1);
  s.wait_as(bound(0.0, 10.0));
  EXPECT_EQ(s.rules()[1].conditions[0].threshold, radians(55)) << "it has fired";
  look(54);
  EXPECT_EQ(s.active(), 1) << "the event is still waited for";
  look(54, event_emptied);
  EXPECT_EQ(s.active(), 2);
}

}  // namespace
