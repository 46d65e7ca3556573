// How a joint answers commands: the lag within the limits, against fine steps of its differential equation, and what is taken of a machine file.
#include "motion/joint_response.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app_bench/bench_machine.hpp"

namespace {

using namespace berm::app;

JointResponse lagging() {
  JointResponse r{0.06, 0.4, 0.9};
  r.lag = 0.12, r.stop_lag = 0.05, r.deceleration = 0.7, r.gain = 0.98;
  return r;
}

// The same in steps of ten microseconds.
double in_fine_steps(const JointResponse& r, double speed, double command, double seconds) {
  constexpr double h = 1e-5;
  const double wanted = std::clamp(r.gain * command, -r.velocity_max, r.velocity_max);
  for (double t = 0.0; t < seconds - 0.5 * h; t += h) {
    const bool turns = speed * wanted < 0.0, slows = turns || std::fabs(wanted) < std::fabs(speed);
    const double limit = slows ? r.deceleration : r.acceleration, lag = wanted == 0.0 ? r.stop_lag : r.lag;
    const double rate = turns ? std::copysign(limit, wanted) : std::clamp((wanted - speed) / lag, -limit, limit);
    speed += rate * h;
  }
  return speed;
}

TEST(JointResponse, FollowsAsAFirstOrderLagWithinItsLimits) {
  const JointResponse r = lagging();
  for (const double speed : {-0.6, -0.02, 0.0, 0.03, 0.3, 0.8})
    for (const double command : {-0.8, -0.1, 0.0, 0.05, 0.3, 0.85, 2.0})
      for (const double seconds : {0.01, 0.1, 0.7, 3.0})
        EXPECT_NEAR(speed_after(r, speed, command, seconds), in_fine_steps(r, speed, command, seconds), 2e-4) << speed << " to " << command << " in " << seconds;
}

TEST(JointResponse, ManyShortStepsAreALongOne) {
  const JointResponse r = lagging();
  double speed = -0.3;
  for (int k = 0; k < 150; ++k) speed = speed_after(r, speed, 0.6, 0.01);
  EXPECT_NEAR(speed, speed_after(r, -0.3, 0.6, 1.5), 1e-9);
}

TEST(JointResponse, WithoutAnIdentificationAsTheMachineFilePromises) {
  MachineModel m = berm::app_bench::zx200();
  m.responses.reset();
  for (const JointResponse& r : {response_of(m, boom), responses_of(m, boom, 7.0, 900.0).down, command_responses_of(m, boom, 5.0, 0.0).up}) {
    EXPECT_EQ(r.dead_time, m.command_latency);
    EXPECT_EQ(r.acceleration, m.joint[boom].acceleration_max);
    EXPECT_EQ(r.lag, 0.0);
    EXPECT_EQ(speed_after(r, 0.1, 0.0, 0.05), 0.1 - 0.05 * r.acceleration) << "slows as it speeds up";
  }
}

TEST(JointResponse, BetweenLoadsAndReachesByTheInertia) {
  const MachineModel m = berm::app_bench::zx200();
  ASSERT_TRUE(m.responses);
  const MachineModel::StepResponses& known = *m.responses;
  const auto& slowing = known.joint[swing].up.slowing;
  const auto at = [&](double reach, double kg) { return command_responses_of(m, swing, reach, kg).up.deceleration; };
  EXPECT_NEAR(at(known.reach[1], 0.0), slowing[0][1], 1e-12);
  EXPECT_NEAR(at(known.reach[2], known.payload_kg), slowing[1][2], 1e-12);
  EXPECT_NEAR(at(1.0, 0.0), slowing[0].front(), 1e-12) << "nearer than any pose";
  EXPECT_NEAR(at(20.0, 2.0 * known.payload_kg), slowing[1].back(), 1e-12) << "farther, and heavier";
  EXPECT_NEAR(1.0 / at(known.reach[1], 0.5 * known.payload_kg), 0.5 / slowing[0][1] + 0.5 / slowing[1][1], 1e-9);
  EXPECT_LT(at(9.0, known.payload_kg), 0.5 * at(6.0, 0.0));
}

TEST(JointResponse, ARequestIsACommandACycleLater) {
  const MachineModel m = berm::app_bench::zx200();
  EXPECT_NEAR(responses_of(m, stick, 7.0, 0.0).up.dead_time - command_responses_of(m, stick, 7.0, 0.0).up.dead_time, m.cycle, 1e-12);
}

}  // namespace
