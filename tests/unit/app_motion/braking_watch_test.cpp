// Joints that brake worse than was identified: seen by their overrun of goal and model, limited for it, and let go faster again when they keep to both.
#include "motion/braking_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app_bench/bench_machine.hpp"
#include "motion/overrun_limits.hpp"
#include "motion/prediction_error.hpp"

namespace {

using namespace berm::app;

constexpr double reach = 6.5;

// One joint between its controller, which plans by what was identified, and the joint as it is.
class WorkingJoint {
public:
  WorkingJoint(std::size_t joint, double payload_kg, bool learns = true)
      : joint_(joint), loaded_(payload_kg > 0.0), learns_(learns), identified_(responses_of(machine_, joint, reach, payload_kg)), model_(identified_, machine_.cycle),
        controller_(identified_, machine_.cycle), watch_(identified_, machine_.cycle), error_(identified_, machine_.cycle),
        limits_(limits_of(machine_, joint, reach, payload_kg)) {}

  void brakes_with(double share) {
    TwoWayResponse weak = identified_;
    weak.up.deceleration *= share;
    weak.down.deceleration *= share;
    model_.respond(weak);
  }
  // A motion that lands: where it overran.
  std::optional<Braking> move(double goal) {
    const bool up = goal > model_.angle();
    std::optional<Braking> worst;
    for (int k = 0; k < 1200; ++k) {
      const double pace = learns_ ? (up ? learned_.paces(loaded_).up : learned_.paces(loaded_).down)[joint_] : 1.0;
      ControllerLimits limits = limits_;
      limits.velocity *= pace;
      limits.deceleration *= pace * pace;
      const double command = controller_.toward(goal, model_.angle(), model_.velocity(), limits);
      controller_.sent(command);
      const auto braking = watch_.step(identified_, command, model_.angle(), model_.velocity(), goal);
      error_.step(identified_, command, model_.angle(), model_.velocity(), true);
      model_.advance(command);
      if (braking && learned_.judge(joint_, loaded_, *braking)) worst = braking;
      farthest_ = k == 0 ? 0.0 : std::max(farthest_, (up ? 1.0 : -1.0) * (model_.angle() - goal));
    }
    return worst;
  }
  double farthest() const { return farthest_; }
  double pace_up() const { return learned_.paces(loaded_).up[joint_]; }
  double pace_down() const { return learned_.paces(loaded_).down[joint_]; }
  const OverrunLimits& learned() const { return learned_; }
  const PredictionError& error() const { return error_; }

private:
  MachineModel machine_ = berm::app_bench::zx200();
  std::size_t joint_;
  bool loaded_, learns_;
  TwoWayResponse identified_;
  JointModel model_;
  JointController controller_;
  BrakingWatch watch_;
  PredictionError error_;
  ControllerLimits limits_;
  OverrunLimits learned_;
  double farthest_ = 0.0;
};

TEST(BrakingWatch, AJointAsIdentifiedNeverOverruns) {
  for (const std::size_t j : {swing, boom, stick, bucket}) {
    for (const double kg : {0.0, 1500.0}) {
      WorkingJoint joint(j, kg);
      for (int k = 0; k < 3; ++k) {
        EXPECT_FALSE(joint.move(radians(40.0)));
        EXPECT_FALSE(joint.move(radians(-20.0)));
      }
      EXPECT_EQ(joint.pace_up(), 1.0);
      EXPECT_LT(joint.farthest(), radians(0.5));
      EXPECT_LT(joint.error().largest(), radians(0.05));
    }
  }
}

TEST(BrakingWatch, AnEmptySwingThatBrakesWorseIsSeenAndLimited) {
  WorkingJoint joint(swing, 0.0);
  joint.brakes_with(0.35);
  const auto first = joint.move(radians(90.0));
  ASSERT_TRUE(first);
  EXPECT_GT(first->over_model, OverrunLimits::model_figure);
  EXPECT_GT(joint.farthest(), OverrunLimits::goal_figure) << "the fault does not matter: the test shows nothing";
  EXPECT_LT(joint.pace_up(), 0.95);
  EXPECT_EQ(joint.pace_down(), 1.0) << "the other way nothing is known yet";
  EXPECT_EQ(joint.learned().paces(true).up[swing], 1.0) << "nor with a load";
  for (int k = 0; k < 6; ++k) {
    joint.move(radians(0.0));
    joint.move(radians(90.0));
  }
  EXPECT_FALSE(joint.move(radians(0.0)));
  EXPECT_FALSE(joint.move(radians(90.0)));
  EXPECT_LT(joint.farthest(), OverrunLimits::goal_figure);
}

TEST(BrakingWatch, WithoutTheLimitItGoesOnOverrunning) {
  WorkingJoint joint(swing, 0.0, false);
  joint.brakes_with(0.35);
  for (int k = 0; k < 6; ++k) {
    joint.move(radians(0.0));
    EXPECT_TRUE(joint.move(radians(90.0)));
    EXPECT_GT(joint.farthest(), OverrunLimits::goal_figure);
  }
}

TEST(BrakingWatch, ABoomThatIsLoweredUnderLoad) {
  WorkingJoint joint(boom, 1600.0);
  joint.move(radians(50.0));
  joint.brakes_with(0.4);
  ASSERT_TRUE(joint.move(radians(0.0)));
  EXPECT_LT(joint.pace_down(), 1.0);
  for (int k = 0; k < 6; ++k) {
    joint.move(radians(50.0));
    joint.move(radians(0.0));
  }
  joint.move(radians(50.0));
  EXPECT_FALSE(joint.move(radians(0.0)));
  EXPECT_LT(joint.farthest(), OverrunLimits::goal_figure);
}

TEST(BrakingWatch, WhatWasLearnedIsSlowlyUnlearned) {
  WorkingJoint joint(swing, 0.0);
  joint.brakes_with(0.35);
  joint.move(radians(90.0));
  const double learned = joint.pace_up();
  ASSERT_LT(learned, 1.0);
  joint.brakes_with(1.0);
  joint.move(radians(0.0));
  joint.move(radians(90.0));
  EXPECT_GT(joint.pace_up(), learned);
  EXPECT_LT(joint.pace_up(), learned + 0.05) << "not at once";
  for (int k = 0; k < 120; ++k) {
    joint.move(radians(0.0));
    joint.move(radians(90.0));
  }
  EXPECT_EQ(joint.pace_up(), 1.0);
}

// What slows it down is the goal itself.
TEST(BrakingWatch, AGoalThatIsSetNearerThanItCanStopIsNoOverrun) {
  const MachineModel m = berm::app_bench::zx200();
  const TwoWayResponse response = responses_of(m, bucket, reach, 0.0);
  JointModel model(response, m.cycle);
  JointController controller(response, m.cycle);
  BrakingWatch watch(response, m.cycle);
  const ControllerLimits limits = limits_of(m, bucket, reach, 0.0);
  bool ended = false;
  double beyond = 0.0;
  for (int k = 0; k < 400; ++k) {
    const double goal = k < 80 ? 1.5 : 0.45;
    const double command = controller.toward(goal, model.angle(), model.velocity(), limits);
    controller.sent(command);
    if (const auto braking = watch.step(response, command, model.angle(), model.velocity(), goal)) {
      EXPECT_FALSE(OverrunLimits::overran(*braking)) << "in step " << k;
      ended = true;
    }
    model.advance(command);
    if (k >= 80) beyond = std::max(beyond, model.angle() - goal);
  }
  EXPECT_TRUE(ended);
  EXPECT_GT(beyond, OverrunLimits::goal_figure) << "it could stop: the test shows nothing";
}

TEST(PredictionError, SaysHowFarTheModelIsOff) {
  const MachineModel m = berm::app_bench::zx200();
  const TwoWayResponse identified = responses_of(m, swing, reach, 0.0);
  TwoWayResponse slower = identified;
  slower.up.acceleration *= 0.5;
  JointModel plant(slower, m.cycle);
  PredictionError error(identified, m.cycle), held_up(identified, m.cycle);
  for (int k = 0; k < 58; ++k) {  // the first half second from when it moves
    error.step(identified, 1.0, plant.angle(), plant.velocity(), k >= 7);
    held_up.step(identified, 1.0, plant.angle(), plant.velocity(), false);
    plant.advance(1.0);
  }
  error.step(identified, 1.0, plant.angle(), plant.velocity(), true);
  EXPECT_GT(error.largest(), radians(0.5));
  EXPECT_EQ(error.largest(), error.root_mean_square());
  EXPECT_EQ(held_up.largest(), 0.0);
}

}  // namespace
