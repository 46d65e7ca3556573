// Several frames of one message in one cycle: what stops counts if any of them says so.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "cycle_rig.hpp"

namespace berm::kernel::test {
namespace {

constexpr int kStartLimit = 1500;

berm_can_frame estop_of(bool pressed, bool receiver_ok) {
  const berm_estop m{pressed, receiver_ok, 0};
  return berm_encode_estop(&m);
}

berm_can_frame panel_of(bool stop) {
  const berm_operator m{true, stop, false, false, 0};
  return berm_encode_operator(&m);
}

berm_can_frame spotter_of(bool parked, bool leaving, bool stop) {
  const berm_spotter m{parked, leaving, stop, 0};
  return berm_encode_spotter(&m);
}

berm_can_frame machine_of(const berm_machine_state& state) { return berm_encode_machine_state(&state); }

berm_can_frame healthy_machine() {
  berm_machine_state state{};
  state.engine_on = true;
  return machine_of(state);
}

class CycleBatch : public testing::Test {
 protected:
  void run() {
    rig = std::make_unique<CycleRig>();
    rig->machine.spotter_present = true;
    ASSERT_TRUE(rig->reach_state(BERM_STATE_RUN, kStartLimit)) << "reason " << int(rig->state().stop_reason);
  }
  // A cycle in which these come behind the machine's own.
  void step(const std::vector<berm_can_frame>& batch = {}) {
    rig->gather();
    for (const berm_can_frame& frame : batch) {
      rig->machine.add_guarded(frame);
      const auto& sent = rig->machine.frames();
      for (std::size_t k = 2; k > 0; --k) rig->in->frame[rig->in->frame_count++] = sent[sent.size() - k];
    }
    rig->cycle->step(*rig->in, *rig->out);
    rig->obey();
  }
  void expect_stop(const char* what, int reason, const std::vector<berm_can_frame>& batch) {
    run();
    step(batch);
    EXPECT_EQ(rig->state().stop_reason, reason) << what;
    EXPECT_NE(rig->state().kernel_state, BERM_STATE_RUN) << what;
    EXPECT_EQ(rig->state().stop_count[reason], 1U) << what;
    EXPECT_EQ(rig->cycle->frames_rejected(), 0U) << what;
    for (int k = 0; k < 100; ++k) step();
    EXPECT_EQ(rig->state().stop_reason, reason) << what << ": latched";
  }

  std::unique_ptr<CycleRig> rig;
};

// verifies: SK-CY-13, SK-CY-83
TEST_F(CycleBatch, AnEmergencyStopThatIsReleasedInTheSameCycleTakesThePower) {
  expect_stop("pressed, released", BERM_STOP_EMERGENCY, {estop_of(true, true), estop_of(false, true)});
  EXPECT_FALSE(rig->machine.heartbeat().enable);
  expect_stop("between two", BERM_STOP_EMERGENCY, {estop_of(false, true), estop_of(true, true), estop_of(false, true)});
}

// verifies: SK-CY-14, SK-CY-83
TEST_F(CycleBatch, AStopOfOperatorOrSpotterThatIsReleasedInTheSameCycleLatches) {
  expect_stop("operator", BERM_STOP_OPERATOR, {panel_of(true), panel_of(false)});
  expect_stop("spotter", BERM_STOP_OPERATOR, {spotter_of(true, false, true), spotter_of(true, false, false)});
}

// verifies: SK-CY-15, SK-CY-83
TEST_F(CycleBatch, AnErrorThatIsGoneInTheSameCycleIsAFault) {
  berm_machine_state bad[5] = {};
  bad[0].system_error = bad[1].lock_receiver_error = bad[2].estop_receiver_error = bad[3].switch_error = true;
  bad[4].can_errors = 1;
  for (berm_machine_state& state : bad) {
    state.engine_on = true;
    expect_stop("error", BERM_STOP_MACHINE_FAULT, {machine_of(state), healthy_machine()});
  }
  expect_stop("receiver", BERM_STOP_MACHINE_FAULT, {estop_of(false, false), estop_of(false, true)});
}

// verifies: SK-CY-36, SK-CY-83
TEST_F(CycleBatch, ATruckThatIsSaidToLeaveInACycleIsNotAdmittedInIt) {
  constexpr std::uint32_t kTruck = BERM_PANEL_TRUCK_PARKED | BERM_PANEL_TRUCK_LEAVING;
  run();
  step({spotter_of(true, false, false)});
  EXPECT_EQ(rig->state().panel & kTruck, BERM_PANEL_TRUCK_PARKED);
  step({spotter_of(true, true, false), spotter_of(true, false, false)});
  EXPECT_EQ(rig->state().panel & kTruck, kTruck) << "it leaves";
  step({spotter_of(false, false, false), spotter_of(true, false, false)});
  EXPECT_EQ(rig->state().panel & kTruck, 0U) << "none was there";
  step();
  EXPECT_EQ(rig->state().panel & kTruck, BERM_PANEL_TRUCK_PARKED) << "the next cycle begins afresh";
}

// verifies: SK-CY-83
TEST_F(CycleBatch, TheNextCycleBeginsAfreshAndARefusedFrameSaysNothing) {
  run();
  step({estop_of(true, true), panel_of(true), spotter_of(true, false, true), estop_of(false, true), panel_of(false), spotter_of(true, false, false)});
  ASSERT_EQ(rig->state().stop_reason, BERM_STOP_EMERGENCY);
  ASSERT_TRUE(rig->reach_state(BERM_STATE_STOPPED, 300));
  rig->machine.reset_key = true;
  EXPECT_TRUE(rig->reach_state(BERM_STATE_RUN, 300)) << "what was said once is not said for ever: reason " << int(rig->state().stop_reason);
  rig->extra_frames = {estop_of(true, true)};  // without its guard
  step();
  EXPECT_EQ(rig->state().kernel_state, BERM_STATE_RUN);
  EXPECT_EQ(rig->cycle->frames_rejected(), 1U);
}

}  // namespace
}  // namespace berm::kernel::test
