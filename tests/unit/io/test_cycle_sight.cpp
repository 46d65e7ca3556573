// Blocked windows and dust in the kernel's cycle: stops, what is slowed, what is published, what the operator must do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "cycle_rig.hpp"

namespace berm::kernel::test {
namespace {

class CycleSight : public testing::Test {
 protected:
  void SetUp() override {
    rig.face_a_swing_to_the_left();
    ASSERT_TRUE(rig.reach_state(BERM_STATE_RUN, 4000));
    rig.steps(1500);
    ASSERT_EQ(rig.state().kernel_state, BERM_STATE_RUN) << int{rig.state().stop_reason};
  }
  // A cycle, every sample of the left scanner from this mirror's angle on (degrees) covered, and the share of dust in all that come back.
  void step(double covered_from = 360.0, double covered_to = 360.0, int dust_percent = 0) {
    rig.gather();
    for (int i = 0; i < rig.in->packet_count; ++i) {
      berm_scan_packet& p = rig.in->packet[i];
      for (int s = 0; s < p.count; ++s) {
        const double mirror = 360.0 * (p.first_index + s) / p.samples_per_revolution;
        if (p.scanner == 0 && mirror >= covered_from && mirror < covered_to) {
          p.range[s][0] = 75;
        } else if (p.range[s][0] * BERM_SCAN_RANGE_LSB_MM > 2000 && draw() < dust_percent) {
          p.range[s][1] = p.range[s][0];
          p.range[s][0] = 300;
          p.echoes_per_sample = 2;
        }
      }
    }
    rig.cycle->step(*rig.in, *rig.out);
    rig.obey();
  }

  int draw() { return static_cast<int>(random_() % 100); }
  std::int32_t share(int j) const {
    return static_cast<std::int32_t>(std::int64_t{rig.parameters.velocity_max_urad_s[j]} * rig.parameters.dust_speed_permille / 1000);
  }

  CycleRig rig;
  std::mt19937 random_{1};
};

// verifies: SK-SI-11, SK-SI-14
TEST_F(CycleSight, AStripOfAWindowThatIsCoveredLatchesUntilItIsCleanAndReset) {
  int cycles = 0;
  while (rig.state().kernel_state == BERM_STATE_RUN && cycles < 100) {
    step(300.0, 330.0);
    ++cycles;
  }
  EXPECT_LE(cycles, 25) << "within a quarter of a second";
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_STOPPING);
  EXPECT_EQ(rig.state().stop_category, 1);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_SENSOR_BLOCKED);
  EXPECT_EQ(rig.state().stop_count[BERM_STOP_SENSOR_BLOCKED], 1U);
  EXPECT_EQ(rig.state().sight & 0x3FU, BERM_SIGHT_BLOCKED(0));
  rig.machine.reset_key = true;
  for (int k = 0; k < 100; ++k) step(300.0, 330.0);
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_FAULT) << "the reset does not help while it is covered";
  rig.machine.reset_key = false;
  for (int k = 0; k < 300; ++k) step();
  EXPECT_EQ(rig.state().sight & 0x3FU, 0U);
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_FAULT) << "nor does the clean window, without it";
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_SENSOR_BLOCKED);
  rig.machine.reset_key = true;
  EXPECT_TRUE(rig.reach_state(BERM_STATE_RUN, 100)) << int{rig.state().stop_reason};
}

// verifies: SK-SI-16
TEST_F(CycleSight, RelearningJudgesEveryStripAnewAndFindsWhatIsStillCovered) {
  for (int k = 0; k < 100; ++k) step(300.0, 330.0);
  ASSERT_EQ(rig.state().stop_reason, BERM_STOP_SENSOR_BLOCKED);
  rig.machine.relearn_key = true;
  for (int k = 0; k < 10; ++k) step(300.0, 330.0);
  EXPECT_EQ(rig.state().sight, 0U);
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_FAULT) << "the latch is the reset's";
  rig.machine.relearn_key = false;
  for (int k = 0; k < 25; ++k) step(300.0, 330.0);
  EXPECT_EQ(rig.state().sight, BERM_SIGHT_BLOCKED(0));
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_SENSOR_BLOCKED);
}

// verifies: SK-SI-12, SK-SI-14
TEST_F(CycleSight, LightDustSlowsEveryJointToItsShare) {
  rig.wanted_urad_s[0] = 800'000;
  rig.wanted_urad_s[3] = -1'000'000;
  std::int32_t free_urad_s = 0;
  for (int k = 0; k < 20; ++k) {
    step();
    free_urad_s = std::max(free_urad_s, std::abs(rig.state().commanded_urad_s[3]));
  }
  EXPECT_EQ(free_urad_s, 1'000'000);
  rig.wanted_urad_s[3] = 1'000'000;
  for (int k = 0; k < 20; ++k) step();
  for (int k = 0; k < 60; ++k) {
    rig.wanted_urad_s[3] = k % 20 < 10 ? -1'000'000 : 1'000'000;
    rig.wanted_urad_s[0] = 0;
    step(360.0, 360.0, 18);
  }
  ASSERT_EQ(rig.state().kernel_state, BERM_STATE_RUN) << int{rig.state().stop_reason};
  EXPECT_EQ(rig.state().sight, BERM_SIGHT_DUST_SLOW);
  EXPECT_NEAR(rig.state().dust_permille, 180, 60);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_NONE);
  EXPECT_NEAR(std::abs(rig.state().commanded_urad_s[3]), share(3) - 250, 250) << "in the bus's steps of 500";
  EXPECT_NEAR(std::max(rig.state().permitted_high_urad_s[3], -rig.state().permitted_low_urad_s[3]), share(3) - 250, 250);
  rig.wanted_urad_s[3] = 0;
  for (int j = 1; j < 3; ++j) {
    std::fill(rig.wanted_urad_s, rig.wanted_urad_s + 4, 0);
    rig.wanted_urad_s[j] = rig.parameters.velocity_max_urad_s[j] / 2;
    step(360.0, 360.0, 18);
    EXPECT_LE(rig.state().commanded_urad_s[j], share(j)) << j;
  }
  // And goes on at full speed the dwell after it has settled.
  std::fill(rig.wanted_urad_s, rig.wanted_urad_s + 4, 0);
  int cycles = 0;
  while (rig.state().sight != 0 && cycles < 1000) {
    step();
    ++cycles;
  }
  EXPECT_NEAR(cycles, rig.parameters.dust_dwell_us / 10'000, 40);
}

// verifies: SK-SI-13, SK-SI-14
TEST_F(CycleSight, ThickDustHoldsTheMachineUntilItHasSettledForTheDwell) {
  rig.wanted_urad_s[3] = 200'000;
  for (int k = 0; k < 40; ++k) step(360.0, 360.0, 60);
  EXPECT_NE(rig.state().kernel_state, BERM_STATE_RUN);
  EXPECT_NE(rig.state().kernel_state, BERM_STATE_FAULT);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_DUST);
  EXPECT_EQ(rig.state().stop_category, 2);
  EXPECT_EQ(rig.state().stop_count[BERM_STOP_DUST], 1U);
  EXPECT_EQ(rig.state().sight, BERM_SIGHT_DUST_STOP);
  for (const std::int32_t sent : rig.state().commanded_urad_s) EXPECT_EQ(sent, 0);
  int cycles = 0;
  while (rig.state().kernel_state != BERM_STATE_RUN && cycles < 1000) {
    step();
    ++cycles;
  }
  EXPECT_NEAR(cycles, (rig.parameters.dust_dwell_us + SK_RESUME_QUIET_US) / 10'000, 40) << "by itself";
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_NONE);
}

// verifies: SK-SI-12
TEST_F(CycleSight, WithoutDustNothingIsCut) {
  rig.wanted_urad_s[3] = rig.parameters.velocity_max_urad_s[3] / 2;
  step();
  EXPECT_NEAR(rig.state().commanded_urad_s[3], rig.wanted_urad_s[3] - 250, 250);
  EXPECT_EQ(rig.state().sight, 0U);
}

}  // namespace
}  // namespace berm::kernel::test
