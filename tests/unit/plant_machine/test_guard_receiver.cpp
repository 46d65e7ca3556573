#include <gtest/gtest.h>

#include "plant/machine/guard_receiver.hpp"

namespace berm::plant::testing {
namespace {

berm_can_frame message(int swing_urad_s) {
  berm_velocity_cmd m{};
  m.velocity_urad_s[0] = swing_urad_s;
  return berm_encode_velocity_cmd(&m);
}

bool offer(GuardReceiver& r, std::uint8_t counter, const berm_can_frame& frame, double t) {
  EXPECT_FALSE(r.accept(berm_can_make_guard(&frame, counter), t));
  return r.accept(frame, t);
}

// verifies: IF-CAN-12 (the simulated machine: the counter)
TEST(GuardReceiver, CounterMustBeOneToThreeAhead) {
  for (int first = 0; first < 256; ++first) {
    for (int ahead = 0; ahead < 256; ++ahead) {
      GuardReceiver r(BERM_CAN_VELOCITY_CMD_1);
      ASSERT_TRUE(offer(r, static_cast<std::uint8_t>(first), message(1000), 0.0));
      ASSERT_EQ(offer(r, static_cast<std::uint8_t>(first + ahead), message(2000), 0.01), ahead >= 1 && ahead <= 3) << first << " + " << ahead;
    }
  }
}

// verifies: IF-CAN-12 (the simulated machine: single bit flips), IF-CAN-13 (that it counts)
TEST(GuardReceiver, EveryBitFlipOfMessageOrGuardIsRefused) {
  const berm_can_frame frame = message(250000), guard = berm_can_make_guard(&frame, 7);
  for (std::size_t bit = 0; bit < 64; ++bit) {
    berm_can_frame bad = frame;
    bad.data[bit / 8] ^= static_cast<std::uint8_t>(1u << (bit % 8));
    GuardReceiver r(BERM_CAN_VELOCITY_CMD_1);
    r.accept(guard, 0.0);
    EXPECT_FALSE(r.accept(bad, 0.0)) << "message bit " << bit;
    EXPECT_EQ(r.refused(), 1u);
    if (bit / 8 == 2 || bit / 8 == 3) continue;  // padding of the guard frame
    berm_can_frame bad_guard = guard;
    bad_guard.data[bit / 8] ^= static_cast<std::uint8_t>(1u << (bit % 8));
    GuardReceiver s(BERM_CAN_VELOCITY_CMD_1);
    s.accept(bad_guard, 0.0);
    EXPECT_FALSE(s.accept(frame, 0.0)) << "guard bit " << bit;
  }
}

// verifies: IF-CAN-12 (the simulated machine: one guard, one message)
TEST(GuardReceiver, MessageWithoutItsGuardIsRefused) {
  GuardReceiver r(BERM_CAN_VELOCITY_CMD_1);
  EXPECT_FALSE(r.accept(message(1000), 0.0));
  ASSERT_TRUE(offer(r, 1, message(1000), 0.01));
  EXPECT_FALSE(r.accept(message(1000), 0.01)) << "the guard is used up";
  const berm_can_frame other{BERM_CAN_HEARTBEAT, 8, {}};
  const berm_can_frame mine = message(1000);
  r.accept(berm_can_make_guard(&mine, 2), 0.02);
  r.accept(berm_can_make_guard(&other, 2), 0.02);  // a guard for another message came between
  EXPECT_FALSE(r.accept(mine, 0.02));
}

// verifies: IF-CAN-21 (the simulated machine: not while it hears the kernel)
TEST(GuardReceiver, ReplayedPairsAreRefusedWhileTheSenderIsHeard) {
  GuardReceiver r(BERM_CAN_VELOCITY_CMD_1);
  for (int k = 0; k < 50; ++k) {
    ASSERT_TRUE(offer(r, static_cast<std::uint8_t>(100 + k), message(k), 0.01 * k));
    for (int old = 0; old < 3; ++old) EXPECT_FALSE(offer(r, static_cast<std::uint8_t>(10 + old), message(99), 0.01 * k));
  }
}

// verifies: IF-CAN-21 (the simulated machine, after a second of silence)
TEST(GuardReceiver, SilentSenderIsTakenUpAgainAfterTwoConsecutiveMessages) {
  GuardReceiver r(BERM_CAN_VELOCITY_CMD_1);
  ASSERT_TRUE(offer(r, 100, message(1), 0.0));
  EXPECT_FALSE(offer(r, 0, message(1), 1.00));
  EXPECT_TRUE(offer(r, 1, message(1), 1.01));
}

}  // namespace
}  // namespace berm::plant::testing
