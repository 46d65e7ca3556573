// Decoders refuse what is not theirs, and then change nothing.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "can/berm_can.h"

namespace {

struct Decoder {
  std::string name;
  std::uint32_t id;
  // Decodes into a message whose bytes are all 0x5A before; tells whether it was taken and whether a byte changed.
  std::function<bool(const berm_can_frame&, bool& changed)> decode;
};

template <typename Message>
Decoder decoder(const char* name, std::uint32_t id, bool (*function)(const berm_can_frame*, Message*)) {
  return {name, id, [function](const berm_can_frame& f, bool& changed) {
            alignas(Message) unsigned char bytes[sizeof(Message)], before[sizeof(Message)];
            std::memset(bytes, 0x5A, sizeof bytes);
            std::memcpy(before, bytes, sizeof bytes);
            const bool taken = function(&f, reinterpret_cast<Message*>(bytes));
            changed = std::memcmp(bytes, before, sizeof bytes) != 0;
            return taken;
          }};
}

std::vector<Decoder> decoders() {
  return {decoder("front_angle", BERM_CAN_FRONT_ANGLE, berm_decode_front_angle),
          decoder("front_velocity", BERM_CAN_FRONT_ANGULAR_VELOCITY, berm_decode_front_velocity),
          decoder("velocity_cmd", BERM_CAN_VELOCITY_CMD_1, berm_decode_velocity_cmd),
          decoder("pressure", BERM_CAN_PRESSURE_1, berm_decode_pressure),
          decoder("roll_pitch", BERM_CAN_ROLL_PITCH, berm_decode_roll_pitch),
          decoder("machine_state", BERM_CAN_MACHINE_STATE, berm_decode_machine_state),
          decoder("vehicle_azimuth", BERM_CAN_VEHICLE_AZIMUTH, berm_decode_vehicle_azimuth),
          decoder("payload", BERM_CAN_PAYLOAD, berm_decode_payload),
          decoder("estop", BERM_CAN_ESTOP_STATUS, berm_decode_estop),
          decoder("operator", BERM_CAN_OPERATOR, berm_decode_operator),
          decoder("spotter", BERM_CAN_SPOTTER, berm_decode_spotter),
          decoder("machine_setting", BERM_CAN_MACHINE_SETTING_CMD, berm_decode_machine_setting),
          decoder("heartbeat", BERM_CAN_HEARTBEAT, berm_decode_heartbeat),
          decoder("pan_cmd", BERM_CAN_SCANNER_PAN_CMD, berm_decode_pan_cmd),
          decoder("sim_clock", BERM_CAN_SIMULATION_CLOCK, berm_decode_sim_clock)};
}

berm_can_frame ones(std::uint32_t id, std::uint8_t length) { return {id, length, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}}; }

// verifies: IF-CAN-6
TEST(Refusals, EveryLengthButEight) {
  for (const Decoder& d : decoders())
    for (int length = 0; length < 256; ++length) {
      bool changed = false;
      EXPECT_EQ(d.decode(ones(d.id, static_cast<std::uint8_t>(length)), changed), length == 8) << d.name << " length " << length;
      EXPECT_EQ(changed, length == 8) << d.name << " length " << length;
    }
}

// verifies: IF-CAN-6
TEST(Refusals, EveryOtherIdentifierOfTheNetworkAndEveryFlippedBit) {
  for (const Decoder& d : decoders()) {
    for (const Decoder& other : decoders()) {
      bool changed = false;
      EXPECT_EQ(d.decode(ones(other.id, 8), changed), other.id == d.id) << d.name << " given " << other.name;
      EXPECT_EQ(changed, other.id == d.id);
    }
    for (int bit = 0; bit < 32; ++bit) {
      bool changed = false;
      EXPECT_FALSE(d.decode(ones(d.id ^ (1u << bit), 8), changed)) << d.name << " bit " << bit;
      EXPECT_FALSE(changed);
    }
  }
}

// verifies: IF-CAN-6, IF-CAN-10
TEST(Refusals, GuardsNeedTheirIdLengthAndPadding) {
  const Decoder d = decoder("guard", BERM_CAN_GUARD_KERNEL, berm_decode_guard);
  bool changed = false;
  EXPECT_TRUE(d.decode(ones(BERM_CAN_GUARD_KERNEL, 8), changed));
  for (int length = 0; length < 256; ++length) {
    if (length == 8) continue;
    EXPECT_FALSE(d.decode(ones(BERM_CAN_GUARD_KERNEL, static_cast<std::uint8_t>(length)), changed));
    EXPECT_FALSE(changed);
  }
  for (int bit = 8; bit < 32; ++bit) {  // the low byte is the source
    EXPECT_FALSE(d.decode(ones(BERM_CAN_GUARD_KERNEL ^ (1u << bit), 8), changed)) << "id bit " << bit;
    EXPECT_FALSE(changed);
  }
  for (int bit = 0; bit < 16; ++bit) {
    berm_can_frame f = ones(BERM_CAN_GUARD_KERNEL, 8);
    f.data[2 + bit / 8] = static_cast<std::uint8_t>(f.data[2 + bit / 8] ^ (1u << (bit % 8)));
    EXPECT_FALSE(d.decode(f, changed)) << "padding bit " << bit;
    EXPECT_FALSE(changed);
  }
}

// verifies: IF-CAN-3
TEST(Refusals, DataIdsAreUnique) {
  const auto all = decoders();
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = i + 1; k < all.size(); ++k) EXPECT_NE(BERM_CAN_DATA_ID(all[i].id), BERM_CAN_DATA_ID(all[k].id)) << all[i].name << " " << all[k].name;
}

}  // namespace
