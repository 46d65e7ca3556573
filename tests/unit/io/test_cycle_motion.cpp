// The kernel's cycle against a miniature machine: what may move, and what stops it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>

#include "cycle_rig.hpp"

namespace berm::kernel::test {
namespace {

constexpr int kStartLimit = 400;
constexpr double kPi = 3.14159265358979323846;

std::int32_t largest(const std::int32_t (&v)[4]) { return std::max(std::max(std::abs(v[0]), std::abs(v[1])), std::max(std::abs(v[2]), std::abs(v[3]))); }

// verifies: SK-CY-20
TEST(CycleMotion, UnknownGroundIsBlocked) {
  CycleRig rig;
  rig.machine.pan_low_rad = 1.2;  // the scanners look elsewhere
  rig.machine.pan_high_rad = 1.6;
  rig.wanted_urad_s[0] = 300000;
  for (int i = 0; i < kStartLimit; ++i) {
    rig.step();
    ASSERT_EQ(largest(rig.state().commanded_urad_s), 0) << "cycle " << i;
  }
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_UNKNOWN_GROUND);
}

// verifies: SK-CY-20
TEST(CycleMotion, AMachineAtFullSwingStopsBeforeTheWall) {
  CycleRig rig;
  rig.face_a_swing_to_the_left();
  rig.machine.wall = {6.6, 5.0};   // swing reaches it at about 90 degrees with the tip
  ASSERT_TRUE(rig.reach_state(BERM_STATE_RUN, 1500));
  rig.steps(1000);  // both sides swept
  rig.wanted_urad_s[0] = 600000;
  double fastest = 0;
  for (int i = 0; i < 1500; ++i) {
    rig.step();
    fastest = std::max(fastest, rig.machine.velocity_rad_s[0]);
  }
  EXPECT_GT(fastest, 0.1) << "it must have swung";
  // No point of the bucket (7.1 m out at most in this pose, 0.6 m to the sides) may come to the wall.
  const double reach_y = 7.1 * std::sin(std::min(rig.machine.angle_rad[0], kPi / 2)) + 0.6 * std::cos(rig.machine.angle_rad[0]);
  EXPECT_LT(reach_y, 6.6);
  EXPECT_EQ(largest(rig.state().commanded_urad_s), 0);
  EXPECT_TRUE(rig.state().stop_reason == BERM_STOP_COLLISION_PREDICTED || rig.state().stop_reason == BERM_STOP_UNKNOWN_GROUND) << int(rig.state().stop_reason);
  EXPECT_GE(rig.state().stop_count[rig.state().stop_reason], 1U);
}

// A thing behind the machine's right side, where no panning scanner looks; then the lidar sees only ground in its cell, and its beam over it ends on the own body.
// verifies: SK-CY-105
TEST(CycleMotion, WhatTheLidarsOwnReturnsHideKeepsItsHeight) {
  for (const bool hidden : {false, true}) {
    CycleRig rig;
    rig.machine.pan_low_rad = 1.2;
    rig.machine.pan_high_rad = 1.6;
    rig.steps(200);
    const sk_point thing{150, -6000, 1500}, ground{150, -6000, 0}, body{100, -2400, 2600};
    const auto sees = [&](const sk_point& p, int cycles) {
      for (int i = 0; i < cycles; ++i) {
        rig.gather();
        rig.in->lidar_head = {0, 0, 3400};
        rig.in->footprint[rig.in->footprint_count++] = {p, p};
        if (hidden) rig.in->footprint[rig.in->footprint_count++] = {body, body};
        rig.cycle->step(*rig.in, *rig.out);
        rig.obey();
      }
    };
    sees(thing, 1);
    sees(ground, static_cast<int>(4 * rig.parameters.generation_us / rig.parameters.cycle_us));
    EXPECT_EQ(sk_map_top(&rig.cycle->map(), sk_map_index(thing.y_mm), sk_map_index(thing.x_mm)), hidden ? thing.z_mm : ground.z_mm);
  }
}

constexpr int kBucket = BERM_BUCKET;
constexpr double kCurled = -135.8 * kPi / 180;  // -136 degrees is the end
constexpr double kMiddle = -40.0 * kPi / 180;

// verifies: SK-CY-22
TEST(CycleMotion, AJointNearItsLimitMovesBackAndNotOut) {
  CycleRig rig;
  rig.machine.angle_rad[kBucket] = kCurled;
  ASSERT_TRUE(rig.reach_state(BERM_STATE_RUN, kStartLimit));
  rig.wanted_urad_s[kBucket] = -200000;
  rig.steps(40);
  EXPECT_EQ(rig.state().commanded_urad_s[kBucket], 0);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_JOINT_RANGE);
  rig.wanted_urad_s[kBucket] = 200000;
  ASSERT_TRUE(rig.reach_state(BERM_STATE_RUN, 60)) << "reason " << int(rig.state().stop_reason);
  EXPECT_GT(rig.state().commanded_urad_s[kBucket], 0);
  // Stays in RUN all the way out of the limit: it does not flicker.
  for (int i = 0; i < 400; ++i) {
    rig.step();
    ASSERT_EQ(rig.state().kernel_state, BERM_STATE_RUN) << "cycle " << i << " reason " << int(rig.state().stop_reason);
  }
  EXPECT_GT(rig.machine.angle_rad[kBucket], kCurled + 0.2);
}

// verifies: SK-CY-23
TEST(CycleMotion, AStillMachineInABlockedPlaceIsNotStoppedUntilItIsAskedToMoveThere) {
  CycleRig rig;
  rig.machine.angle_rad[kBucket] = kCurled;
  ASSERT_TRUE(rig.reach_state(BERM_STATE_RUN, kStartLimit));
  rig.steps(100);
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_RUN);
  EXPECT_EQ(rig.state().stop_count[BERM_STOP_JOINT_RANGE], 0U);
  rig.wanted_urad_s[kBucket] = -200000;
  rig.steps(50);
  EXPECT_EQ(rig.state().kernel_state, BERM_STATE_STOPPED);
  EXPECT_EQ(rig.state().stop_reason, BERM_STOP_JOINT_RANGE);
  EXPECT_EQ(rig.state().stop_category, 2);
  rig.wanted_urad_s[kBucket] = 0;
  EXPECT_TRUE(rig.reach_state(BERM_STATE_RUN, 100));
}

// verifies: SK-CY-26
TEST(CycleMotion, TheSwingIsSlowedForWhatStandsAheadAndNotStopped) {
  CycleRig rig;
  rig.machine.angle_rad[0] = 0.4;
  rig.machine.pan_low_rad = -0.3;
  rig.machine.pan_high_rad = 2.2;
  rig.machine.wall = {6.6, 5.0};
  ASSERT_TRUE(rig.reach_state(BERM_STATE_RUN, 1500));
  rig.steps(1000);
  rig.wanted_urad_s[0] = 600000;
  bool cut = false;
  for (int i = 0; i < 1500 && rig.state().kernel_state == BERM_STATE_RUN; ++i) {
    rig.step();
    const berm_state& state = rig.state();
    if (state.kernel_state != BERM_STATE_RUN) break;
    EXPECT_LE(state.commanded_urad_s[0], state.permitted_high_urad_s[0]);
    EXPECT_GE(state.permitted_high_urad_s[0], 0);
    if (state.commanded_urad_s[0] > 0 && state.commanded_urad_s[0] < 600000) {
      EXPECT_EQ(state.permitted_high_urad_s[0], state.commanded_urad_s[0]);
      cut = true;
    }
  }
  EXPECT_TRUE(cut) << "it must have been slowed before it was stopped";
}

// verifies: SK-CY-24
TEST(CycleMotion, CommandsAreCutToTheStepOfTheBusTowardsZero) {
  EXPECT_EQ(sk_governor_clamp(1499, -100000, 100000), 1000);
  EXPECT_EQ(sk_governor_clamp(-1499, -100000, 100000), -1000);
  EXPECT_EQ(sk_governor_clamp(400, -100000, 100000), 0);
  EXPECT_EQ(sk_governor_clamp(100700, -100700, 100700), 100500);
  EXPECT_EQ(sk_governor_clamp(-900000, -100700, 100700), -100500);
}

// verifies: SK-CY-30
TEST(CycleMotion, EachCycleSendsGuardedFramesWithTheHeartbeatLast) {
  CycleRig rig;
  std::uint8_t velocity_counter = 0;
  int settings = 0;
  for (int i = 0; i < 50; ++i) {
    rig.step();
    const FrameList& f = rig.out->frames;
    ASSERT_GE(f.count, 6);
    EXPECT_EQ(f.frame[0].id, BERM_CAN_GUARD_KERNEL);
    EXPECT_EQ(f.frame[1].id, BERM_CAN_VELOCITY_CMD_1);
    berm_guard guard{};
    ASSERT_TRUE(berm_decode_guard(&f.frame[0], &guard));
    if (i > 0) {
      EXPECT_EQ(guard.counter, static_cast<std::uint8_t>(velocity_counter + 1));
    }
    velocity_counter = guard.counter;
    EXPECT_EQ(guard.crc32, berm_can_guard_crc(f.frame[1].id, guard.counter, f.frame[1].data));
    EXPECT_EQ(f.frame[f.count - 1].id, BERM_CAN_HEARTBEAT);
    EXPECT_EQ(f.frame[f.count - 2].id, BERM_CAN_GUARD_KERNEL);
    berm_heartbeat heartbeat{};
    ASSERT_TRUE(berm_decode_heartbeat(&f.frame[f.count - 1], &heartbeat));
    EXPECT_EQ(heartbeat.cycle, rig.machine.cycle() & 0xFFFFU);
    settings += rig.sent(BERM_CAN_MACHINE_SETTING_CMD) != nullptr ? 1 : 0;
  }
  EXPECT_EQ(settings, 10);
}

// verifies: SK-CY-31
TEST(CycleMotion, PansAreObeyedWhateverTheState) {
  CycleRig rig;
  rig.machine.run_switch = false;
  rig.steps(20);
  const std::int32_t still[4] = {};
  berm_request request = berm::test::make_request(5000, rig.state().time_us, still);
  request.pan_goal_urad[1] = -400000;
  request.pan_rate_urad_s[1] = 100000;
  request.crc32 = berm_crc32(reinterpret_cast<const std::uint8_t*>(&request), offsetof(berm_request, crc32));
  rig.app_talks = false;
  rig.in->app_connections = 2;
  std::memcpy(rig.in->request, &request, sizeof request);
  rig.step();
  ASSERT_EQ(rig.state().request_result, BERM_REQUEST_ACCEPTED);
  berm_pan_cmd pan{};
  ASSERT_TRUE(berm_decode_pan_cmd(rig.sent(BERM_CAN_SCANNER_PAN_CMD), &pan));
  EXPECT_EQ(pan.scanner, 1);
  EXPECT_NEAR(pan.goal_urad, -400000, 400);
  EXPECT_NEAR(pan.rate_urad_s, 100000, 500);
}

// verifies: SK-CY-40
TEST(CycleMotion, SameInputsGiveTheSameBytes) {
  CycleRig a, b;
  for (int i = 0; i < 600; ++i) {
    for (CycleRig* rig : {&a, &b}) {
      rig->wanted_urad_s[0] = i > 300 ? -200000 : 0;
      rig->wanted_urad_s[2] = i > 350 ? 150000 : 0;
      rig->step();
    }
    ASSERT_EQ(std::memcmp(&a.out->state, &b.out->state, sizeof(berm_state)), 0) << "cycle " << i;
    ASSERT_EQ(std::memcmp(&a.out->decision, &b.out->decision, sizeof(berm_decision)), 0) << "cycle " << i;
    ASSERT_EQ(a.out->frames.count, b.out->frames.count);
    for (int f = 0; f < a.out->frames.count; ++f) ASSERT_EQ(std::memcmp(a.out->frames.frame[f].data, b.out->frames.frame[f].data, 8), 0);
  }
  EXPECT_EQ(std::memcmp(&a.cycle->map(), &b.cycle->map(), sizeof(sk_height_map)), 0);
}

// A phase in which the kernel permitted more than in another would be a way to ask for more.
// verifies: IF-CT-12
TEST(CycleMotion, NoPhaseMakesTheKernelPermitMore) {
  for (std::uint16_t phase = 0; phase < BERM_PHASE_COUNT; ++phase) {
    CycleRig waits, other;
    bool moved = false;
    for (int i = 0; i < 600; ++i) {
      for (CycleRig* rig : {&waits, &other}) {
        rig->wanted_urad_s[0] = i > 300 ? -200000 : 0;
        rig->wanted_urad_s[1] = i > 450 ? -150000 : 0;  // towards the ground
        rig->gather();
        berm_request request;
        std::memcpy(&request, rig->in->request, sizeof request);
        request.phase = rig == &other ? phase : std::uint16_t{BERM_PHASE_WAIT};
        request.crc32 = berm_crc32(reinterpret_cast<const std::uint8_t*>(&request), offsetof(berm_request, crc32));
        std::memcpy(rig->in->request, &request, sizeof request);
        rig->cycle->step(*rig->in, *rig->out);
        rig->obey();
      }
      for (int j = 0; j < 4; ++j)
        ASSERT_LE(std::abs(other.state().commanded_urad_s[j]), std::abs(waits.state().commanded_urad_s[j])) << phase << ", cycle " << i;
      moved = moved || largest(waits.state().commanded_urad_s) > 0;
    }
    EXPECT_TRUE(moved);
    EXPECT_EQ(other.state().request_result, BERM_REQUEST_ACCEPTED) << phase;
  }
}

// verifies: SK-CY-41
TEST(CycleMotion, MapOnlyNeverLeavesInitAndSendsNothing) {
  const berm_parameters parameters = berm::test::demo_parameters();
  auto cycle = std::make_unique<Cycle>(parameters, true);
  auto in = std::make_unique<CycleInputs>();
  auto out = std::make_unique<CycleOutputs>();
  for (int k = 1; k <= 20; ++k) {
    in->clear();
    in->cycle = static_cast<std::uint64_t>(k);
    in->now_us = k * 10000;
    in->footprint[in->footprint_count++] = {{1000, -2000, 740}, {1010, -2000, 740}};  // within the own body's circle
    in->footprint[in->footprint_count++] = {{40000, 0, 0}, {40000, 10, 0}};           // out of the map
    cycle->step(*in, *out);
    EXPECT_EQ(out->frames.count, 0);
    EXPECT_EQ(out->state.kernel_state, BERM_STATE_INIT);
    EXPECT_EQ(out->decision.scan_points, 1U);
  }
  EXPECT_EQ(sk_map_top(&cycle->map(), sk_map_index(-2000), sk_map_index(1000)), 740);
}

}  // namespace
}  // namespace berm::kernel::test
