// The governor by time: levels whose stopping time is enough, against the braking table read by hand.
#include <gtest/gtest.h>

#include "core/governor.h"
#include "reach_parameters.hpp"

namespace berm::core_test {
namespace {

constexpr int kLast = SK_GOVERNOR_LEVELS - 1;

// 0.7 rad/s, columns of 0.1 rad/s; a stop from column k takes k * 200 ms in row 0, and 10 + 70 ms of cycle and command latency.
class GovernorTime : public testing::Test {
 protected:
  GovernorTime() : p(reach_parameters()) {
    for (int joint = 0; joint < SK_JOINTS; ++joint)
      for (int row = 0; row < BERM_BRAKE_REACHES; ++row)
        for (int column = 0; column < BERM_BRAKE_SPEEDS; ++column) p.brake_time_us[joint][row][column] = (row + 1) * column * 200'000;
  }
  berm_parameters p;
};

// verifies: SK-SD-10
TEST_F(GovernorTime, StopTimeIsCycleCommandLatencyAndTheTablesNextColumn) {
  EXPECT_EQ(sk_governor_stop_time(&p, 0, 0, 0), 80'000);
  EXPECT_EQ(sk_governor_stop_time(&p, 0, 0, 1), 280'000);
  EXPECT_EQ(sk_governor_stop_time(&p, 0, 0, 100'000), 280'000);
  EXPECT_EQ(sk_governor_stop_time(&p, 0, 0, 100'001), 480'000);
  EXPECT_EQ(sk_governor_stop_time(&p, 3, 1, 700'000), 80'000 + 2'800'000);
}

// verifies: SK-SD-10
TEST_F(GovernorTime, StopTimeRefusesWhatIsOutOfRange) {
  EXPECT_EQ(sk_governor_stop_time(&p, -1, 0, 0), -1);
  EXPECT_EQ(sk_governor_stop_time(&p, SK_JOINTS, 0, 0), -1);
  EXPECT_EQ(sk_governor_stop_time(&p, 0, -1, 0), -1);
  EXPECT_EQ(sk_governor_stop_time(&p, 0, BERM_BRAKE_REACHES, 0), -1);
  EXPECT_EQ(sk_governor_stop_time(&p, 0, 0, 700'001), -1);
  p.brake_time_us[0][0][1] = -1;
  EXPECT_EQ(sk_governor_stop_time(&p, 0, 0, 50'000), -1);
  EXPECT_EQ(sk_governor_timed_level(&p, 0, 0, 10'000'000), 0) << "where the table is out of range nothing is permitted";
  p.command_latency_us = -1;
  EXPECT_EQ(sk_governor_stop_time(&p, 1, 0, 0), -1);
}

// verifies: SK-SD-11
TEST_F(GovernorTime, ALevelNeedsTheNextFasterOneAndBeyondTheFirstColumnAColumnMore) {
  EXPECT_EQ(sk_governor_level_time(&p, 0, 0, 0), 280'000);
  EXPECT_EQ(sk_governor_level_time(&p, 0, 0, 3), 280'000) << "the next, 4, is the first column's speed";
  EXPECT_EQ(sk_governor_level_time(&p, 0, 0, 4), 480'000 + 280'000);
  EXPECT_EQ(sk_governor_level_time(&p, 0, 0, 7), 480'000 + 280'000);
  EXPECT_EQ(sk_governor_level_time(&p, 0, 0, 8), 680'000 + 280'000);
  EXPECT_EQ(sk_governor_level_time(&p, 0, 0, kLast), 1'480'000 + 280'000);
  EXPECT_EQ(sk_governor_level_time(&p, 0, 0, -1), -1);
  EXPECT_EQ(sk_governor_level_time(&p, 0, 0, SK_GOVERNOR_LEVELS), -1);
  EXPECT_EQ(sk_governor_level_time(&p, SK_JOINTS, 0, 1), -1);
}

// verifies: SK-SD-12
TEST_F(GovernorTime, TheHighestLevelInTime) {
  EXPECT_EQ(sk_governor_timed_level(&p, 0, 0, -1), 0);
  EXPECT_EQ(sk_governor_timed_level(&p, 0, 0, 279'999), 0);
  EXPECT_EQ(sk_governor_timed_level(&p, 0, 0, 280'000), 3);
  EXPECT_EQ(sk_governor_timed_level(&p, 0, 0, 759'999), 3);
  EXPECT_EQ(sk_governor_timed_level(&p, 0, 0, 760'000), 7);
  EXPECT_EQ(sk_governor_timed_level(&p, 0, 0, 1'759'999), 23);
  EXPECT_EQ(sk_governor_timed_level(&p, 0, 0, 1'760'000), kLast);
  EXPECT_EQ(sk_governor_timed_level(&p, 0, 3, 1'760'000), 3) << "farther out it takes longer";
  EXPECT_EQ(sk_governor_timed_level(&p, 0, 0, INT64_MAX), kLast);
  EXPECT_EQ(sk_governor_timed_level(&p, SK_JOINTS, 0, INT64_MAX), 0);
}

// verifies: SK-SD-12
TEST_F(GovernorTime, SpeedIsTheLevelsShareAndNoCreeping) {
  p.creep_velocity_urad_s[0] = 60'000;
  EXPECT_EQ(sk_governor_timed_speed(&p, 0, 0), 0) << "denied is denied";
  EXPECT_EQ(sk_governor_timed_speed(&p, 0, 1), 25'000);
  EXPECT_EQ(sk_governor_timed_speed(&p, 0, 8), 200'000);
  EXPECT_EQ(sk_governor_timed_speed(&p, 0, kLast), 700'000);
  EXPECT_EQ(sk_governor_timed_speed(&p, 0, SK_GOVERNOR_LEVELS), 0);
  EXPECT_EQ(sk_governor_timed_speed(&p, 0, -1), 0);
  EXPECT_EQ(sk_governor_timed_speed(&p, -1, 3), 0);
  p.acceleration_max_urad_s2[0] = 0;
  EXPECT_EQ(sk_governor_timed_speed(&p, 0, 8), 0);
}

}  // namespace
}  // namespace berm::core_test
