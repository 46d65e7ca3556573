// Every single and every double bit flip of a guarded message and its guard: id, payload, and the whole guard frame.
#include <gtest/gtest.h>

#include <vector>

#include "can/berm_can.h"

namespace {

constexpr int kIdBits = 29, kDataBits = 64, kGuardBits = 64;
constexpr int kBits = kIdBits + kDataBits + kGuardBits;

struct Pair {
  berm_can_frame message, guard;
};

void flip(std::uint8_t (&data)[8], int bit) { data[bit / 8] = static_cast<std::uint8_t>(data[bit / 8] ^ (1u << (bit % 8))); }

void flip(Pair& pair, int bit) {
  if (bit < kIdBits)
    pair.message.id ^= 1u << bit;
  else if (bit < kIdBits + kDataBits)
    flip(pair.message.data, bit - kIdBits);
  else
    flip(pair.guard.data, bit - kIdBits - kDataBits);
}

// The receiver's rule (CAN.md), for a receiver that waits for this counter of this message.
bool accepted(const Pair& pair, std::uint32_t can_id, std::uint8_t counter) {
  berm_guard guard{};
  return berm_decode_guard(&pair.guard, &guard) && pair.message.id == can_id && guard.data_id == BERM_CAN_DATA_ID(can_id) && guard.counter == counter &&
         berm_can_guard_crc(pair.message.id, guard.counter, pair.message.data) == guard.crc32;
}

// What the CRC alone sees, the harder statement: nothing else of the receiver's rule helps it.
bool crc_fits(const Pair& pair) {
  const std::uint8_t* d = pair.guard.data;
  const std::uint32_t crc = d[4] | static_cast<std::uint32_t>(d[5]) << 8 | static_cast<std::uint32_t>(d[6]) << 16 | static_cast<std::uint32_t>(d[7]) << 24;
  return berm_can_guard_crc(pair.message.id, d[1], pair.message.data) == crc;
}

bool under_the_crc(int bit) {  // not data id and padding, which the receiver compares
  const int guard_bit = bit - kIdBits - kDataBits;
  return guard_bit < 0 || (guard_bit >= 8 && guard_bit < 16) || guard_bit >= 32;
}

std::vector<berm_can_frame> messages() {
  const berm_velocity_cmd neutral{}, moving{{300000, -200000, 100000, -50000}};
  const berm_front_angle angle{{1, 500000, -1700000, -900000}};
  const berm_heartbeat heartbeat{true, 255, 2, 0, 4711, 9};
  return {berm_encode_velocity_cmd(&neutral), berm_encode_velocity_cmd(&moving), berm_encode_front_angle(&angle), berm_encode_heartbeat(&heartbeat)};
}

// verifies: IF-CAN-11, IF-CAN-12
TEST(GuardBitFlips, AllSingleAndDoubleOnesAreDetected) {
  constexpr std::uint8_t kCounter = 0xA5;
  for (const berm_can_frame& message : messages()) {
    const Pair good{message, berm_can_make_guard(&message, kCounter)};
    ASSERT_TRUE(accepted(good, message.id, kCounter));
    ASSERT_TRUE(crc_fits(good));
    int by_rule = 0, by_crc = 0;
    for (int i = 0; i < kBits; ++i)
      for (int k = i; k < kBits; ++k) {  // k == i: a single flip
        Pair bad = good;
        flip(bad, i);
        if (k != i) flip(bad, k);
        ASSERT_FALSE(accepted(bad, message.id, kCounter)) << "bits " << i << ", " << k;
        ++by_rule;
        if (!under_the_crc(i) || !under_the_crc(k)) continue;
        ASSERT_FALSE(crc_fits(bad)) << "bits " << i << ", " << k;
        ++by_crc;
      }
    EXPECT_EQ(by_rule, kBits * (kBits + 1) / 2);
    EXPECT_EQ(by_crc, (kBits - 24) * (kBits - 24 + 1) / 2);
  }
}

}  // namespace
