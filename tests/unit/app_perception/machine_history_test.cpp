#include <gtest/gtest.h>

#include "drawn_scan.hpp"

namespace {

using namespace berm::app;
using drawn::state_at;

TEST(MachineHistory, IsLinearBetweenStatesAndKnowsNothingBeyondThem) {
  MachineHistory history;
  EXPECT_FALSE(history.at(0));
  EXPECT_EQ(history.newest_ns(), -1);
  history.push(state_at(10'000, {0.1, 0.2, -1.0, -2.0}));
  history.push(state_at(20'000, {0.2, 0.4, -1.2, -2.0}));
  const auto pose = history.at(12'500'000);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->angle[swing], 0.125, 1e-12);
  EXPECT_NEAR(pose->angle[boom], 0.25, 1e-12);
  EXPECT_NEAR(pose->angle[stick], -1.05, 1e-12);
  EXPECT_NEAR(pose->angle[bucket], -2.0, 1e-12);
  EXPECT_TRUE(pose->neighbours);
  EXPECT_FALSE(history.at(9'999'999));
  EXPECT_FALSE(history.at(20'000'001));
  EXPECT_NEAR(history.at(20'000'000)->angle[swing], 0.2, 1e-12);
}

TEST(MachineHistory, TheSwingGoesTheShortWayRound) {
  MachineHistory history;
  history.push(state_at(10'000, {3.1, 0.0, 0.0, 0.0}));
  history.push(state_at(20'000, {-3.1, 0.0, 0.0, 0.0}));
  EXPECT_NEAR(std::fabs(wrapped(history.at(15'000'000)->angle[swing])), std::numbers::pi, 1e-6);
}

TEST(MachineHistory, AStateThatBroughtNoNewAnglesIsLeftOutAndTheGapIsTold) {
  MachineHistory history;
  const Joints fast{0.6, 0.0, 0.0, 0.0};
  history.push(state_at(10'000, {0.100, 0.5, 0.0, 0.0}, fast));
  history.push(state_at(20'000, {0.100, 0.5, 0.0, 0.0}, fast));
  history.push(state_at(30'000, {0.112, 0.5, 0.0, 0.0}, fast));
  const auto pose = history.at(20'000'000);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->angle[swing], 0.106, 1e-12);
  EXPECT_FALSE(pose->neighbours);
}

TEST(MachineHistory, AMachineThatStandsHasTheSameAnglesCycleAfterCycle) {
  MachineHistory history;
  for (int k = 1; k <= 5; ++k) history.push(state_at(k * 10'000, {0.1, 0.5, 0.0, 0.0}));
  EXPECT_EQ(history.newest_ns(), 50'000'000);
  EXPECT_TRUE(history.at(45'000'000)->neighbours);
}

TEST(MachineHistory, ATimeThatDoesNotRiseOrIsNoneIsLeftOut) {
  MachineHistory history;
  history.push(state_at(20'000, {0.1, 0.0, 0.0, 0.0}));
  history.push(state_at(20'000, {0.9, 0.0, 0.0, 0.0}));
  history.push(state_at(10'000, {0.9, 0.0, 0.0, 0.0}));
  history.push(state_at(-1, {0.9, 0.0, 0.0, 0.0}));
  history.push(state_at(INT64_MAX, {0.9, 0.0, 0.0, 0.0}));
  EXPECT_EQ(history.newest_ns(), 20'000'000);
  EXPECT_NEAR(history.at(20'000'000)->angle[swing], 0.1, 1e-12);
}

// verifies: IF-CT-16 (a reader)
TEST(MachineHistory, TakesEveryCycleThatTheRingStillHas) {
  const double rate = 0.5;
  drawn::Segment segment([&](double t) { return Joints{rate * t, 0.0, 0.0, 0.0}; });
  MachineHistory history;
  segment.run_to(0.05);
  history.take(*segment.at);
  EXPECT_NEAR(history.at(42'000'000)->angle[swing], rate * 0.042, 1e-6);
  segment.run_to(0.45);  // slept through forty cycles
  history.take(*segment.at);
  EXPECT_TRUE(history.at(303'000'000)->neighbours);
  EXPECT_NEAR(history.at(303'000'000)->angle[swing], rate * 0.303, 1e-6);
  segment.run_to(10.0);  // and through more than the ring holds
  history.take(*segment.at);
  EXPECT_EQ(history.newest_ns(), 10'000'000'000);
  EXPECT_NEAR(history.at(9'999'000'000)->angle[swing], rate * 9.999, 1e-5);
  EXPECT_FALSE(history.at(9'000'000'000));
}

}  // namespace
