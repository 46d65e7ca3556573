// Codec of the CAN frames: the values that matter, rounding, saturation, joint order.
#include <gtest/gtest.h>

#include <cstring>

#include "can/berm_can.h"

namespace {

std::uint32_t raw16(const berm_can_frame& f, int field) { return f.data[2 * field] | static_cast<std::uint32_t>(f.data[2 * field + 1]) << 8; }

// verifies: IF-CAN-7
TEST(Codec, NeutralVelocityIsRaw7D00) {
  const berm_velocity_cmd neutral{};
  const berm_can_frame f = berm_encode_velocity_cmd(&neutral);
  EXPECT_EQ(f.id, BERM_CAN_VELOCITY_CMD_1);
  EXPECT_EQ(f.length, 8);
  for (int field = 0; field < 4; ++field) EXPECT_EQ(raw16(f, field), 0x7D00u) << field;
}

// verifies: IF-CAN-7
TEST(Codec, AnAllZeroVelocityFrameIsFullSpeedBackwards) {
  const berm_can_frame f{BERM_CAN_VELOCITY_CMD_1, 8, {}};
  berm_velocity_cmd m{};
  ASSERT_TRUE(berm_decode_velocity_cmd(&f, &m));
  for (const std::int32_t v : m.velocity_urad_s) EXPECT_EQ(v, -16000000);
}

// verifies: IF-CAN-4
TEST(Codec, FramesHaveBoomStickBucketSwing) {
  const berm_velocity_cmd m{{500, 1000, 1500, 2000}};  // swing, boom, stick, bucket
  const berm_can_frame f = berm_encode_velocity_cmd(&m);
  EXPECT_EQ(raw16(f, 0), 0x7D00u + 2);
  EXPECT_EQ(raw16(f, 1), 0x7D00u + 3);
  EXPECT_EQ(raw16(f, 2), 0x7D00u + 4);
  EXPECT_EQ(raw16(f, 3), 0x7D00u + 1);
}

struct Rounding {
  std::int32_t angle_urad;
  std::uint32_t raw;
};
class AngleRounding : public testing::TestWithParam<Rounding> {};

// verifies: IF-CAN-5
TEST_P(AngleRounding, ToTheNearestStepWithinTheField) {
  const berm_front_angle m{{GetParam().angle_urad, 0, 0, 0}};
  EXPECT_EQ(raw16(berm_encode_front_angle(&m), 3), GetParam().raw);
}
INSTANTIATE_TEST_SUITE_P(Codec, AngleRounding,
                         testing::Values(Rounding{0, 25000}, Rounding{199, 25000}, Rounding{200, 25001}, Rounding{-199, 25000}, Rounding{-201, 24999},
                                         Rounding{-10000000, 0}, Rounding{-10000001, 0}, Rounding{INT32_MIN, 0}, Rounding{16214000, 65535},
                                         Rounding{16214201, 65535}, Rounding{INT32_MAX, 65535}));

// verifies: IF-CAN-5
TEST(Codec, NarrowFieldsSaturateAndLeaveTheirNeighboursAlone) {
  berm_machine_state state{};
  state.can_errors = 255;
  const berm_can_frame f = berm_encode_machine_state(&state);
  EXPECT_EQ(f.data[0], 0);
  EXPECT_EQ(f.data[1], 0x0E);
  berm_machine_setting setting{};
  setting.led = 9;
  setting.front_signal = 200;
  const berm_can_frame g = berm_encode_machine_setting(&setting);
  EXPECT_EQ(g.data[1], 0x30);
  EXPECT_EQ(g.data[3], 0xF0);
}

// verifies: IF-CAN-5
TEST(Codec, TheWarmestAndColdestOil) {
  for (const auto& [celsius, expected] : {std::pair<std::int16_t, int>{-300, -100}, {-100, -100}, {90, 90}, {155, 155}, {3000, 155}}) {
    berm_machine_state state{};
    state.oil_temperature_c = celsius;
    const berm_can_frame f = berm_encode_machine_state(&state);
    ASSERT_TRUE(berm_decode_machine_state(&f, &state));
    EXPECT_EQ(state.oil_temperature_c, expected);
  }
}

// verifies: IF-CAN-10
TEST(Guard, NamesItsMessageAndComesFromTheSameSource) {
  const berm_velocity_cmd neutral{};
  const berm_can_frame f = berm_encode_velocity_cmd(&neutral);
  const berm_can_frame g = berm_can_make_guard(&f, 200);
  EXPECT_EQ(g.id, BERM_CAN_GUARD_KERNEL);
  EXPECT_EQ(g.length, 8);
  EXPECT_EQ(g.data[0], 0x67);
  EXPECT_EQ(g.data[1], 200);
  EXPECT_EQ(g.data[2], 0xFF);
  EXPECT_EQ(g.data[3], 0xFF);
  EXPECT_EQ(berm_can_guard_id(BERM_CAN_FRONT_ANGLE), BERM_CAN_GUARD_MACHINE);
  EXPECT_EQ(berm_can_guard_id(BERM_CAN_OPERATOR), BERM_CAN_GUARD_OPERATOR);
  EXPECT_EQ(berm_can_guard_id(BERM_CAN_SPOTTER), BERM_CAN_GUARD_SPOTTER);
}

// A CRC-32 by definition, bit by bit, against the table of the product.
std::uint32_t crc_bitwise(const std::uint8_t* bytes, std::size_t n) {
  std::uint32_t crc = 0xFFFFFFFFu;
  for (std::size_t i = 0; i < n; ++i)
    for (int bit = 0; bit < 8; ++bit) {
      const std::uint32_t in = (static_cast<std::uint32_t>(bytes[i]) >> bit) & 1u;
      crc = ((crc ^ in) & 1u) ? (crc >> 1) ^ 0xEDB88320u : crc >> 1;
    }
  return ~crc;
}

// verifies: IF-CAN-11
TEST(Guard, CrcOverIdCounterAndPayload) {
  const std::uint8_t data[8] = {1, 2, 3, 4, 5, 6, 7, 250};
  std::uint8_t bytes[13] = {0x0A, 0x67, 0xFF, 0x18, 17};
  std::memcpy(bytes + 5, data, 8);
  EXPECT_EQ(berm_can_guard_crc(BERM_CAN_VELOCITY_CMD_1, 17, data), crc_bitwise(bytes, sizeof bytes));
}

}  // namespace
