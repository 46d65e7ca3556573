// Late cycles and the histogram of CPU times.
#include <gtest/gtest.h>

#include "io/clock.hpp"
#include "io/cpu_histogram.hpp"

namespace berm::kernel {
namespace {

// verifies: SK-CY-17
TEST(CycleWatch, CountsLateCyclesAndFaultsVeryLateOnesAndTimeThatRunsBackwards) {
  CycleWatch watch;
  EXPECT_FALSE(watch.check(1000000));
  EXPECT_FALSE(watch.check(1010000));
  EXPECT_FALSE(watch.check(1030000));
  EXPECT_EQ(watch.lost_cycles(), 0U);
  EXPECT_FALSE(watch.check(1050001));
  EXPECT_EQ(watch.lost_cycles(), 1U);
  EXPECT_FALSE(watch.check(1050001 + BERM_CAN_SILENCE_US));
  EXPECT_TRUE(watch.check(1050002 + 2 * BERM_CAN_SILENCE_US)) << "the machine has braked by itself";
  EXPECT_EQ(watch.lost_cycles(), 3U);
  EXPECT_TRUE(watch.check(1050002 + 2 * BERM_CAN_SILENCE_US));
  EXPECT_TRUE(watch.check(1050001 + 2 * BERM_CAN_SILENCE_US));
  EXPECT_FALSE(watch.check(1170000));
}

// verifies: SK-CY-28, IF-CAN-22
TEST(CycleWatch, WhatWasDecidedTooLongAgoIsNotSent) {
  CycleWatch watch;
  watch.check(1000000);
  EXPECT_TRUE(watch.may_send(1000000));
  EXPECT_TRUE(watch.may_send(1000000 + BERM_CAN_SEND_LATE_US));
  EXPECT_EQ(watch.unsent_cycles(), 0U);
  EXPECT_FALSE(watch.may_send(1000001 + BERM_CAN_SEND_LATE_US));
  EXPECT_FALSE(watch.may_send(999999)) << "time that runs backwards";
  EXPECT_EQ(watch.unsent_cycles(), 2U);
  watch.check(1010000);
  EXPECT_TRUE(watch.may_send(1010100));
}

// verifies: SK-CY-90
TEST(CpuHistogram, GivesQuantilesOfWhatWasAdded) {
  CpuHistogram histogram;
  EXPECT_EQ(histogram.quantile_us(0.5), 0);
  for (int us = 1; us <= 100; ++us) histogram.add(us);
  EXPECT_EQ(histogram.quantile_us(0.5), 50);
  EXPECT_EQ(histogram.quantile_us(0.99), 99);
  histogram.add(1000000);
  EXPECT_EQ(histogram.max_us(), 1000000);
  EXPECT_EQ(histogram.quantile_us(1.0), 1000000);
  histogram.add(-5);
  EXPECT_EQ(histogram.count(), 102U);
}

}  // namespace
}  // namespace berm::kernel
