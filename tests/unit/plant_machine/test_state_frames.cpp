#include <gtest/gtest.h>

#include <map>

#include "machine_file.hpp"
#include "plant/machine/cylinder_pressures.hpp"
#include "plant/machine/guard_receiver.hpp"
#include "plant/machine/state_frames.hpp"

namespace berm::plant::testing {
namespace {

MachineSnapshot snapshot() {
  MachineSnapshot now;
  now.joints = pose(33, 45, -100, -60);
  now.joints.velocity = {0.5, -0.1, 0.2, -0.3};
  now.payload_kg = 1500;
  now.pilot_unlocked = true;
  now.panel.run = true;
  now.truck_parked = true;
  return now;
}

TEST(StateFrames, PeriodsAreThoseOfTheInterface) {
  StateFrames frames(profile(), 1);
  std::map<std::uint32_t, int> count;
  for (std::uint64_t cycle = 1; cycle <= 100; ++cycle) {
    for (const berm_can_frame& f : frames.frames(cycle, snapshot())) ++count[f.id];
  }
  const std::map<std::uint32_t, int> expected{
      {BERM_CAN_FRONT_ANGLE, 100}, {BERM_CAN_FRONT_ANGULAR_VELOCITY, 100}, {BERM_CAN_PRESSURE_1, 100}, {BERM_CAN_ROLL_PITCH, 50},
      {BERM_CAN_MACHINE_STATE, 20}, {BERM_CAN_ESTOP_STATUS, 20}, {BERM_CAN_OPERATOR, 20}, {BERM_CAN_SPOTTER, 20},
      {BERM_CAN_VEHICLE_AZIMUTH, 10}, {BERM_CAN_PAYLOAD, 10},
      {BERM_CAN_GUARD_MACHINE, 240}, {BERM_CAN_GUARD_OPERATOR, 20}, {BERM_CAN_GUARD_SPOTTER, 20}};
  EXPECT_EQ(count, expected);
}

TEST(StateFrames, GuardsAreRightAndConsecutive) {
  StateFrames frames(profile(), 1);
  std::vector<GuardReceiver> receivers;
  for (const std::uint32_t id : {BERM_CAN_FRONT_ANGLE, BERM_CAN_FRONT_ANGULAR_VELOCITY, BERM_CAN_MACHINE_STATE, BERM_CAN_ESTOP_STATUS,
                                 BERM_CAN_OPERATOR, BERM_CAN_SPOTTER}) receivers.emplace_back(id);
  std::vector<int> accepted(receivers.size());
  for (std::uint64_t cycle = 1; cycle <= 1000; ++cycle) {
    for (const berm_can_frame& f : frames.frames(cycle, snapshot())) {
      for (std::size_t i = 0; i < receivers.size(); ++i) accepted[i] += receivers[i].accept(f, 0.01 * static_cast<double>(cycle)) ? 1 : 0;
    }
  }
  EXPECT_EQ(accepted, (std::vector<int>{1000, 1000, 200, 200, 200, 200}));
  for (const GuardReceiver& r : receivers) EXPECT_EQ(r.refused(), 0u);
}

TEST(StateFrames, NoiseAndQuantisationStayWithinTheKernelsErrorBounds) {
  const MachineFile m;
  const MachineSnapshot now = snapshot();
  StateFrames frames(profile(), 9);
  bool noisy = false;
  for (std::uint64_t cycle = 1; cycle <= 20000; ++cycle) {
    for (const berm_can_frame& f : frames.frames(cycle, now)) {
      berm_front_angle angle;
      berm_front_velocity velocity;
      if (berm_decode_front_angle(&f, &angle)) {
        for (std::size_t j = 0; j < 4; ++j) {
          const double error = std::abs(angle.angle_urad[j] * 1e-6 - now.joints.angle[j]);
          ASSERT_LE(error, m.angle_error[j]) << kJoints[j];
          noisy = noisy || error > 0.3 * m.angle_error[j];
        }
      }
      if (berm_decode_front_velocity(&f, &velocity)) {
        for (std::size_t j = 0; j < 4; ++j) ASSERT_LE(std::abs(velocity.velocity_urad_s[j] * 1e-6 - now.joints.velocity[j]), m.velocity_error[j]) << kJoints[j];
      }
    }
  }
  EXPECT_TRUE(noisy);
}

TEST(StateFrames, CarryWhatTheySay) {
  MachineSnapshot now = snapshot();
  now.panel.emergency = true;
  now.truck_leaving = true;
  StateFrames frames(profile(), 2);
  int seen = 0;
  for (const berm_can_frame& f : frames.frames(1, now)) {
    berm_machine_state machine;
    berm_estop estop;
    berm_operator panel;
    berm_spotter spotter;
    berm_payload payload;
    berm_pressure pressure;
    if (berm_decode_machine_state(&f, &machine)) {
      ++seen;
      EXPECT_TRUE(machine.pilot_unlocked && machine.engine_on && !machine.system_error);
    }
    if (berm_decode_estop(&f, &estop)) {
      ++seen;
      EXPECT_TRUE(estop.pressed && estop.receiver_ok);
    }
    if (berm_decode_operator(&f, &panel)) {
      ++seen;
      EXPECT_TRUE(panel.run && !panel.stop && !panel.reset && !panel.relearn);
    }
    if (berm_decode_spotter(&f, &spotter)) {
      ++seen;
      EXPECT_TRUE(spotter.truck_parked && spotter.truck_leaving && !spotter.stop);
    }
    if (berm_decode_payload(&f, &payload)) {
      ++seen;
      EXPECT_NEAR(payload.kg, 1500, 1500 * 0.05 + 25);
      EXPECT_TRUE(payload.valid);
    }
    if (berm_decode_pressure(&f, &pressure)) {
      ++seen;
      const auto sides = cylinder_pressures(profile().dynamics, profile().shape, now.joints, now.payload_kg, now.edge);
      for (std::size_t c = 0; c < sides.size(); ++c) {
        EXPECT_NEAR(pressure.kpa[2 * c], sides[c].bottom_kpa, 100 + 0.0245 * sides[c].bottom_kpa);
        EXPECT_NEAR(pressure.kpa[2 * c + 1], sides[c].rod_kpa, 100 + 0.0245 * sides[c].rod_kpa);
      }
    }
  }
  EXPECT_EQ(seen, 6);
  now.digging = true;
  for (const berm_can_frame& f : frames.frames(11, now)) {
    berm_payload payload;
    if (berm_decode_payload(&f, &payload)) { EXPECT_FALSE(payload.valid); }
  }
}

TEST(StateFrames, AnAngleSticksAndAnErrorIsReportedUntilTheyAreMended) {
  MachineSnapshot now = snapshot();
  StateFrames frames(profile(), 3);
  std::uint64_t cycle = 1;
  const auto says = [&] {
    std::pair<std::int32_t, bool> said{};
    for (const berm_can_frame& f : frames.frames(cycle, now)) {
      berm_front_angle angle;
      berm_machine_state machine;
      if (berm_decode_front_angle(&f, &angle)) said.first = angle.angle_urad[1];
      if (berm_decode_machine_state(&f, &machine)) said.second = machine.system_error;
    }
    cycle += 5;
    now.joints.angle[1] += 0.1;
    return said;
  };
  const auto before = says();
  EXPECT_FALSE(before.second);
  frames.stick_angle(1, true);
  frames.report_error(true);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(says(), std::pair(before.first, true));
  frames.stick_angle(1, false);
  frames.report_error(false);
  const double is = now.joints.angle[1];
  const auto after = says();
  EXPECT_NEAR(after.first * 1e-6, is, MachineFile{}.angle_error[1]);
  EXPECT_FALSE(after.second);
}

}  // namespace
}  // namespace berm::plant::testing
