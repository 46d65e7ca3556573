// Every pair of counters; every flip of up to three bits of guard and message.
#include <gtest/gtest.h>

#include "can/berm_can.h"
#include "core/frame_guard.h"

namespace berm::core_test {
namespace {

constexpr std::int64_t kNow = 1'000'000;

berm_can_frame message() { return {BERM_CAN_FRONT_ANGULAR_VELOCITY, 8, {0xA8, 0x61, 0x9C, 0x61, 0xF0, 0x60, 0xA8, 0x61}}; }

sk_guard_state primed(std::uint8_t last) {
  sk_guard_state s{};
  sk_guard_init(&s, message().id);
  s.primed = true;
  s.last_counter = last;
  s.last_us = kNow - 10'000;
  return s;
}

// verifies: SK-FG-4, SK-FG-8, IF-CAN-21 (the kernel: a jump is refused)
TEST(GuardCounters, EveryPair) {
  const berm_can_frame frame = message();
  for (int counter = 0; counter < 256; ++counter) {
    const berm_can_frame guard = berm_can_make_guard(&frame, static_cast<std::uint8_t>(counter));
    for (int last = 0; last < 256; ++last) {
      sk_guard_state s = primed(static_cast<std::uint8_t>(last));
      sk_guard_arm(&s, guard.data, guard.length, kNow);
      ASSERT_TRUE(s.armed);
      const std::int32_t result = sk_guard_accept(&s, frame.data, frame.length, kNow + 1);
      const bool next = counter == (last + 1) % 256 || counter == (last + 2) % 256 || counter == (last + 3) % 256;
      ASSERT_EQ(result, next ? SK_FRAME_OK : SK_FRAME_COUNTER) << "last " << last << " counter " << counter;
      ASSERT_EQ(s.last_counter, next ? counter : last);
      ASSERT_EQ(s.last_us, next ? kNow + 1 : kNow - 10'000);
      ASSERT_FALSE(s.armed);
    }
  }
}

// verifies: SK-FG-1, SK-FG-3, SK-FG-8
TEST(GuardCounters, EveryFlipOfUpToThreeBitsIsRefused) {
  const berm_can_frame frame = message();
  const berm_can_frame guard = berm_can_make_guard(&frame, 42);
  const auto accepted = [&](int a, int b, int c) {
    std::uint8_t bytes[16];
    std::copy(guard.data, guard.data + 8, bytes);
    std::copy(frame.data, frame.data + 8, bytes + 8);
    for (const int bit : {a, b, c}) {
      if (bit >= 0) bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ 1u << (bit % 8));
    }
    sk_guard_state s = primed(41);
    sk_guard_arm(&s, bytes, 8, kNow);
    const std::int32_t result = sk_guard_accept(&s, bytes + 8, 8, kNow);
    EXPECT_EQ(s.last_counter, result == SK_FRAME_OK ? 42 : 41);
    return result == SK_FRAME_OK;
  };
  EXPECT_TRUE(accepted(-1, -1, -1));
  for (int a = 0; a < 128; ++a) {
    EXPECT_FALSE(accepted(a, -1, -1)) << a;
    for (int b = a + 1; b < 128; ++b) {
      EXPECT_FALSE(accepted(a, b, -1)) << a << " " << b;
      for (int c = b + 1; c < 128; ++c) ASSERT_FALSE(accepted(a, b, c)) << a << " " << b << " " << c;
    }
  }
}

// A message under another message's id does not pass: the id is under the CRC.
// verifies: SK-FG-3
TEST(GuardCounters, EveryFlipOfTheIdIsRefused) {
  const berm_can_frame frame = message();
  for (int bit = 0; bit < 32; ++bit) {
    berm_can_frame other = frame;
    other.id ^= 1u << bit;
    berm_can_frame guard = berm_can_make_guard(&other, 42);
    guard.data[0] = BERM_CAN_DATA_ID(frame.id);
    sk_guard_state s = primed(41);
    sk_guard_arm(&s, guard.data, guard.length, kNow);
    EXPECT_EQ(sk_guard_accept(&s, frame.data, frame.length, kNow), SK_FRAME_CRC) << bit;
  }
}

}  // namespace
}  // namespace berm::core_test
