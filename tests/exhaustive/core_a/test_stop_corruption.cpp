// Every state code, and every value of every field of the state that is a number.
#include <gtest/gtest.h>

#include "stop_space.hpp"

namespace berm::core_test {
namespace {

// An input that would let everything pass.
sk_stop_input willing() {
  sk_stop_input in{};
  in.now_us = kEntered + 10'000;
  in.inputs_ready = in.standstill = in.operator_run = in.operator_reset = true;
  return in;
}

void expect_fault_if_invalid(const sk_stop_state& before) {
  sk_stop_state s = before;
  sk_stop_output out{true, true};
  const sk_stop_input in = willing();
  sk_stop_step(&s, &in, &out);
  if (valid_state(before)) {
    ASSERT_TRUE(valid_state(s));
    return;
  }
  ASSERT_EQ(s.code, SK_STATE_FAULT) << std::hex << before.code;
  ASSERT_EQ(s.reason, BERM_STOP_INTERNAL);
  ASSERT_EQ(s.category, SK_CATEGORY_0);
  ASSERT_TRUE(s.latched);
  ASSERT_FALSE(out.motion_enabled);
  ASSERT_FALSE(out.heartbeat_enable);
}

// verifies: SK-ST-23
TEST(StopCorruption, EveryCode) {
  for (const sk_stop_state& valid : valid_states()) {
    for (unsigned code = 0; code <= 0xFFFF; ++code) {
      sk_stop_state s = valid;
      s.code = static_cast<std::uint16_t>(code);
      expect_fault_if_invalid(s);
      if (HasFatalFailure()) return;
    }
  }
}

// verifies: SK-ST-23
TEST(StopCorruption, EveryFieldValue) {
  for (const sk_stop_state& valid : valid_states()) {
    for (unsigned reason = 0; reason <= 0xFF; ++reason)
      for (unsigned rank = 0; rank <= 0xFF; ++rank) {
        sk_stop_state s = valid;
        s.reason = static_cast<std::uint8_t>(reason);
        s.rank = static_cast<std::uint8_t>(rank);
        expect_fault_if_invalid(s);
        s.latched = !s.latched;
        expect_fault_if_invalid(s);
        if (HasFatalFailure()) return;
      }
    for (unsigned category = 0; category <= 0xFF; ++category) {
      sk_stop_state s = valid;
      s.category = static_cast<std::uint8_t>(category);
      expect_fault_if_invalid(s);
      if (HasFatalFailure()) return;
    }
  }
}

// verifies: SK-ST-23
TEST(StopCorruption, EveryValueOfTheRelease) {
  for (const sk_stop_state& valid : valid_states()) {
    for (unsigned value = 0; value <= 0xFFFF; ++value) {
      sk_stop_state s = valid;
      s.run_release = static_cast<std::uint16_t>(value);
      expect_fault_if_invalid(s);
      if (HasFatalFailure()) return;
    }
  }
}

// verifies: SK-ST-23
TEST(StopCorruption, CodesAreFarApart) {
  EXPECT_EQ(__builtin_popcount(static_cast<unsigned>(kAwaited ^ kSeen)), 16);
  for (const std::uint16_t a : kCodes)
    for (const std::uint16_t b : kCodes) {
      if (a == b) continue;
      EXPECT_GE(__builtin_popcount(static_cast<unsigned>(a ^ b)), 4) << name(a) << " and " << name(b);
    }
}

}  // namespace
}  // namespace berm::core_test
