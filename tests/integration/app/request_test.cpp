// What the app writes is never refused for its form.
#include <gtest/gtest.h>

#include <cmath>

#include "app/observation.hpp"
#include "app_bench/bench_machine.hpp"
#include "scan/scan_packet.h"

namespace {

using namespace berm::app;

TEST(Request, CutsEveryValueToItsLimit) {
  const MachineModel m = berm::app_bench::zx200();
  Answer answer;
  answer.velocity = {99.0, -99.0, 99.0, -99.0};
  answer.pan = {{{99.0, 99.0}, {-99.0, -1.0}}};
  answer.phase = BERM_PHASE_DUMP;
  answer.horn = true;
  const berm_request r = make_request(m, answer, 7, 123456);
  for (std::size_t j = 0; j < joints; ++j) EXPECT_LE(std::abs(r.joint_velocity_urad_s[j]), static_cast<std::int32_t>(m.joint[j].velocity_max * 1e6));
  EXPECT_LE(r.pan_goal_urad[0], m.scanner[0].pan_high * 1e6);
  EXPECT_GE(r.pan_goal_urad[1], m.scanner[1].pan_low * 1e6);
  EXPECT_EQ(r.pan_rate_urad_s[1], 0);
  EXPECT_EQ(r.flags, BERM_REQUEST_FLAG_HORN);
  EXPECT_EQ(r.sequence, 7u);
  EXPECT_EQ(r.stamp_us, 123456);
  EXPECT_EQ(r.reserved_tail, 0u);
  EXPECT_EQ(r.crc32, berm_crc32(reinterpret_cast<const std::uint8_t*>(&r), offsetof(berm_request, crc32)));
}

TEST(Request, ObservationIsInRadians) {
  berm_state state{};
  state.joint_angle_urad[0] = 1500000;
  state.joint_velocity_urad_s[3] = -250000;
  state.time_us = 2500000;
  state.payload_kg = -1;
  state.panel = BERM_PANEL_TRUCK_PARKED;
  state.kernel_state = BERM_STATE_RUN;
  const Observation o = observe(state);
  EXPECT_DOUBLE_EQ(o.angle[swing], 1.5);
  EXPECT_DOUBLE_EQ(o.velocity[bucket], -0.25);
  EXPECT_DOUBLE_EQ(o.time_s, 2.5);
  EXPECT_LT(o.payload_kg, 0.0);
  EXPECT_TRUE(o.truck_parked);
  EXPECT_TRUE(o.running());
  EXPECT_FALSE(o.release_awaited);
  state.panel = BERM_PANEL_RELEASE_AWAITED;
  EXPECT_TRUE(observe(state).release_awaited);
}

TEST(Request, ACellThatTheTailMeetsLiesBehindTheArm) {
  berm_state state{};
  state.blocked_x_mm = -3000;
  state.blocked_y_mm = -3000;
  state.blocked_link = BERM_STICK;
  EXPECT_NEAR(observe(state).blocked_bearing, radians(-135.0), 1e-12);
  state.blocked_link = BERM_SWING;
  EXPECT_NEAR(observe(state).blocked_bearing, radians(45.0), 1e-12);
}

TEST(Request, ObservationKnowsWhatWaitsForTheOperator) {
  berm_state state{};
  const auto latched = [&state](std::uint8_t kernel_state, std::uint8_t category) {
    state.kernel_state = kernel_state;
    state.stop_category = category;
    return observe(state).latched;
  };
  EXPECT_TRUE(latched(BERM_STATE_FAULT, 1));
  EXPECT_TRUE(latched(BERM_STATE_STOPPED, 0));
  EXPECT_TRUE(latched(BERM_STATE_STOPPED, 1));
  EXPECT_FALSE(latched(BERM_STATE_STOPPED, 2)) << "merely held";
  EXPECT_FALSE(latched(BERM_STATE_STOPPING, 1)) << "not yet: it may only have been paused";
  EXPECT_FALSE(latched(BERM_STATE_RUN, 255));
}

TEST(Request, ObservationKnowsWhatWasLetOutAndWhatIsPermitted) {
  berm_state state{};
  state.kernel_state = BERM_STATE_RUN;
  state.commanded_urad_s[swing] = -150000;
  state.permitted_low_urad_s[swing] = -150000;
  state.permitted_low_urad_s[boom] = -450000;
  state.permitted_high_urad_s[boom] = 450000;
  const Observation o = observe(state);
  EXPECT_DOUBLE_EQ(o.commanded[swing], -0.15);
  EXPECT_DOUBLE_EQ(o.permitted_low[swing], -0.15);
  EXPECT_EQ(o.permitted_high[swing], 0.0);
  EXPECT_DOUBLE_EQ(o.permitted_low[boom], -0.45);
  EXPECT_DOUBLE_EQ(o.permitted_high[boom], 0.45);
  // What the map would permit is not permitted while the kernel does not run.
  for (const std::uint8_t other : {BERM_STATE_INIT, BERM_STATE_STANDBY, BERM_STATE_STOPPING, BERM_STATE_STOPPED, BERM_STATE_FAULT}) {
    state.kernel_state = other;
    EXPECT_EQ(observe(state).permitted_low[boom], 0.0);
    EXPECT_EQ(observe(state).permitted_high[boom], 0.0);
  }
}

}  // namespace
