// The kernel's cycle when the base moves: stop, void map, reset, map learned anew.
#include <gtest/gtest.h>

#include "cycle_rig.hpp"

namespace berm::kernel::test {
namespace {

constexpr int kStartLimit = 400;
constexpr std::int32_t kOneDegree = 17453;

class CycleBase : public ::testing::Test {
 protected:
  void run() { ASSERT_TRUE(rig.reach_state(BERM_STATE_RUN, kStartLimit)) << "reason " << int(rig.state().stop_reason); }
  // Cells seen that are not the machine's own.
  int seen_cells() const {
    int seen = 0;
    const std::int64_t far = own_and_rim_radius_mm(rig.parameters);
    for (std::int64_t iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (std::int64_t ix = 0; ix < SK_MAP_CELLS; ++ix) {
        const std::int64_t x = SK_MAP_ORIGIN_MM + ix * SK_CELL_MM + SK_CELL_MM / 2, y = SK_MAP_ORIGIN_MM + iy * SK_CELL_MM + SK_CELL_MM / 2;
        if (x * x + y * y > far * far && rig.cycle->map().seen_us[iy][ix] >= 0) ++seen;
      }
    return seen;
  }
  void press_reset() {
    rig.machine.reset_key = true;
    rig.steps(20);
    rig.machine.reset_key = false;
    rig.steps(10);
  }
  CycleRig rig;
};

// verifies: SK-BM-10, SK-BM-11, SK-BM-12, IF-CAN-9 (inclination stops, and permits nothing by going back)
TEST_F(CycleBase, ATiltStopsVoidsTheMapAndTheResetLearnsItAnew) {
  run();
  rig.wanted_urad_s[1] = 50000;
  rig.steps(20);
  ASSERT_GT(rig.state().commanded_urad_s[1], 0);
  ASSERT_GT(seen_cells(), 100);
  rig.machine.pitch_urad = kOneDegree;
  int cycles = 0;
  while (rig.state().stop_reason != BERM_STOP_BASE_MOVED && cycles < 100) rig.step(), ++cycles;
  EXPECT_LE(cycles, 2 * SK_BASE_TILT_FRAMES + 1);
  EXPECT_EQ(rig.state().commanded_urad_s[1], 0);
  EXPECT_EQ(rig.state().stop_category, 1);
  EXPECT_EQ(seen_cells(), 0);
  rig.machine.pitch_urad = 0;  // tilting back changes nothing
  rig.steps(200);
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_STOPPED);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_BASE_MOVED);
  EXPECT_EQ(seen_cells(), 0) << "nothing is learned while the base has moved";
  EXPECT_EQ(rig.state().stop_count[BERM_STOP_BASE_MOVED], 1U);
  rig.machine.pitch_urad = kOneDegree;
  rig.wanted_urad_s[1] = 0;
  press_reset();
  EXPECT_NE(rig.state().stop_reason, BERM_STOP_BASE_MOVED);
  ASSERT_TRUE(rig.reach_state(BERM_STATE_RUN, kStartLimit));
  EXPECT_GT(seen_cells(), 100);
  rig.steps(200);
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_RUN) << "the tilt is the new reference";
}

// verifies: SK-CY-35
TEST_F(CycleBase, TheOperatorHasTheMapLearnedAnewAtStandstill) {
  run();
  rig.wanted_urad_s[1] = 50000;
  rig.steps(20);
  const int seen = seen_cells();
  ASSERT_GT(seen, 100);
  rig.machine.relearn_key = true;
  rig.steps(20);
  ASSERT_NE(rig.state().joint_velocity_urad_s[1], 0);
  EXPECT_GE(seen_cells(), seen) << "never while it moves";
  rig.wanted_urad_s[1] = 0;
  rig.steps(100);
  EXPECT_EQ(seen_cells(), 0);
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_STOPPED);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_UNKNOWN_GROUND);
  rig.machine.relearn_key = false;
  EXPECT_TRUE(rig.reach_state(BERM_STATE_RUN, kStartLimit));
  EXPECT_GT(seen_cells(), 100);
}

// Stopped for one thing, kept by another: the ground has been forgotten while the app was silent.
// verifies: SK-CY-18
TEST_F(CycleBase, AHeldMachineShowsWhatHoldsItNow) {
  run();
  rig.wanted_urad_s[1] = 50000;
  rig.steps(20);
  rig.app_talks = false;
  rig.wanted_urad_s[1] = 0;
  rig.machine.relearn_key = true;
  rig.steps(30);
  ASSERT_EQ(rig.state().kernel_state, BERM_STATE_STOPPED);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_REQUEST_HOLD);
  rig.app_talks = true;
  rig.steps(10);
  ASSERT_EQ(seen_cells(), 0);
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_STOPPED);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_UNKNOWN_GROUND);
  EXPECT_EQ(rig.machine.heartbeat().stop_reason, BERM_STOP_UNKNOWN_GROUND) << "what the operator's panel shows";
  EXPECT_EQ(rig.state().stop_count[BERM_STOP_REQUEST_HOLD], 1U);
  EXPECT_EQ(rig.state().stop_count[BERM_STOP_UNKNOWN_GROUND], 0U) << "one stop";
  rig.machine.relearn_key = false;
  EXPECT_TRUE(rig.reach_state(BERM_STATE_RUN, kStartLimit));
}

// verifies: SK-BM-10, IF-CAN-9 (the tracks' azimuth stops)
TEST_F(CycleBase, TurningTracksStopTheMachine) {
  run();
  rig.machine.track_urad = kOneDegree;
  rig.steps(10 * SK_BASE_TURN_FRAMES + 1);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_BASE_MOVED);
}

// verifies: SK-BM-12
TEST_F(CycleBase, AKeyHeldDownFromBeforeResetsNothing) {
  run();
  rig.machine.reset_key = true;
  rig.steps(10);
  rig.machine.roll_urad = 2 * kOneDegree;
  rig.steps(200);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_BASE_MOVED);
  EXPECT_EQ(seen_cells(), 0);
}

// verifies: SK-BM-13
TEST_F(CycleBase, MissingFramesAreAFaultAndATiltMeanwhileIsFoundOnTheirReturn) {
  run();
  rig.machine.attitude_silent = true;
  rig.steps(rig.parameters.base_frame_age_us / rig.parameters.cycle_us + 3);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_STATE_FRAME);
  rig.machine.roll_urad = kOneDegree;
  rig.machine.attitude_silent = false;
  rig.steps(2 * SK_BASE_TILT_FRAMES + 30);
  EXPECT_EQ(seen_cells(), 0) << "the map is void though the fault's reason is kept";
  rig.machine.roll_urad = 0;
  press_reset();
  EXPECT_TRUE(rig.reach_state(BERM_STATE_RUN, kStartLimit));
}

// verifies: SK-BM-13
TEST_F(CycleBase, WithoutTheseFramesTheKernelDoesNotLeaveInit) {
  rig.machine.azimuth_silent = true;
  rig.steps(200);
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_INIT);
}

// verifies: SK-BM-14
TEST_F(CycleBase, ABaseThatMovesBeforeTheFirstRunIsLearnedAnewAtStandstill) {
  rig.machine.operator_silent = true;
  rig.steps(50);
  ASSERT_EQ(rig.state().kernel_state, BERM_STATE_INIT);
  rig.machine.roll_urad = 2 * kOneDegree;
  rig.steps(10);
  rig.machine.operator_silent = false;
  EXPECT_TRUE(rig.reach_state(BERM_STATE_RUN, kStartLimit));
}

// verifies: SK-BM-20, SK-BM-24, SK-BM-25
TEST_F(CycleBase, ASlipThatNoFrameShowsIsFoundByTheTerrainAndTheResetLearnsItAnew) {
  rig.machine.relief_m = 0.06;
  run();
  for (int i = 0; i < 6000 && rig.state().terrain_confirmed_ms == UINT32_MAX; ++i) rig.step();
  ASSERT_NE(rig.state().terrain_confirmed_ms, UINT32_MAX) << "the relief is never told from its shifts";
  rig.steps(200);
  EXPECT_LT(rig.state().terrain_confirmed_ms, 1000U);
  ASSERT_EQ(rig.state().kernel_state, BERM_STATE_RUN);
  rig.machine.base_x_m = 0.3;
  rig.machine.base_y_m = -0.2;
  int cycles = 0;
  while (rig.state().stop_reason != BERM_STOP_BASE_MOVED && cycles < 1000) rig.step(), ++cycles;
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_BASE_MOVED);
  EXPECT_EQ(rig.state().stop_category, 1);
  EXPECT_EQ(seen_cells(), 0);
  rig.steps(200);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_BASE_MOVED);
  EXPECT_EQ(seen_cells(), 0);
  EXPECT_EQ(rig.state().terrain_confirmed_ms, UINT32_MAX);
  press_reset();
  ASSERT_TRUE(rig.reach_state(BERM_STATE_RUN, kStartLimit));
  rig.steps(2000);
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_RUN) << "the new place is the reference";
  EXPECT_EQ(rig.state().stop_count[BERM_STOP_BASE_MOVED], 1U);
}

// verifies: SK-BM-25
TEST_F(CycleBase, OverLevelGroundWithoutReliefTheKernelSaysThatItSeesNoSlip) {
  run();
  rig.steps(3000);
  EXPECT_EQ(rig.state().terrain_confirmed_ms, UINT32_MAX);
  rig.machine.base_x_m = 0.5;
  rig.steps(1000);
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_RUN);
}

}  // namespace
}  // namespace berm::kernel::test
