// What is too high to be passed over, in the whole cycle: nothing goes over it, not even creeping, but for an admitted truck in its zone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "cycle_rig.hpp"

namespace berm::kernel::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kWallY = 6.4;

// A step in the ground, 1.5 m high, before a machine that swings towards it with the bucket 2.7 m high: with the margin there is room above it.
class CycleOverpass : public testing::Test {
 protected:
  void begin() {
    rig = std::make_unique<CycleRig>(parameters);
    rig->face_a_swing_to_the_left();
    rig->machine.wall = {kWallY, 1.5};
    rig->machine.spotter_present = spotter;
    ASSERT_TRUE(rig->reach_state(BERM_STATE_RUN, 1500)) << "reason " << int(rig->state().stop_reason) << " at " << rig->state().blocked_x_mm << ", " << rig->state().blocked_y_mm << " height " << rig->state().blocked_height_mm;
    rig->steps(1000);
  }
  void swing(int cycles) {
    rig->wanted_urad_s[0] = 300000;
    rig->steps(cycles);
  }
  // How far to the left the bucket's tip is (6.3 m out at least in this pose).
  double tip_y() const { return 6.3 * std::sin(std::min(rig->machine.angle_rad[0], kPi / 2)); }

  berm_parameters parameters = berm::test::demo_parameters();
  bool spotter = false;
  std::unique_ptr<CycleRig> rig;
};

// verifies: SK-CY-36
TEST_F(CycleOverpass, WithoutALimitTheStepIsPassedOver) {
  parameters.pass_over_mm = SK_HEIGHT_MAX_MM;
  begin();
  swing(1500);
  EXPECT_GT(rig->machine.angle_rad[0], 1.5) << "reason " << int(rig->state().stop_reason);
}

// verifies: SK-CY-36, SK-CY-22
TEST_F(CycleOverpass, NothingGoesOverTheStepNotEvenCreeping) {
  begin();
  swing(1500);
  EXPECT_EQ(rig->state().stop_reason, BERM_STOP_OVERPASS);
  EXPECT_GE(rig->state().stop_count[BERM_STOP_OVERPASS], 1U);
  EXPECT_LT(tip_y(), kWallY);
  EXPECT_GT(rig->state().blocked_height_mm, parameters.pass_over_mm);
  EXPECT_GT(rig->state().blocked_y_mm, 6000);
  const double held = rig->machine.angle_rad[0];
  rig->wanted_urad_s[0] = -300000;  // away from it
  rig->steps(200);
  EXPECT_LT(rig->machine.angle_rad[0], held - 0.2) << "reason " << int(rig->state().stop_reason);
  rig->wanted_urad_s[0] = 20000;  // and back, below the creep speed
  rig->steps(4000);
  EXPECT_GT(rig->machine.angle_rad[0], held - 0.1);
  EXPECT_LT(tip_y(), kWallY);
  EXPECT_EQ(rig->state().stop_reason, BERM_STOP_OVERPASS);
}

// verifies: SK-CY-27
TEST_F(CycleOverpass, UntilItGoesOnItSaysWhereItWasStopped) {
  begin();
  for (int cycle = 0; cycle < 1500 && rig->state().kernel_state != BERM_STATE_STOPPED; ++cycle) swing(1);
  ASSERT_EQ(rig->state().kernel_state, BERM_STATE_STOPPED);
  rig->wanted_urad_s[0] = -300000;  // away from it
  int waited = 0;
  for (; rig->state().kernel_state == BERM_STATE_STOPPED && waited < 100; ++waited) {
    EXPECT_EQ(rig->state().stop_reason, BERM_STOP_OVERPASS) << waited;
    EXPECT_GT(rig->state().blocked_height_mm, parameters.pass_over_mm) << waited;
    EXPECT_GT(rig->state().blocked_y_mm, 6000) << waited;
    rig->steps(1);
  }
  EXPECT_EQ(rig->state().kernel_state, BERM_STATE_RUN);
  EXPECT_GE(waited, 1);
  EXPECT_EQ(rig->state().stop_reason, BERM_STOP_NONE);
  EXPECT_EQ(rig->state().blocked_height_mm, 0);
}

// verifies: SK-CY-2, SK-CY-27
TEST_F(CycleOverpass, WhatStandsByForItSaysSo) {
  begin();
  swing(1500);
  ASSERT_EQ(rig->state().stop_reason, BERM_STOP_OVERPASS);
  rig->machine.run_switch = false;
  rig->steps(5);
  ASSERT_EQ(rig->state().kernel_state, BERM_STATE_STANDBY);
  ASSERT_EQ(rig->state().stop_reason, BERM_STOP_OVERPASS);
  rig->machine.run_switch = true;
  rig->wanted_urad_s[0] = -300000;  // away from it
  int waited = 0;
  for (rig->steps(1); rig->state().kernel_state == BERM_STATE_STANDBY && waited < 100; ++waited) {
    EXPECT_EQ(rig->state().stop_reason, BERM_STOP_OVERPASS) << waited;
    EXPECT_GT(rig->state().blocked_height_mm, parameters.pass_over_mm) << waited;
    EXPECT_GT(rig->state().blocked_y_mm, 6000) << waited;
    rig->steps(1);
  }
  EXPECT_EQ(rig->state().kernel_state, BERM_STATE_RUN);
  EXPECT_GE(waited, SK_RESUME_QUIET_US / 10'000 - 2);
  EXPECT_EQ(rig->state().stop_reason, BERM_STOP_NONE);
  EXPECT_EQ(rig->state().blocked_height_mm, 0);
}

// verifies: SK-CY-36
TEST_F(CycleOverpass, AnAdmittedTruckInItsZoneIsPassedOverAndNoOther) {
  parameters.truck_zones = 1;
  parameters.truck_zone[0] = {-15000, 5000, 15000, 15000, 2000};
  begin();
  swing(800);
  EXPECT_EQ(rig->state().stop_reason, BERM_STOP_OVERPASS) << "nobody has admitted it";
  spotter = true;
  begin();
  swing(500);
  EXPECT_GT(rig->machine.angle_rad[0], 1.5) << "reason " << int(rig->state().stop_reason);
  EXPECT_NE(rig->state().panel & BERM_PANEL_TRUCK_PARKED, 0U);
  const double over_it = rig->machine.angle_rad[0];
  rig->machine.truck_leaving = true;  // the bucket over it
  rig->steps(100);
  EXPECT_EQ(rig->state().stop_reason, BERM_STOP_OVERPASS);
  const double stands = rig->machine.angle_rad[0];
  EXPECT_LT(stands - over_it, 0.4);
  for (const std::int32_t speed : {20000, -20000, 300000, -300000}) {
    rig->wanted_urad_s[0] = speed;
    rig->steps(200);
    EXPECT_NEAR(rig->machine.angle_rad[0], stands, 1e-9);
  }
  rig->machine.truck_leaving = false;
  rig->wanted_urad_s[0] = -300000;
  rig->steps(300);
  EXPECT_LT(rig->machine.angle_rad[0], stands - 0.2);
}

// verifies: SK-CY-36
TEST_F(CycleOverpass, WhatIsHigherThanTheZonesCeilingIsNoTruck) {
  parameters.truck_zones = 1;
  parameters.truck_zone[0] = {-15000, 5000, 15000, 15000, 1300};
  spotter = true;
  begin();
  swing(1500);
  EXPECT_EQ(rig->state().stop_reason, BERM_STOP_OVERPASS);
  EXPECT_LT(tip_y(), kWallY);
}

}  // namespace
}  // namespace berm::kernel::test
