#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "can/berm_can.h"
#include "core/frame_guard.h"

namespace {

constexpr std::int64_t kNow = 1'000'000;
constexpr std::uint32_t kIds[] = {BERM_CAN_FRONT_ANGLE, BERM_CAN_FRONT_ANGULAR_VELOCITY, BERM_CAN_MACHINE_STATE, BERM_CAN_ESTOP_STATUS,
                                  BERM_CAN_OPERATOR,    BERM_CAN_SPOTTER,                BERM_CAN_HEARTBEAT};

berm_can_frame message(std::uint32_t id) { return {id, 8, {0x10, 0x32, 0x54, 0x76, 0x98, 0xBA, 0xDC, 0xFE}}; }

class FrameGuard : public testing::Test {
 protected:
  void SetUp() override { sk_guard_init(&s, BERM_CAN_FRONT_ANGLE); }
  void arm(std::uint8_t counter, std::int64_t now_us = kNow) {
    const berm_can_frame guard = berm_can_make_guard(&frame, counter);
    sk_guard_arm(&s, guard.data, guard.length, now_us);
  }
  // Offers the message, and checks what a refusal leaves.
  std::int32_t accept(std::int64_t now_us = kNow, std::int32_t length = 8) {
    const sk_guard_state was = s;
    const std::int32_t result = sk_guard_accept(&s, frame.data, length, now_us);
    EXPECT_FALSE(s.armed);
    EXPECT_EQ(s.can_id, was.can_id);
    if (result != SK_FRAME_OK) {
      EXPECT_EQ(s.primed, was.primed);
      EXPECT_EQ(s.last_counter, was.last_counter);
      EXPECT_EQ(s.last_us, was.last_us);
    }
    return result;
  }

  berm_can_frame frame = message(BERM_CAN_FRONT_ANGLE);
  sk_guard_state s{};
};

// The guard frames are those of the interface's own codec.
// verifies: SK-FG-1, SK-FG-3, SK-FG-8
TEST_F(FrameGuard, AcceptsWhatTheCodecGuards) {
  for (const std::uint32_t id : kIds) {
    sk_guard_init(&s, id);
    EXPECT_EQ(s.last_us, -1);
    EXPECT_FALSE(s.primed);
    frame = message(id);
    for (int counter = 250; counter < 600; ++counter) {
      arm(static_cast<std::uint8_t>(counter), kNow + counter);
      ASSERT_EQ(accept(kNow + counter), SK_FRAME_OK) << std::hex << id << " counter " << counter;
      EXPECT_EQ(s.last_counter, static_cast<std::uint8_t>(counter));
      EXPECT_EQ(s.last_us, kNow + counter);
    }
  }
}

// verifies: SK-FG-2, SK-FG-7
TEST_F(FrameGuard, AGuardServesOnce) {
  EXPECT_EQ(accept(), SK_FRAME_UNGUARDED);
  arm(1);
  EXPECT_EQ(accept(), SK_FRAME_OK);
  EXPECT_EQ(accept(), SK_FRAME_UNGUARDED);
  arm(2);
  frame.data[3] ^= 1;
  EXPECT_EQ(accept(), SK_FRAME_CRC);
  frame.data[3] ^= 1;
  EXPECT_EQ(accept(), SK_FRAME_UNGUARDED);
}

// verifies: SK-FG-6, SK-FG-7
TEST_F(FrameGuard, MessageLength) {
  for (const std::int32_t length : {std::numeric_limits<std::int32_t>::min(), -1, 0, 7, 9, 64}) {
    arm(1);
    EXPECT_EQ(accept(kNow, length), SK_FRAME_LENGTH) << length;
    EXPECT_EQ(accept(), SK_FRAME_UNGUARDED);
  }
}

// verifies: SK-FG-1
TEST_F(FrameGuard, ABadGuardFrameDisarms) {
  const berm_can_frame guard = berm_can_make_guard(&frame, 1);
  const auto arms = [&](berm_can_frame g, std::int64_t now_us) {
    arm(1);
    EXPECT_TRUE(s.armed);
    sk_guard_arm(&s, g.data, g.length, now_us);
    return s.armed;
  };
  EXPECT_TRUE(arms(guard, 0));
  EXPECT_FALSE(arms(guard, -1));
  for (const std::uint8_t length : {std::uint8_t{0}, std::uint8_t{7}, std::uint8_t{9}}) {
    berm_can_frame g = guard;
    g.length = length;
    EXPECT_FALSE(arms(g, kNow)) << int{length};
  }
  for (const int byte : {0, 2, 3}) {
    for (int bit = 0; bit < 8; ++bit) {
      berm_can_frame g = guard;
      g.data[byte] = static_cast<std::uint8_t>(g.data[byte] ^ 1u << bit);
      EXPECT_FALSE(arms(g, kNow)) << "byte " << byte << " bit " << bit;
    }
  }
}

// verifies: SK-FG-5
TEST_F(FrameGuard, PairTime) {
  const auto after = [&](std::int64_t armed_us, std::int64_t now_us) {
    sk_guard_init(&s, frame.id);
    arm(1, armed_us);
    return accept(now_us);
  };
  EXPECT_EQ(after(kNow, kNow), SK_FRAME_OK);
  EXPECT_EQ(after(kNow, kNow + SK_GUARD_PAIR_US), SK_FRAME_OK);
  EXPECT_EQ(after(kNow, kNow + SK_GUARD_PAIR_US + 1), SK_FRAME_LATE);
  EXPECT_EQ(after(kNow, kNow - 1), SK_FRAME_LATE);
  EXPECT_EQ(after(0, std::numeric_limits<std::int64_t>::max()), SK_FRAME_LATE);
  EXPECT_EQ(after(kNow, std::numeric_limits<std::int64_t>::min()), SK_FRAME_LATE);
  arm(1);
  s.guard_us = std::numeric_limits<std::int64_t>::min();  // a corrupted state
  EXPECT_EQ(accept(std::numeric_limits<std::int64_t>::max()), SK_FRAME_LATE);
}

// verifies: SK-FG-10
TEST_F(FrameGuard, TheFirstThatFailsIsReturned) {
  arm(1);
  ASSERT_EQ(accept(), SK_FRAME_OK);
  arm(9);
  EXPECT_EQ(accept(kNow), SK_FRAME_COUNTER);
  arm(9);
  frame.data[0] ^= 1;
  EXPECT_EQ(accept(kNow), SK_FRAME_CRC);
  arm(9);
  frame.data[0] ^= 2;
  EXPECT_EQ(accept(kNow - 1), SK_FRAME_LATE);
  EXPECT_EQ(accept(kNow - 1), SK_FRAME_UNGUARDED);
  EXPECT_EQ(accept(kNow - 1, 5), SK_FRAME_LENGTH);
}

// verifies: SK-FG-9
TEST_F(FrameGuard, Freshness) {
  EXPECT_FALSE(sk_guard_fresh(&s, 0, 1'000'000));
  EXPECT_FALSE(sk_guard_fresh(&s, -1, 1'000'000));
  arm(1);
  ASSERT_EQ(accept(), SK_FRAME_OK);
  EXPECT_TRUE(sk_guard_fresh(&s, kNow, 0));
  EXPECT_TRUE(sk_guard_fresh(&s, kNow + 50'000, 50'000));
  EXPECT_FALSE(sk_guard_fresh(&s, kNow + 50'001, 50'000));
  EXPECT_FALSE(sk_guard_fresh(&s, kNow - 1, 50'000));
  EXPECT_FALSE(sk_guard_fresh(&s, kNow, -1));
  EXPECT_FALSE(sk_guard_fresh(&s, std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int32_t>::max()));
}

}  // namespace
