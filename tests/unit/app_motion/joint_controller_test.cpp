// A joint whose requests the kernel cuts: what it asks for then, and what it counts on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "app_bench/bench_machine.hpp"
#include "motion/arm_controller.hpp"

namespace {

using namespace berm::app;

constexpr double nothing_cut = std::numeric_limits<double>::infinity();

// A joint as its file promises, behind a kernel that lets out no more than most (rad/s) and says so as the contract has it.
struct CutJoint {
  explicit CutJoint(std::size_t j = swing)
      : machine(berm::app_bench::zx200()), limits(limits_of(machine, j, 7.0)), largest(machine.joint[j].velocity_max), model(response_of(machine, j), machine.cycle),
        controller(response_of(machine, j), machine.cycle) {}

  void step(double goal, double most) {
    controller.heard(let_out, low, high);
    asked = controller.toward(goal, model.angle(), model.velocity(), limits);
    controller.asked(asked);
    beyond = std::max({beyond, asked - high, low - asked});
    let_out = std::clamp(asked, -most, most);
    const bool whole = let_out == asked;
    low = whole ? -largest : std::min(0.0, let_out);
    high = whole ? largest : std::max(0.0, let_out);
    model.advance(let_out);
  }

  MachineModel machine;
  ControllerLimits limits;
  double largest;
  JointModel model;
  JointController controller;
  double asked = 0.0, let_out = 0.0, low = -largest, high = largest, beyond = -1e9;
};

TEST(CutJoint, NeverAsksForMoreThanIsPermittedNow) {
  for (const double goal : {radians(150.0), radians(-150.0)}) {
    CutJoint joint;
    int pressed = 0;
    for (int k = 0; k < 1500; ++k) {
      const double most = k < 100 ? nothing_cut : k < 300 ? 0.4 : k < 500 ? 0.15 : k < 520 ? 0.0 : k < 700 ? 0.3 : nothing_cut;
      joint.step(goal, most);
      pressed += joint.let_out != joint.asked;
    }
    EXPECT_LE(joint.beyond, 0.0);
    EXPECT_GT(pressed, 100) << "nothing was cut: the test shows nothing";
    EXPECT_NEAR(joint.model.angle(), goal, radians(1.0));
  }
}

TEST(CutJoint, GoesOnFromWhatWasLetOut) {
  CutJoint joint;
  const double up = joint.limits.acceleration * joint.machine.cycle, full = joint.limits.velocity;
  for (int k = 0; k < 400; ++k) joint.step(radians(170.0), k < 150 ? nothing_cut : 0.25 * full);
  EXPECT_LT(joint.controller.share(), 0.27);
  EXPECT_GT(joint.controller.share(), 0.2);
  int steps = 0;
  double before = joint.let_out;
  for (; joint.asked < full - 1e-9 && steps < 500; ++steps) {
    joint.step(radians(170.0), nothing_cut);
    ASSERT_LE(joint.asked - before, up + 1e-12) << "jumped " << steps << " steps after the room was there again";
    before = joint.asked;
  }
  EXPECT_NEAR(steps, 0.75 * full / up, 2.0) << "and no slower than it accelerates otherwise";
  EXPECT_EQ(joint.controller.share(), 1.0);
}

// A joint that follows its command with a lag: to full speed it takes no longer than it can, and the request is never farther ahead of it than that asks for.
TEST(JointController, AJointThatLagsSpeedsUpAsFastAsItCan) {
  constexpr double lag = 0.12, acceleration = 0.35, step = 0.01;
  const JointResponse response{0.06, acceleration, 0.87, lag};
  const ControllerLimits limits{0.7, acceleration, 0.3, 4.5};
  for (const double goal : {2.5, -2.5}) {
    JointModel model(response, step);
    JointController controller(response, step);
    double ahead = 0.0, reached_s = 0.0;
    for (int k = 0; k < 400 && reached_s == 0.0; ++k) {
      const double asked = controller.toward(goal, model.angle(), model.velocity(), limits);
      ahead = std::max(ahead, std::fabs(asked - controller.predict(model.angle(), model.velocity()).velocity));
      controller.sent(asked);
      EXPECT_EQ(controller.share(), 1.0);
      model.advance(asked);
      if (std::fabs(model.velocity()) > 0.6) reached_s = (k + 1) * step;
    }
    EXPECT_NEAR(reached_s, response.dead_time + 0.6 / acceleration, 0.02);
    EXPECT_LE(ahead, acceleration * (lag + 2.0 * step) + 1e-9);
  }
}

TEST(CutJoint, PredictsFromWhatWasLetOut) {
  CutJoint joint;
  for (int k = 0; k < 400; ++k) {
    joint.step(radians(170.0), k < 150 ? nothing_cut : k < 300 ? 0.1 : 0.3);
    JointController controller = joint.controller;
    JointModel model = joint.model;
    controller.heard(joint.let_out, joint.low, joint.high);
    const JointModel::State then = controller.predict(model.angle(), model.velocity());
    for (int later = 0; later < std::lround(response_of(joint.machine, swing).dead_time / joint.machine.cycle); ++later) model.advance(0.0);  // these act later still
    ASSERT_NEAR(then.angle, model.angle(), 1e-9) << "in step " << k;
    ASSERT_NEAR(then.velocity, model.velocity(), 1e-9) << "in step " << k;
  }
}

TEST(CutJoint, CyclesThatWereMissedAreAsTheOneThatWasSeen) {
  CutJoint every, some;
  for (int k = 0; k < 9; ++k) every.controller.heard(0.2, -1.0, 1.0);
  some.controller.heard(0.2, -1.0, 1.0, 9);
  EXPECT_GT(every.controller.predict(0.0, 0.0).angle, 0.0);
  EXPECT_EQ(some.controller.predict(0.0, 0.0).angle, every.controller.predict(0.0, 0.0).angle);
}

TEST(CutJoint, KnowsItsShareAsSoonAsItHears) {
  CutJoint joint;
  for (int k = 0; k < 100; ++k) joint.step(radians(170.0), nothing_cut);
  joint.controller.heard(0.25 * joint.asked, 0.0, 0.25 * joint.asked);
  EXPECT_TRUE(joint.controller.cut());
  EXPECT_NEAR(joint.controller.share(), 0.25, 1e-9);
}

// The bus has whole steps, the request whole millionths.
TEST(CutJoint, MoreThanAStepOfTheBusIsACutAndJustAStepIsNot) {
  for (int below = 0; below <= 1200; below += 100) {
    CutJoint joint;
    for (int k = 0; k < 100; ++k) joint.step(radians(170.0), nothing_cut);
    const double permitted = 0.4;
    joint.controller.asked(permitted + 1e-6 * below + 3e-7);  // a fraction of a millionth, which the request drops
    joint.controller.heard(permitted, 0.0, permitted);
    EXPECT_EQ(joint.controller.cut(), below > 500) << below;
  }
}

TEST(CutJoint, WhatTheAppsOwnGuardTakesIsNoCut) {
  CutJoint joint;
  for (int k = 0; k < 200; ++k) {
    joint.controller.heard(joint.let_out, joint.low, joint.high);
    EXPECT_FALSE(joint.controller.cut());
    joint.let_out = 0.5 * joint.controller.toward(1.0, 0.0, 0.0, joint.limits);
    joint.controller.asked(joint.let_out);
    EXPECT_EQ(joint.controller.share(), 1.0);
  }
}

TEST(CutJoint, AtALowerTempoPassesTheSameAnglesAtThatShareOfTheSpeeds) {
  constexpr double tempo = 0.25;
  CutJoint quick, slow;
  slow.limits = slow.limits.at_tempo(tempo);
  const double goal = radians(60.0);
  std::vector<std::pair<double, double>> way;  // angle and speed
  for (int k = 0; k < 1000; ++k) {
    quick.step(goal, nothing_cut);
    way.emplace_back(quick.model.angle(), quick.model.velocity());
  }
  std::size_t at = 0;
  int compared = 0;
  for (int k = 0; k < 4000; ++k) {
    slow.step(goal, nothing_cut);
    const double angle = slow.model.angle();
    if (angle < radians(5.0) || angle > radians(55.0)) continue;  // the dead time at the start is not slower; the landing is noise
    while (way[at].first < angle) ++at;
    EXPECT_NEAR(slow.model.velocity(), tempo * way[at].second, 0.006) << "at " << degrees(angle) << " deg";
    ++compared;
  }
  EXPECT_GT(compared, 200);
}

TEST(CutJoint, NothingPermittedIsNoSlowDown) {
  CutJoint joint;
  for (int k = 0; k < 200; ++k) {
    joint.step(1.5, k < 100 ? nothing_cut : 0.0);
    if (k > 100) {
      EXPECT_FALSE(joint.controller.cut());
    }
  }
  EXPECT_EQ(joint.let_out, 0.0);
}

}  // namespace
