// Lets a script drive the codec: one command a line on stdin, one answer a line on stdout.
//   fields                      NAME field field ... for every message, one a line, then an empty line
//   encode NAME value ...       the frame: ID LENGTH HEX. Values in the codec's units, order of the fields
//   decode ID LENGTH HEX        NAME value ..., or "refused"
#include <cstdint>
#include <cstdio>
#include <functional>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "can/berm_can.h"

namespace {

using Values = std::vector<std::int64_t>;

struct Message {
  std::string name;
  std::vector<std::string> fields;  // as the description names them
  std::function<berm_can_frame(const Values&)> encode;
  std::function<bool(const berm_can_frame&, Values&)> decode;
};

template <typename T>
Message message(const char* name, std::vector<std::string> fields, berm_can_frame (*encode)(const T*), bool (*decode)(const berm_can_frame*, T*),
                std::function<void(const Values&, T&)> fill, std::function<Values(const T&)> read) {
  return {name, std::move(fields),
          [encode, fill](const Values& v) {
            T m{};
            fill(v, m);
            return encode(&m);
          },
          [decode, read](const berm_can_frame& f, Values& v) {
            T m{};
            if (!decode(&f, &m)) return false;
            v = read(m);
            return true;
          }};
}

std::int32_t i32(std::int64_t v) { return static_cast<std::int32_t>(v); }
std::uint32_t u32(std::int64_t v) { return static_cast<std::uint32_t>(v); }
std::uint8_t u8(std::int64_t v) { return static_cast<std::uint8_t>(v); }

// Frames have boom, stick, bucket, swing; arrays have the swing first.
template <typename T, std::int32_t (T::*array)[4]>
Message joints(const char* name, berm_can_frame (*encode)(const T*), bool (*decode)(const berm_can_frame*, T*)) {
  return message<T>(
      name, {"Boom", "Stick", "Bucket", "Swing"}, encode, decode,
      [](const Values& v, T& m) {
        for (std::size_t i = 0; i < 4; ++i) (m.*array)[(i + 1) % 4] = i32(v[i]);
      },
      [](const T& m) { return Values{(m.*array)[1], (m.*array)[2], (m.*array)[3], (m.*array)[0]}; });
}

Message guard(const char* name, std::uint32_t id) {
  return {name, {"Data_Id", "Counter", "Padding", "Crc32"},
          [id](const Values& v) {
            const berm_guard m{u8(v[0]), u8(v[1]), u32(v[3])};
            return berm_encode_guard(id, &m);
          },
          [id](const berm_can_frame& f, Values& v) {
            berm_guard m{};
            if (f.id != id || !berm_decode_guard(&f, &m)) return false;
            v = {m.data_id, m.counter, 0xFFFF, m.crc32};
            return true;
          }};
}

std::vector<Message> machine_messages() {
  return {
      joints<berm_front_angle, &berm_front_angle::angle_urad>("Front_Angle", berm_encode_front_angle, berm_decode_front_angle),
      joints<berm_front_velocity, &berm_front_velocity::velocity_urad_s>("Front_Angular_Velocity", berm_encode_front_velocity, berm_decode_front_velocity),
      message<berm_pressure>(
          "Pressure_1", {"Boom_Bottom", "Boom_Rod", "Stick_Bottom", "Stick_Rod", "Bucket_Bottom", "Bucket_Rod", "Swing_A", "Swing_B"}, berm_encode_pressure,
          berm_decode_pressure,
          [](const Values& v, berm_pressure& m) {
            for (std::size_t i = 0; i < 8; ++i) m.kpa[i] = i32(v[i]);
          },
          [](const berm_pressure& m) { return Values(m.kpa, m.kpa + 8); }),
      message<berm_roll_pitch>("Roll_Pitch", {"Roll", "Pitch"}, berm_encode_roll_pitch, berm_decode_roll_pitch,
                               [](const Values& v, berm_roll_pitch& m) { m = {i32(v[0]), i32(v[1])}; },
                               [](const berm_roll_pitch& m) { return Values{m.roll_urad, m.pitch_urad}; }),
      message<berm_machine_state>(
          "Machine_State",
          {"Lock_Command", "Pilot_Unlocked", "System_Error", "Can_Errors", "Lock_Receiver_Error", "Estop_Receiver_Error", "Switch_Error", "Control_State",
           "Oil_Temperature", "Engine_On", "Alive_Counter"},
          berm_encode_machine_state, berm_decode_machine_state,
          [](const Values& v, berm_machine_state& m) {
            m = {v[0] != 0, v[1] != 0, v[2] != 0, u8(v[3]), v[4] != 0, v[5] != 0, v[6] != 0, u8(v[7]), static_cast<std::int16_t>(v[8]), v[9] != 0, u8(v[10])};
          },
          [](const berm_machine_state& m) {
            return Values{m.lock_command, m.pilot_unlocked, m.system_error, m.can_errors, m.lock_receiver_error, m.estop_receiver_error, m.switch_error,
                          m.control_state, m.oil_temperature_c, m.engine_on, m.alive_counter};
          }),
      message<berm_vehicle_azimuth>("Vehicle_Azimuth", {"Upper_Body", "Track"}, berm_encode_vehicle_azimuth, berm_decode_vehicle_azimuth,
                                    [](const Values& v, berm_vehicle_azimuth& m) { m = {i32(v[0]), i32(v[1])}; },
                                    [](const berm_vehicle_azimuth& m) { return Values{m.upper_urad, m.track_urad}; }),
      message<berm_payload>("Payload", {"Mass", "Valid"}, berm_encode_payload, berm_decode_payload,
                            [](const Values& v, berm_payload& m) { m = {static_cast<std::uint16_t>(v[0]), v[1] != 0}; },
                            [](const berm_payload& m) { return Values{m.kg, m.valid}; }),
      message<berm_estop>("Estop_Status", {"Pressed", "Receiver_Ok", "Alive_Counter"}, berm_encode_estop, berm_decode_estop,
                          [](const Values& v, berm_estop& m) { m = {v[0] != 0, v[1] != 0, u8(v[2])}; },
                          [](const berm_estop& m) { return Values{m.pressed, m.receiver_ok, m.alive_counter}; }),
      guard("Guard_Machine", BERM_CAN_GUARD_MACHINE)};
}

std::vector<Message> other_messages() {
  return {
      message<berm_operator>("Operator", {"Run", "Stop", "Reset", "Relearn", "Alive_Counter"}, berm_encode_operator, berm_decode_operator,
                             [](const Values& v, berm_operator& m) { m = {v[0] != 0, v[1] != 0, v[2] != 0, v[3] != 0, u8(v[4])}; },
                             [](const berm_operator& m) { return Values{m.run, m.stop, m.reset, m.relearn, m.alive_counter}; }),
      message<berm_spotter>("Spotter", {"Truck_Parked", "Truck_Leaving", "Stop", "Alive_Counter"}, berm_encode_spotter, berm_decode_spotter,
                            [](const Values& v, berm_spotter& m) { m = {v[0] != 0, v[1] != 0, v[2] != 0, u8(v[3])}; },
                            [](const berm_spotter& m) { return Values{m.truck_parked, m.truck_leaving, m.stop, m.alive_counter}; }),
      joints<berm_velocity_cmd, &berm_velocity_cmd::velocity_urad_s>("Velocity_Cmd_1", berm_encode_velocity_cmd, berm_decode_velocity_cmd),
      message<berm_machine_setting>(
          "Machine_Setting_Cmd", {"Engine_Speed", "Eco", "Fast_Travel", "Working_Notice", "Led", "Horn", "Front_Signal", "Alive_Counter"},
          berm_encode_machine_setting, berm_decode_machine_setting,
          [](const Values& v, berm_machine_setting& m) { m = {u8(v[0]), v[1] != 0, v[2] != 0, v[3] != 0, u8(v[4]), v[5] != 0, u8(v[6]), u8(v[7])}; },
          [](const berm_machine_setting& m) {
            return Values{m.engine_rpm_x10, m.eco, m.fast_travel, m.working_notice, m.led, m.horn, m.front_signal, m.alive_counter};
          }),
      message<berm_heartbeat>(
          "Heartbeat", {"Enable", "Stop_Category", "Kernel_State", "Stop_Reason", "Cycle", "Alive_Counter"}, berm_encode_heartbeat, berm_decode_heartbeat,
          [](const Values& v, berm_heartbeat& m) { m = {v[0] != 0, u8(v[1]), u8(v[2]), u8(v[3]), static_cast<std::uint16_t>(v[4]), u8(v[5])}; },
          [](const berm_heartbeat& m) { return Values{m.enable, m.stop_category, m.kernel_state, m.stop_reason, m.cycle, m.alive_counter}; }),
      message<berm_pan_cmd>("Scanner_Pan_Cmd", {"Scanner", "Goal", "Rate"}, berm_encode_pan_cmd, berm_decode_pan_cmd,
                            [](const Values& v, berm_pan_cmd& m) { m = {u8(v[0]), i32(v[1]), i32(v[2])}; },
                            [](const berm_pan_cmd& m) { return Values{m.scanner, m.goal_urad, m.rate_urad_s}; }),
      message<berm_sim_clock>("Simulation_Clock", {"Cycle", "Scan_Packets"}, berm_encode_sim_clock, berm_decode_sim_clock,
                              [](const Values& v, berm_sim_clock& m) { m = {u32(v[0]), u32(v[1])}; },
                              [](const berm_sim_clock& m) { return Values{m.cycle, m.scan_packets}; }),
      guard("Guard_Kernel", BERM_CAN_GUARD_KERNEL),
      guard("Guard_Operator", BERM_CAN_GUARD_OPERATOR),
      guard("Guard_Spotter", BERM_CAN_GUARD_SPOTTER)};
}

void print(const berm_can_frame& f) {
  std::printf("%08X %u ", static_cast<unsigned>(f.id), static_cast<unsigned>(f.length));
  for (const std::uint8_t byte : f.data) std::printf("%02X", static_cast<unsigned>(byte));
  std::printf("\n");
}

bool answer(std::istringstream line, const std::vector<Message>& messages) {
  std::string command, name;
  line >> command;
  if (command == "fields") {
    for (const Message& m : messages) {
      std::printf("%s", m.name.c_str());
      for (const std::string& field : m.fields) std::printf(" %s", field.c_str());
      std::printf("\n");
    }
    std::printf("\n");
    return true;
  }
  if (command == "encode") {
    line >> name;
    Values values;
    for (std::int64_t v = 0; line >> v;) values.push_back(v);
    for (const Message& m : messages)
      if (m.name == name && m.fields.size() == values.size()) {
        print(m.encode(values));
        return true;
      }
    return false;
  }
  unsigned length = 0;
  berm_can_frame f{};
  std::string hex;
  line >> std::hex >> f.id >> std::dec >> length >> hex;
  if (command != "decode" || hex.size() != 16) return false;
  f.length = static_cast<std::uint8_t>(length);
  for (std::size_t i = 0; i < 8; ++i) f.data[i] = static_cast<std::uint8_t>(std::stoul(hex.substr(2 * i, 2), nullptr, 16));
  for (const Message& m : messages) {
    Values values;
    if (!m.decode(f, values)) continue;
    std::printf("%s", m.name.c_str());
    for (const std::int64_t v : values) std::printf(" %lld", static_cast<long long>(v));
    std::printf("\n");
    return true;
  }
  std::printf("refused\n");
  return true;
}

}  // namespace

int main() {
  std::vector<Message> messages = machine_messages();
  for (Message& m : other_messages()) messages.push_back(std::move(m));
  for (std::string line; std::getline(std::cin, line);)
    if (!answer(std::istringstream(line), messages)) {
      std::fprintf(stderr, "can_codec_probe: not understood: %s\n", line.c_str());
      return 2;
    }
  return 0;
}
