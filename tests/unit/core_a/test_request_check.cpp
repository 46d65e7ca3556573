#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "request_bytes.hpp"
#include "valid_parameters.hpp"

namespace berm::core_test {
namespace {

constexpr std::int32_t kMin32 = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMax32 = std::numeric_limits<std::int32_t>::max();

class RequestCheck : public testing::Test {
 protected:
  // Checks a request and that a refusal changed nothing.
  std::int32_t check(const RequestBytes& raw, std::int64_t now_us = kNow) {
    const sk_request_state state_was = state;
    out = untouched_output();
    const std::int32_t result = sk_request_check(&state, raw.data(), &parameters, now_us, &out);
    if (result != BERM_REQUEST_ACCEPTED) {
      EXPECT_TRUE(same(state, state_was)) << "a refusal changed the state, result " << result;
      EXPECT_TRUE(same(out, untouched_output())) << "a refusal changed the output, result " << result;
      state = state_was;
    }
    return result;
  }
  std::int32_t check_changed(const std::function<void(berm_request&)>& change, std::int64_t now_us = kNow) {
    berm_request r = valid_request();
    change(r);
    state = state_before();
    return check(sealed(r), now_us);
  }

  const berm_parameters parameters = valid_parameters();
  sk_request_state state = state_before();
  sk_request out{};
};

// verifies: SK-RQ-10, SK-RQ-11, IF-CT-10
TEST_F(RequestCheck, AcceptsAndDecodes) {
  const berm_request r = valid_request();
  ASSERT_EQ(check(sealed(r)), BERM_REQUEST_ACCEPTED);
  EXPECT_EQ(out.phase, r.phase);
  EXPECT_EQ(out.flags, r.flags);
  EXPECT_EQ(out.sequence, r.sequence);
  EXPECT_EQ(out.stamp_us, r.stamp_us);
  for (int j = 0; j < BERM_JOINTS; ++j) EXPECT_EQ(out.joint_velocity_urad_s[j], r.joint_velocity_urad_s[j]) << "joint " << j;
  for (int i = 0; i < BERM_SCANNERS; ++i) {
    EXPECT_EQ(out.pan_goal_urad[i], r.pan_goal_urad[i]) << "scanner " << i;
    EXPECT_EQ(out.pan_rate_urad_s[i], r.pan_rate_urad_s[i]) << "scanner " << i;
  }
  EXPECT_TRUE(state.primed);
  EXPECT_EQ(state.last_sequence, r.sequence);
  EXPECT_EQ(state.last_accept_us, kNow);
}

// verifies: SK-RQ-1, SK-RQ-9, IF-CT-10 (magic, version)
TEST_F(RequestCheck, MagicAndVersion) {
  EXPECT_EQ(check_changed([](berm_request& r) { r.magic += 1; }), BERM_REQUEST_MAGIC);
  EXPECT_EQ(check_changed([](berm_request& r) { r.version += 1; }), BERM_REQUEST_VERSION);
  EXPECT_EQ(check_changed([](berm_request& r) { r.version = 0; }), BERM_REQUEST_VERSION);
}

// verifies: SK-RQ-4
TEST_F(RequestCheck, SameSequenceIsNothingNew) {
  const RequestBytes raw = sealed(valid_request());
  ASSERT_EQ(check(raw), BERM_REQUEST_ACCEPTED);
  EXPECT_EQ(check(raw, kNow + 10'000), BERM_REQUEST_NONE);
  // also when it has grown too old meanwhile: nothing new is not an error
  EXPECT_EQ(check(raw, kNow + 10'000'000), BERM_REQUEST_NONE);
}

// verifies: SK-RQ-3, SK-RQ-4, IF-CT-10 (the sequence)
TEST_F(RequestCheck, SequenceGap) {
  for (const std::uint32_t last : {0u, 1u, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFC17u, 0xFFFFFFFFu}) {
    for (std::int64_t gap = -5000; gap <= 5000; ++gap) {
      berm_request r = valid_request();
      r.sequence = last + static_cast<std::uint32_t>(gap);
      state = {true, last, 0};
      const std::int32_t expected = gap == 0 ? BERM_REQUEST_NONE : gap >= 1 && gap <= SK_REQUEST_GAP_MAX ? BERM_REQUEST_ACCEPTED : BERM_REQUEST_SEQUENCE;
      ASSERT_EQ(check(sealed(r)), expected) << "last " << last << " gap " << gap;
    }
  }
}

// verifies: SK-RQ-3, IF-CT-10 (the first sequence)
TEST_F(RequestCheck, FirstRequestMayHaveAnySequence) {
  for (const std::uint32_t sequence : {0u, 7u, 0x80000000u, 0xFFFFFFFFu}) {
    berm_request r = valid_request();
    r.sequence = sequence;
    state = {false, sequence, 0};
    EXPECT_EQ(check(sealed(r)), BERM_REQUEST_ACCEPTED) << sequence;
    EXPECT_EQ(state.last_sequence, sequence);
  }
}

// Only a few bits of the difference would be enough for gaps as small as those above.
// verifies: SK-RQ-3, IF-CT-10 (the sequence)
TEST_F(RequestCheck, NoFarSequenceIsTakenForANearOne) {
  constexpr std::uint32_t last = 0x9ABCDEF0u;
  for (int bit = 10; bit < 32; ++bit) {
    for (const std::uint32_t beside : {0u, 1u, 2u, 500u, 1000u}) {
      for (const std::uint32_t gap : {(1u << bit) + beside, (1u << bit) - beside, 0u - (1u << bit) + beside, 0u - (1u << bit) - beside}) {
        berm_request r = valid_request();
        r.sequence = last + gap;
        state = {true, last, 0};
        ASSERT_EQ(check(sealed(r)), gap >= 1 && gap <= SK_REQUEST_GAP_MAX ? BERM_REQUEST_ACCEPTED : BERM_REQUEST_SEQUENCE) << "gap " << gap;
      }
    }
  }
}

// An app that has just connected: its first request may have any sequence, and from then on each counts from the last that was accepted.
// verifies: SK-RQ-3, SK-RQ-4, IF-CT-10 (the sequence, the first sequence)
TEST_F(RequestCheck, EachCountsFromTheLastThatWasAccepted) {
  const auto send = [this](std::uint32_t sequence) {
    berm_request r = valid_request();
    r.sequence = sequence;
    return check(sealed(r));
  };
  constexpr std::uint32_t first = 0xFFFFFE00u;
  state = {};
  EXPECT_EQ(send(first), BERM_REQUEST_ACCEPTED);
  EXPECT_EQ(send(first), BERM_REQUEST_NONE);
  EXPECT_EQ(send(first - 1), BERM_REQUEST_SEQUENCE);
  EXPECT_EQ(send(first + 1001), BERM_REQUEST_SEQUENCE);
  EXPECT_EQ(send(first + 1000), BERM_REQUEST_ACCEPTED) << "beyond 2^32, and what was refused counts for nothing";
  EXPECT_EQ(send(first), BERM_REQUEST_SEQUENCE) << "an earlier one";
  EXPECT_EQ(send(first + 2001), BERM_REQUEST_SEQUENCE);
  EXPECT_EQ(send(first + 1001), BERM_REQUEST_ACCEPTED);
}

// verifies: SK-RQ-5, IF-CT-10 (the stamp)
TEST_F(RequestCheck, Age) {
  const std::int64_t limit = parameters.request_age_us;
  const auto stamp = [&](std::int64_t t, std::int64_t now) { return check_changed([&](berm_request& r) { r.stamp_us = t; }, now); };
  EXPECT_EQ(stamp(kNow, kNow), BERM_REQUEST_ACCEPTED);
  EXPECT_EQ(stamp(kNow - limit, kNow), BERM_REQUEST_ACCEPTED);
  EXPECT_EQ(stamp(kNow - limit - 1, kNow), BERM_REQUEST_AGE);
  EXPECT_EQ(stamp(kNow + 1, kNow), BERM_REQUEST_AGE);
  EXPECT_EQ(stamp(-1, 0), BERM_REQUEST_AGE);
  EXPECT_EQ(stamp(0, 0), BERM_REQUEST_ACCEPTED);
  for (const std::int64_t far : {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()}) {
    EXPECT_EQ(stamp(far, kNow), BERM_REQUEST_AGE) << far;
    EXPECT_EQ(stamp(far, std::numeric_limits<std::int64_t>::min()), BERM_REQUEST_AGE) << far;
  }
}

// verifies: SK-RQ-6, IF-CT-10 (velocities)
TEST_F(RequestCheck, VelocityRange) {
  for (int j = 0; j < BERM_JOINTS; ++j) {
    const std::int32_t limit = parameters.velocity_max_urad_s[j];
    const auto velocity = [&](std::int32_t v) { return check_changed([&](berm_request& r) { r.joint_velocity_urad_s[j] = v; }); };
    for (const std::int32_t v : {limit, -limit, 0}) EXPECT_EQ(velocity(v), BERM_REQUEST_ACCEPTED) << "joint " << j << " velocity " << v;
    for (const std::int32_t v : {limit + 1, -limit - 1, kMin32, kMax32}) EXPECT_EQ(velocity(v), BERM_REQUEST_RANGE) << "joint " << j << " velocity " << v;
  }
}

// verifies: SK-RQ-7, IF-CT-10 (pans)
TEST_F(RequestCheck, PanRange) {
  for (int i = 0; i < BERM_SCANNERS; ++i) {
    const berm_scanner_mount& mount = parameters.scanner[i];
    const auto goal = [&](std::int32_t v) { return check_changed([&](berm_request& r) { r.pan_goal_urad[i] = v; }); };
    const auto rate = [&](std::int32_t v) { return check_changed([&](berm_request& r) { r.pan_rate_urad_s[i] = v; }); };
    for (const std::int32_t v : {mount.pan_low_urad, mount.pan_high_urad}) EXPECT_EQ(goal(v), BERM_REQUEST_ACCEPTED) << "scanner " << i << " goal " << v;
    for (const std::int32_t v : {mount.pan_low_urad - 1, mount.pan_high_urad + 1, kMin32, kMax32})
      EXPECT_EQ(goal(v), BERM_REQUEST_RANGE) << "scanner " << i << " goal " << v;
    for (const std::int32_t v : {0, mount.pan_rate_max_urad_s}) EXPECT_EQ(rate(v), BERM_REQUEST_ACCEPTED) << "scanner " << i << " rate " << v;
    for (const std::int32_t v : {-1, mount.pan_rate_max_urad_s + 1, kMin32, kMax32})
      EXPECT_EQ(rate(v), BERM_REQUEST_RANGE) << "scanner " << i << " rate " << v;
  }
}

// verifies: SK-RQ-8, IF-CT-10 (phase, flags, reserved_tail)
TEST_F(RequestCheck, PhaseFlagsReserved) {
  for (std::uint32_t phase = 0; phase <= 0xFFFF; ++phase) {
    ASSERT_EQ(check_changed([&](berm_request& r) { r.phase = static_cast<std::uint16_t>(phase); }),
              phase < BERM_PHASE_COUNT ? BERM_REQUEST_ACCEPTED : BERM_REQUEST_RANGE) << "phase " << phase;
  }
  EXPECT_EQ(check_changed([](berm_request& r) { r.flags = 0; }), BERM_REQUEST_ACCEPTED);
  for (int bit = 1; bit < 32; ++bit) {
    EXPECT_EQ(check_changed([&](berm_request& r) { r.flags = 1u << bit; }), BERM_REQUEST_RANGE) << "flag bit " << bit;
    EXPECT_EQ(check_changed([&](berm_request& r) { r.flags = 1u << bit | 1u; }), BERM_REQUEST_RANGE) << "flag bit " << bit;
  }
  for (int bit = 0; bit < 32; ++bit)
    EXPECT_EQ(check_changed([&](berm_request& r) { r.reserved_tail = 1u << bit; }), BERM_REQUEST_RANGE) << "reserved bit " << bit;
}

// Breaks every selection of the six checks, the sequence and the ranges in each of their ways.
// verifies: SK-RQ-11, IF-CT-11 (the order), SK-RQ-4 (after the CRC, before the age)
TEST_F(RequestCheck, OfWhateverFailsTheFirstInTheOrderIsReturned) {
  enum : unsigned { kMagic = 1, kVersion = 2, kCrc = 4, kSequence = 8, kAge = 16, kRange = 32, kAll = 63 };
  for (unsigned broken = 0; broken <= kAll; ++broken) {
    for (int way = 0; way < 6; ++way) {
      const bool again = way % 2 != 0;
      berm_request r = valid_request();
      if ((broken & kMagic) != 0) r.magic = 9;
      if ((broken & kVersion) != 0) r.version = 9;
      if ((broken & kSequence) != 0) r.sequence = again ? state_before().last_sequence : r.sequence + 5000;
      if ((broken & kAge) != 0) r.stamp_us = kNow + 1;
      if ((broken & kRange) != 0 && way / 2 == 0) r.joint_velocity_urad_s[2] = kMax32;
      if ((broken & kRange) != 0 && way / 2 == 1) r.pan_goal_urad[1] = kMin32;
      if ((broken & kRange) != 0 && way / 2 == 2) r.phase = BERM_PHASE_COUNT;
      RequestBytes raw = sealed(r);
      if ((broken & kCrc) != 0) raw[63] ^= 0x80;
      const std::int32_t expected = (broken & kMagic) != 0      ? BERM_REQUEST_MAGIC
                                    : (broken & kVersion) != 0  ? BERM_REQUEST_VERSION
                                    : (broken & kCrc) != 0      ? BERM_REQUEST_CRC
                                    : (broken & kSequence) != 0 ? (again ? BERM_REQUEST_NONE : BERM_REQUEST_SEQUENCE)
                                    : (broken & kAge) != 0      ? BERM_REQUEST_AGE
                                    : (broken & kRange) != 0    ? BERM_REQUEST_RANGE
                                                                : BERM_REQUEST_ACCEPTED;
      state = state_before();
      EXPECT_EQ(check(raw), expected) << "broken " << broken << ", way " << way;
    }
  }
}

}  // namespace
}  // namespace berm::core_test
