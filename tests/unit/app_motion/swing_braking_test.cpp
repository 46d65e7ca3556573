#include "motion/swing_braking.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using berm::app::SwingBraking;

constexpr double cycle = 0.01;

// A swing that goes up to 0.6 rad/s and lands as its controller plans, or as hard as it can.
void land(SwingBraking& brakes, double planned, double able, double& time_s) {
  const double braking = std::min(planned, able);
  double speed = 0.0;
  for (; speed < 0.6; speed += 0.3 * cycle, time_s += cycle) brakes.step(time_s, -speed, planned);
  for (; speed > 0.0; speed -= braking * cycle, time_s += cycle) brakes.step(time_s, -speed, planned);
  brakes.step(time_s, 0.0, planned);
}

TEST(SwingBraking, KnowsNothingBeforeALanding) {
  SwingBraking brakes(0.4);
  EXPECT_EQ(brakes.known(), 0.0);
}

TEST(SwingBraking, IsAskedForMoreUntilTheMost) {
  SwingBraking brakes(0.37);
  double time_s = 0.0, before = 0.2;
  for (int k = 0; k < 6; ++k) {
    const double planned = std::max(0.2, brakes.known());
    land(brakes, planned, 1.0, time_s);
    EXPECT_GE(brakes.known(), std::min(0.37, 1.2 * planned));
    EXPECT_GE(brakes.known(), before);
    before = brakes.known();
  }
  EXPECT_DOUBLE_EQ(brakes.known(), 0.37);
}

TEST(SwingBraking, FallsBackToWhatTheMachineDoes) {
  SwingBraking brakes(0.5);
  double time_s = 0.0;
  for (int k = 0; k < 12; ++k) land(brakes, std::max(0.2, brakes.known()), 0.3, time_s);
  EXPECT_LE(brakes.known(), 0.32);
  EXPECT_GE(brakes.known(), 0.2);
  const double settled = brakes.known();
  for (int k = 0; k < 5; ++k) land(brakes, std::max(0.2, brakes.known()), 0.3, time_s);
  EXPECT_EQ(brakes.known(), settled) << "it does not try again and again what failed";
}

TEST(SwingBraking, ASlowSwingSaysNothing) {
  SwingBraking brakes(0.4);
  double time_s = 0.0;
  for (double speed = 0.0; speed < 0.2; speed += 0.003, time_s += cycle) brakes.step(time_s, speed, 0.2);
  for (double speed = 0.2; speed > 0.0; speed -= 0.002, time_s += cycle) brakes.step(time_s, speed, 0.2);
  EXPECT_EQ(brakes.known(), 0.0);
}

// Slowed on its way it goes on slowly, and lands from there: taken for one landing it would be the weakest of all.
TEST(SwingBraking, LearnsNothingOfASwingThatIsSlowedOnItsWay) {
  for (const bool told : {true, false}) {
    SwingBraking brakes(0.4);
    double time_s = 0.0;
    for (int k = 0; k < 2; ++k) land(brakes, std::max(0.2, brakes.known()), 1.0, time_s);
    const double known = brakes.known();
    double speed = 0.0;
    for (; speed < 0.6; speed += 0.3 * cycle, time_s += cycle) brakes.step(time_s, speed, known);
    for (; speed > 0.3; speed -= known * cycle, time_s += cycle) brakes.step(time_s, speed, known);
    for (int k = 0; k < 300; ++k, time_s += cycle) told ? brakes.forget() : brakes.step(time_s, speed, known);
    for (; speed > 0.0; speed -= known * cycle, time_s += cycle) told ? brakes.forget() : brakes.step(time_s, speed, known);
    if (told) EXPECT_EQ(brakes.known(), known);
    else EXPECT_LT(brakes.known(), known) << "the test shows nothing";
  }
}

}  // namespace
