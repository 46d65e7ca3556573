// verifies when a bucket in the soil is stalled: joints that stand and cylinders that press, and for how long.
#include "motion/dig_stall.hpp"

#include <gtest/gtest.h>

namespace berm::app {
namespace {

constexpr double cycle = 0.01;

// s until it is told, no more than ten.
double until_told(DigStall& stall, const DigEffort& effort) {
  double seconds = 0.0;
  for (; stall.told() == DigStall::Told::no && seconds < 10.0; seconds += cycle) stall.add(effort, cycle);
  return seconds;
}

// A machine that has cut with 60 kN.
DigStall after_digs() {
  DigStall stall(1.0);
  stall.begin();
  for (int k = 0; k < 100; ++k) stall.add({false, 1.0, 60e3, 1.0}, cycle);
  stall.begin();
  return stall;
}

TEST(DigStall, JointsThatStandWhileTheSoilPressesHardAreStalledInASecond) {
  DigStall stall = after_digs();
  EXPECT_NEAR(stall.hardest_n(), 60e3, 100.0);
  EXPECT_NEAR(until_told(stall, {true, 1.0, 58e3, 0.0}), 1.1, 0.15);
  EXPECT_EQ(stall.told(), DigStall::Told::by_soil);
}

TEST(DigStall, JointsThatStandWithoutAForceAreGivenThreeTimesAsLong) {
  DigStall stall = after_digs();
  EXPECT_NEAR(until_told(stall, {true, 1.0, 10e3, 0.0}), 3.0, 0.05);
  EXPECT_EQ(stall.told(), DigStall::Told::standing);
}

TEST(DigStall, AHardForceAloneIsNone) {
  DigStall stall = after_digs();
  EXPECT_GE(until_told(stall, {false, 1.0, 90e3, 0.1}), 10.0);
}

TEST(DigStall, WithoutPressuresWhatTheJointsDoHasToTell) {
  DigStall stall = after_digs();
  EXPECT_NEAR(until_told(stall, {true, 1.0, std::nullopt, 0.0}), 1.0, 0.05);
  EXPECT_EQ(stall.told(), DigStall::Told::by_soil);
}

TEST(DigStall, WhatTheKernelSlowsIsGivenTheTimeAndWhatGetsOnBeginsAnew) {
  DigStall slow = after_digs(), on = after_digs();
  EXPECT_NEAR(until_told(slow, {true, 0.25, 58e3, 0.0}), 4.1, 0.2);
  for (int k = 0; k < 20; ++k) {
    for (int held = 0; held < 90; ++held) on.add({true, 1.0, 58e3, 0.0}, cycle);
    on.add({false, 1.0, 58e3, 0.5}, cycle);
  }
  EXPECT_EQ(on.told(), DigStall::Told::no);
}

// What presses on a bucket that stands is no force that was overcome: else none would ever be hard enough.
TEST(DigStall, TheHardestIsWhatWasOvercome) {
  DigStall stall = after_digs();
  for (int k = 0; k < 50; ++k) stall.add({true, 1.0, 200e3, 0.0}, cycle);
  for (int k = 0; k < 50; ++k) stall.add({false, 1.0, 200e3, 0.05}, cycle);
  EXPECT_NEAR(stall.hardest_n(), 60e3, 100.0);
}

}  // namespace
}  // namespace berm::app
