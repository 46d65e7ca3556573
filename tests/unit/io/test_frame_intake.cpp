// Which frames the kernel uses, and which it refuses and counts.
#include <gtest/gtest.h>

#include <cstring>

#include "io/frame_intake.hpp"
#include "mini_machine.hpp"

namespace berm::kernel {
namespace {

constexpr std::int64_t kNow = 1000000;

class FrameIntakeTest : public ::testing::Test {
 protected:
  void guarded(const berm_can_frame& frame, std::uint8_t counter, std::int64_t now_us = kNow) {
    intake.take(berm_can_make_guard(&frame, counter), now_us);
    intake.take(frame, now_us);
  }
  static berm_can_frame angle_frame(std::int32_t urad) {
    const berm_front_angle angle{{urad, urad, urad, urad}};
    return berm_encode_front_angle(&angle);
  }
  berm_parameters parameters = berm::test::demo_parameters();
  FrameIntake intake{parameters};
};

// verifies: SK-CY-80
TEST_F(FrameIntakeTest, AGuardedFrameIsUsed) {
  guarded(angle_frame(400000), 1);
  EXPECT_EQ(intake.picture().angle.angle_urad[2], 400000);
  EXPECT_EQ(intake.angle_us(), kNow);
  EXPECT_EQ(intake.rejected(), 0U);
}

// verifies: SK-CY-80, IF-CAN-13
TEST_F(FrameIntakeTest, UnguardedWrongLengthAndDamagedFramesAreRefusedAndCounted) {
  guarded(angle_frame(400000), 1);
  const auto refused = [&](std::uint64_t count) {
    EXPECT_EQ(intake.rejected(), count);
    EXPECT_EQ(intake.picture().angle.angle_urad[0], 400000);
    EXPECT_EQ(intake.angle_us(), kNow);
  };
  intake.take(angle_frame(800000), kNow + 1);
  refused(1);
  berm_can_frame shorter = angle_frame(800000);
  intake.take(berm_can_make_guard(&shorter, 2), kNow + 1);
  shorter.length = 7;
  intake.take(shorter, kNow + 1);
  refused(2);
  berm_can_frame damaged = angle_frame(800000);
  intake.take(berm_can_make_guard(&damaged, 2), kNow + 1);
  damaged.data[3] ^= 0x10;
  intake.take(damaged, kNow + 1);
  refused(3);
  guarded(angle_frame(800000), 1, kNow + 1);  // replayed counter
  refused(4);
  berm_can_frame guard = berm_can_make_guard(&damaged, 2);
  guard.length = 6;
  intake.take(guard, kNow + 1);
  refused(5);
}

// verifies: SK-CY-80
TEST_F(FrameIntakeTest, AValueOutOfRangeIsNotHeard) {
  guarded(angle_frame(12000000), 1);  // the field holds 16 rad, no joint does
  EXPECT_EQ(intake.rejected(), 1U);
  EXPECT_EQ(intake.angle_us(), -1);
  EXPECT_EQ(intake.picture().angle.angle_urad[0], 0);
}

// verifies: SK-CY-81
TEST_F(FrameIntakeTest, ForeignTrafficPassesUnnoticed) {
  for (std::uint32_t id = 0x18FE0000; id < 0x18FE4000; id += 3) intake.take({id, 8, {1, 2, 3, 4, 5, 6, 7, 8}}, kNow);
  EXPECT_EQ(intake.rejected(), 0U);
  EXPECT_FALSE(intake.state_heard());
}

// verifies: IF-CAN-20 (in what the kernel knows of the machine; that its clock is its own but for --lockstep is in io/receiver)
TEST_F(FrameIntakeTest, ASimulationsClockIsForeignTraffic) {
  guarded(angle_frame(400000), 1);
  for (const std::uint32_t cycle : {0U, 1U, 4000000000U}) {
    const berm_sim_clock clock{cycle, 7};
    intake.take(berm_encode_sim_clock(&clock), kNow + 30000);
  }
  EXPECT_EQ(intake.rejected(), 0U);
  EXPECT_EQ(intake.angle_us(), kNow);
  EXPECT_FALSE(intake.state_heard());
}

// verifies: SK-CY-81, IF-CAN-9 (pressures and payload), IF-CF-21 (the kernel passes the pressures on)
TEST_F(FrameIntakeTest, UntrustedFiguresNeedNoGuard) {
  const berm_payload payload{1234, true};
  intake.take(berm_encode_payload(&payload), kNow);
  EXPECT_EQ(intake.picture().payload_kg, 1234);
  const berm_payload invalid{77, false};
  intake.take(berm_encode_payload(&invalid), kNow);
  EXPECT_EQ(intake.picture().payload_kg, -1);
  berm_pressure pressure{};
  for (int i = 0; i < 8; ++i) pressure.kpa[i] = 12000 + 200 * i;
  intake.take(berm_encode_pressure(&pressure), kNow);
  for (int c = 0; c < BERM_CYLINDERS; ++c)
    for (int side = 0; side < 2; ++side) EXPECT_EQ(intake.picture().cylinder_kpa[c][side], 12000 + 200 * (2 * c + side));
}

// verifies: SK-CY-82
TEST_F(FrameIntakeTest, FreshnessIsThatOfTheOldestOfAGroup) {
  guarded(angle_frame(0), 1);
  const berm_front_velocity velocity{};
  guarded(berm_encode_front_velocity(&velocity), 1, kNow + 20000);
  EXPECT_TRUE(intake.joints_fresh(kNow + 50000));
  EXPECT_FALSE(intake.joints_fresh(kNow + 50001));
}

}  // namespace
}  // namespace berm::kernel
