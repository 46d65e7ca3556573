#include "planning/look_ahead.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "bench_pass.hpp"
#include "motion/script_tempo.hpp"

namespace {

using namespace berm::app;
using berm::app_bench::BenchPass;
using berm::app_bench::Heap;
using What = LookAhead::Change::What;

// A pass run with joints that do as their models, with look-ahead on the way and a map that may change.
class BenchLookAhead : public ::testing::Test {
protected:
  void SetUp() override {
    const auto poses = pass_poses(bench_.machine, bench_.task);
    ASSERT_TRUE(poses);
    PassSearch search = bench_.begin(*poses);
    while (!search.done()) search.step();
    ASSERT_TRUE(search.clear());
    pass_ = {bench_.task, search.poses(), search.thresholds()};
    script_ = pass_script(bench_.scripts, bench_.machine, pass_.task, pass_.poses, pass_.thresholds);
    script_.start();
    angle_ = pass_.task.lifted_from;
    for (std::size_t j = 0; j < joints; ++j) model_.push_back(arm_.model(j));
    for (std::size_t j = 0; j < joints; ++j) model_[j].reset(angle_[j], 0.0);
  }

  // One cycle; false when the pass is over.
  bool step() {
    const bool opens = script_.of(bucket).reached(RuleMark::opens);
    open_s_ += opens && angle_[bucket] > pass_.poses.dump[bucket] - radians(8.0) ? bench_.machine.cycle : 0.0;
    const std::uint32_t pours = opens && angle_[bucket] > pass_.poses.dump[bucket] - radians(40.0) ? event_empties : event_none;
    const std::uint32_t events = event_weighed | event_scanned | pours | (open_s_ >= 0.5 ? event_emptied : event_none);
    if (cycle_++ % 2 == 0) script_.evaluate(angle_, events);
    const bool returns = script_.of(swing).reached(RuleMark::returns);
    const double carried_kg = returns ? 0.0 : bench_.machine.bucket_payload_kg;
    arm_.carries(carried_kg);
    if (looks_) look(events & ~event_weighed, carried_kg);
    const PaceShares shares = look_ahead_.shares();
    const Joints command = arm_.toward(script_.goals(), shares.of(script_.paces()), tempos_of(script_, {shares.swing, 1.0, 1.0, 1.0}), angle_, velocity_);
    arm_.sent(command);
    bool standing = script_.at_last();
    for (std::size_t j = 0; j < joints; ++j) {
      standing = standing && std::fabs(script_.goals()[j] - angle_[j]) < radians(1.0) && std::fabs(velocity_[j]) < radians(1.0);
      model_[j].respond(responses_of(bench_.machine, j, reach_of(bench_.machine, angle_), carried_kg));
      model_[j].advance(command[j]);
      angle_[j] = model_[j].angle();
      velocity_[j] = model_[j].velocity();
    }
    // What the kernel would have to slow or stop.
    if (skyline_.blocking(preview(bench_.machine, angle_, velocity_), Skyline::Ranges::left_to_guard, 0.0)) ++blocked_;
    return !standing;
  }
  double seconds() const { return cycle_ * bench_.machine.cycle; }
  void run_to_end() {
    while (step()) ASSERT_LT(seconds(), 60.0) << "the pass does not end";
  }
  void to_swing(double deg, bool on_way_back) {
    while (script_.of(swing).reached(RuleMark::returns) != on_way_back || (on_way_back ? degrees(angle_[swing]) > deg : degrees(angle_[swing]) < deg)) ASSERT_TRUE(step());
  }
  std::vector<std::string> told() const {
    std::vector<std::string> what;
    for (const LookAhead::Change& c : changes_) what.push_back(c.what == What::later ? c.rules.what : c.what == What::slowed ? "slowed" : "full pace");
    return what;
  }

  BenchPass bench_;
  LookAhead::Pass pass_;
  Script script_;
  ArmController arm_{bench_.machine};
  std::vector<JointModel> model_;
  Joints angle_{}, velocity_{};
  LookAhead look_ahead_{bench_.machine, bench_.scripts};
  Skyline skyline_ = bench_.skyline();
  bool looks_ = true;
  std::vector<LookAhead::Change> changes_;
  int blocked_ = 0;

private:
  void look(std::uint32_t events, double carried_kg) {
    const PassCourse course{carried_kg, pass_.task.brake_empty, pass_.poses.dump[bucket], events};
    const auto change = look_ahead_.step({seconds(), &script_, &arm_, angle_, velocity_, course, &pass_, &skyline_});
    if (!change) return;
    changes_.push_back(*change);
    if (change->what != What::later) return;
    pass_.thresholds = change->rules.thresholds;
    script_.wait_as(pass_script(bench_.scripts, bench_.machine, pass_.task, pass_.poses, pass_.thresholds));
  }

  double open_s_ = 0.0;
  int cycle_ = 0;
};

TEST_F(BenchLookAhead, WhatIsForeseenClearIsLeftAsItIs) {
  const double swing_start = pass_.thresholds.swing_start_boom;
  run_to_end();
  const double with = seconds();
  EXPECT_EQ(told(), std::vector<std::string>{});
  EXPECT_EQ(pass_.thresholds.swing_start_boom, swing_start);
  EXPECT_EQ(blocked_, 0);
  EXPECT_LT(with, 12.0);
}

// Heaped up beside the dig since the search: too near to what hangs over it while the boom still rises.
TEST_F(BenchLookAhead, AHeapBesideTheDigIsWaitedForUntilTheBoomIsHigher) {
  skyline_ = bench_.skyline({radians(10.0), 6.0, 0.5, 0.5});
  const double swing_start = pass_.thresholds.swing_start_boom, hover = pass_.thresholds.hover_offset;
  run_to_end();
  EXPECT_EQ(told(), (std::vector<std::string>{"swing start", "reach out over dig"}));
  EXPECT_GT(pass_.thresholds.swing_start_boom, swing_start);
  EXPECT_LT(pass_.thresholds.hover_offset, hover);
  EXPECT_LE(pass_.thresholds.lower_offset, 0.8 * pass_.thresholds.hover_offset + 1e-9);
  EXPECT_EQ(blocked_, 0) << "the kernel would have to slow it";
  EXPECT_LT(seconds(), 13.0);
}

// It comes into sight with the swing on its way back.
TEST_F(BenchLookAhead, AHeapWhereTheArmComesDownIsLoweredOntoLater) {
  to_swing(60.0, true);
  const int before = blocked_;
  skyline_ = bench_.skyline({radians(12.0), 7.2, 0.5, 0.0});
  run_to_end();
  EXPECT_EQ(told(), std::vector<std::string>{"lower over dig"});
  ASSERT_FALSE(changes_.empty());
  EXPECT_EQ(changes_[0].foreseen.part, PassPart::over_dig);
  EXPECT_GT(changes_[0].foreseen.seconds, 1.0);
  EXPECT_NEAR(degrees(changes_[0].foreseen.by.bearing), 12.0, 12.0);
  EXPECT_EQ(blocked_, before);
  EXPECT_LT(seconds(), 12.5);
}

// Beyond the dump: no rule that waits longer keeps the swing's stop from reaching there, and a slower swing's does not.
TEST_F(BenchLookAhead, WhereNoRuleHelpsTheSwingIsSlowedAndThenGoesOnAtItsFullPace) {
  skyline_ = bench_.skyline({radians(110.0), 7.0, 0.5, 1.0});
  run_to_end();
  EXPECT_EQ(told(), (std::vector<std::string>{"slowed", "full pace"}));
  ASSERT_FALSE(changes_.empty());
  EXPECT_GT(changes_[0].foreseen.seconds, 1.5);
  EXPECT_FALSE(look_ahead_.slows());
  EXPECT_EQ(blocked_, 0);
  EXPECT_LT(seconds(), 14.0);
}

// The same heaps without look-ahead: the tests above show something.
TEST_F(BenchLookAhead, WithoutItTheKernelWouldHaveToSlowEach) {
  looks_ = false;
  skyline_ = bench_.skyline({radians(110.0), 7.0, 0.5, 1.0});
  to_swing(60.0, true);
  EXPECT_GT(blocked_, 20);
  blocked_ = 0;
  skyline_ = bench_.skyline({radians(12.0), 7.2, 0.5, 0.0});
  run_to_end();
  EXPECT_GT(blocked_, 20);
}

// The rules that have fired stay as they are, and what a pass is slowed by ends with it.
TEST_F(BenchLookAhead, AnotherScriptBeginsAtItsFullPace) {
  skyline_ = bench_.skyline({radians(110.0), 7.0, 0.5, 1.0});
  while (!look_ahead_.slows()) ASSERT_TRUE(step());
  EXPECT_LT(look_ahead_.shares().swing, 1.0);
  look_ahead_.begin();
  EXPECT_EQ(look_ahead_.shares(), PaceShares{});
}

}  // namespace
