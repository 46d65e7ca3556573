#include "planning/pass_simulation.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "bench_pass.hpp"

namespace {

using namespace berm::app;
using berm::app_bench::BenchPass;

// The pass that the search finds on a bench.
class BenchSimulation : public ::testing::Test {
protected:
  void SetUp() override {
    const auto poses = pass_poses(pass_.machine, pass_.task);
    ASSERT_TRUE(poses);
    PassSearch search = pass_.begin(*poses);
    while (!search.done()) search.step();
    ASSERT_TRUE(search.clear());
    seconds_ = search.seconds();
    script_ = pass_script(pass_.scripts, pass_.machine, pass_.task, search.poses(), search.thresholds());
    script_.start();
    course_ = {pass_.machine.bucket_payload_kg, pass_.task.brake_empty, search.poses().dump[bucket]};
    simulation_.begin(script_, ArmController(pass_.machine), pass_.task.lifted_from, {}, course_);
  }
  bool step(PassSimulation& simulation) const {
    simulation.evaluate();
    return simulation.advance();
  }

  BenchPass pass_;
  Script script_;
  PassCourse course_;
  double seconds_ = 0.0;
  PassSimulation simulation_{pass_.machine};
};

TEST_F(BenchSimulation, TakesAsLongAsTheSearchSaysAndEndsOverTheNextDig) {
  while (step(simulation_)) ASSERT_LT(simulation_.seconds(), 30.0);
  EXPECT_DOUBLE_EQ(simulation_.seconds(), seconds_);
  EXPECT_TRUE(simulation_.script().at_last());
  EXPECT_NEAR(simulation_.angle()[swing], pass_.task.next_bearing, radians(1.0));
}

// From the rules that are active by then, the joints' speeds and the commands under way.
TEST_F(BenchSimulation, BegunAnewAmidTheMotionGoesOnTheSameWay) {
  while (simulation_.seconds() < 3.0) ASSERT_TRUE(step(simulation_));
  ASSERT_GT(simulation_.velocity()[swing], radians(10.0)) << "it does not swing yet";
  ASSERT_FALSE(simulation_.script().of(bucket).reached(RuleMark::opens));
  PassSimulation amid(pass_.machine);
  amid.begin(simulation_.script(), simulation_.arm(), simulation_.angle(), simulation_.velocity(), course_);
  for (bool goes_on = true; goes_on;) {
    goes_on = step(simulation_);
    ASSERT_EQ(step(amid), goes_on);
    for (std::size_t j = 0; j < joints; ++j) {
      ASSERT_EQ(amid.angle()[j], simulation_.angle()[j]) << "joint " << j << ", " << amid.seconds() << " s on";
      ASSERT_EQ(amid.velocity()[j], simulation_.velocity()[j]);
    }
  }
  EXPECT_NEAR(amid.seconds(), seconds_ - 3.0, 1e-9);
}

// The joints that wait for the swing wait for a slowed one, too: at each swing angle of the way down the arm is no lower.
TEST_F(BenchSimulation, WhatTheSwingTimesIsSlowedWithIt) {
  while (!simulation_.returns()) ASSERT_TRUE(step(simulation_));
  PassSimulation slow(pass_.machine);
  PassCourse slowed = course_;
  slowed.events = event_emptied | event_empties;
  slowed.shares = {0.25, 1.0};
  slow.begin(simulation_.script(), simulation_.arm(), simulation_.angle(), simulation_.velocity(), slowed);
  const auto tip_at = [this](PassSimulation& simulation, double bearing) {
    while (simulation.angle()[swing] > bearing) EXPECT_TRUE(step(simulation));
    return forward(pass_.machine, simulation.angle()).tip.z;
  };
  for (const double deg : {20.0, 12.0, 6.0}) EXPECT_GT(tip_at(slow, radians(deg)), tip_at(simulation_, radians(deg)) - 0.15) << deg;
  EXPECT_GT(slow.seconds(), 2.0 * seconds_ / 3.0) << "it is not slowed";
}

}  // namespace
