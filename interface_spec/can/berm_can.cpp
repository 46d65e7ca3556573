// Codec of berm.dbc (CAN.md). Integer arithmetic only; the inputs of an encoder are rounded to the nearest raw step and saturated at the field.
#include "can/berm_can.h"

#include "scan/scan_packet.h"

namespace {

constexpr uint8_t kLength = 8;
constexpr uint32_t kGuardPadding = 0xFFFF;  // bits 16 to 31 of a guard frame

struct Scale {
  int32_t step;    // physical units a raw step
  int32_t offset;  // physical value of raw 0
  uint32_t raw_max;
};

constexpr Scale kAngle{400, -10000000, 0xFFFF};      // urad
constexpr Scale kVelocity{200, -5000000, 0xFFFF};    // urad/s
constexpr Scale kCommand{500, -16000000, 0xFFFF};    // urad/s
constexpr Scale kPressure{200, -10000, 0xFF};        // kPa
constexpr Scale kInclination{500, -4000000, 0x3FFF}; // urad
constexpr Scale kRate{500, 0, 0xFFFF};               // urad/s
constexpr Scale kTemperature{1, -100, 0xFF};         // degrees Celsius

// Place of each joint in the machine's frames: boom, stick, bucket, swing.
constexpr int kField[4] = {3, 0, 1, 2};

uint32_t to_raw(const Scale& scale, int32_t value) {
  const int64_t above = static_cast<int64_t>(value) - scale.offset;
  if (above <= 0) return 0;
  const int64_t raw = (above + scale.step / 2) / scale.step;
  return raw > static_cast<int64_t>(scale.raw_max) ? scale.raw_max : static_cast<uint32_t>(raw);
}

int32_t from_raw(const Scale& scale, uint32_t raw) { return static_cast<int32_t>(static_cast<int64_t>(raw) * scale.step + scale.offset); }

berm_can_frame empty(uint32_t id) { return berm_can_frame{id, kLength, {0, 0, 0, 0, 0, 0, 0, 0}}; }

bool is(const berm_can_frame* f, uint32_t id) { return f->id == id && f->length == kLength; }

// Bits start..start+length-1 of the payload, counted from the least significant bit of byte 0.
void put(berm_can_frame& f, int start, int length, uint32_t value) {
  for (int i = 0; i < length; ++i) {
    const int bit = start + i;
    const auto mask = static_cast<uint8_t>(1u << (bit % 8));
    if ((value >> i) & 1u) f.data[bit / 8] = static_cast<uint8_t>(f.data[bit / 8] | mask);
  }
}

// The same, saturated at the field.
void put_saturated(berm_can_frame& f, int start, int length, uint32_t value) {
  const uint32_t most = (1u << length) - 1u;
  put(f, start, length, value < most ? value : most);
}

uint32_t get(const berm_can_frame* f, int start, int length) {
  uint32_t value = 0;
  for (int i = 0; i < length; ++i) {
    const int bit = start + i;
    value |= static_cast<uint32_t>((f->data[bit / 8] >> (bit % 8)) & 1u) << i;
  }
  return value;
}

berm_can_frame encode_joints(uint32_t id, const Scale& scale, const int32_t (&values)[4]) {
  berm_can_frame f = empty(id);
  for (int joint = 0; joint < 4; ++joint) put(f, 16 * kField[joint], 16, to_raw(scale, values[joint]));
  return f;
}

void decode_joints(const berm_can_frame* f, const Scale& scale, int32_t (&values)[4]) {
  for (int joint = 0; joint < 4; ++joint) values[joint] = from_raw(scale, get(f, 16 * kField[joint], 16));
}

bool flag(const berm_can_frame* f, int bit) { return get(f, bit, 1) != 0; }

}  // namespace

extern "C" {

uint32_t berm_can_guard_crc(uint32_t can_id, uint8_t counter, const uint8_t data[8]) {
  uint8_t bytes[13];
  for (int i = 0; i < 4; ++i) bytes[i] = static_cast<uint8_t>(can_id >> (8 * i));
  bytes[4] = counter;
  for (int i = 0; i < 8; ++i) bytes[5 + i] = data[i];
  return berm_crc32(bytes, sizeof bytes);
}

uint32_t berm_can_guard_id(uint32_t can_id) { return (BERM_CAN_GUARD_MACHINE & ~0xFFu) | (can_id & 0xFFu); }

berm_can_frame berm_can_make_guard(const berm_can_frame* guarded, uint8_t counter) {
  const berm_guard guard{BERM_CAN_DATA_ID(guarded->id), counter, berm_can_guard_crc(guarded->id, counter, guarded->data)};
  return berm_encode_guard(berm_can_guard_id(guarded->id), &guard);
}

berm_can_frame berm_encode_front_angle(const berm_front_angle* m) { return encode_joints(BERM_CAN_FRONT_ANGLE, kAngle, m->angle_urad); }
bool berm_decode_front_angle(const berm_can_frame* f, berm_front_angle* m) {
  if (!is(f, BERM_CAN_FRONT_ANGLE)) return false;
  decode_joints(f, kAngle, m->angle_urad);
  return true;
}

berm_can_frame berm_encode_front_velocity(const berm_front_velocity* m) {
  return encode_joints(BERM_CAN_FRONT_ANGULAR_VELOCITY, kVelocity, m->velocity_urad_s);
}
bool berm_decode_front_velocity(const berm_can_frame* f, berm_front_velocity* m) {
  if (!is(f, BERM_CAN_FRONT_ANGULAR_VELOCITY)) return false;
  decode_joints(f, kVelocity, m->velocity_urad_s);
  return true;
}

berm_can_frame berm_encode_velocity_cmd(const berm_velocity_cmd* m) { return encode_joints(BERM_CAN_VELOCITY_CMD_1, kCommand, m->velocity_urad_s); }
bool berm_decode_velocity_cmd(const berm_can_frame* f, berm_velocity_cmd* m) {
  if (!is(f, BERM_CAN_VELOCITY_CMD_1)) return false;
  decode_joints(f, kCommand, m->velocity_urad_s);
  return true;
}

berm_can_frame berm_encode_pressure(const berm_pressure* m) {
  berm_can_frame f = empty(BERM_CAN_PRESSURE_1);
  for (int i = 0; i < 8; ++i) put(f, 8 * i, 8, to_raw(kPressure, m->kpa[i]));
  return f;
}
bool berm_decode_pressure(const berm_can_frame* f, berm_pressure* m) {
  if (!is(f, BERM_CAN_PRESSURE_1)) return false;
  for (int i = 0; i < 8; ++i) m->kpa[i] = from_raw(kPressure, get(f, 8 * i, 8));
  return true;
}

berm_can_frame berm_encode_roll_pitch(const berm_roll_pitch* m) {
  berm_can_frame f = empty(BERM_CAN_ROLL_PITCH);
  put(f, 0, 14, to_raw(kInclination, m->roll_urad));
  put(f, 16, 14, to_raw(kInclination, m->pitch_urad));
  return f;
}
bool berm_decode_roll_pitch(const berm_can_frame* f, berm_roll_pitch* m) {
  if (!is(f, BERM_CAN_ROLL_PITCH)) return false;
  m->roll_urad = from_raw(kInclination, get(f, 0, 14));
  m->pitch_urad = from_raw(kInclination, get(f, 16, 14));
  return true;
}

berm_can_frame berm_encode_machine_state(const berm_machine_state* m) {
  berm_can_frame f = empty(BERM_CAN_MACHINE_STATE);
  put(f, 0, 1, m->lock_command);
  put(f, 6, 1, m->pilot_unlocked);
  put(f, 8, 1, m->system_error);
  put_saturated(f, 9, 3, m->can_errors);
  put(f, 12, 1, m->lock_receiver_error);
  put(f, 13, 1, m->estop_receiver_error);
  put(f, 14, 1, m->switch_error);
  put(f, 16, 8, m->control_state);
  put(f, 24, 8, to_raw(kTemperature, m->oil_temperature_c));
  put(f, 40, 1, m->engine_on);
  put(f, 56, 8, m->alive_counter);
  return f;
}
bool berm_decode_machine_state(const berm_can_frame* f, berm_machine_state* m) {
  if (!is(f, BERM_CAN_MACHINE_STATE)) return false;
  m->lock_command = flag(f, 0);
  m->pilot_unlocked = flag(f, 6);
  m->system_error = flag(f, 8);
  m->can_errors = static_cast<uint8_t>(get(f, 9, 3));
  m->lock_receiver_error = flag(f, 12);
  m->estop_receiver_error = flag(f, 13);
  m->switch_error = flag(f, 14);
  m->control_state = static_cast<uint8_t>(get(f, 16, 8));
  m->oil_temperature_c = static_cast<int16_t>(from_raw(kTemperature, get(f, 24, 8)));
  m->engine_on = flag(f, 40);
  m->alive_counter = static_cast<uint8_t>(get(f, 56, 8));
  return true;
}

berm_can_frame berm_encode_vehicle_azimuth(const berm_vehicle_azimuth* m) {
  berm_can_frame f = empty(BERM_CAN_VEHICLE_AZIMUTH);
  put(f, 0, 16, to_raw(kAngle, m->upper_urad));
  put(f, 16, 16, to_raw(kAngle, m->track_urad));
  return f;
}
bool berm_decode_vehicle_azimuth(const berm_can_frame* f, berm_vehicle_azimuth* m) {
  if (!is(f, BERM_CAN_VEHICLE_AZIMUTH)) return false;
  m->upper_urad = from_raw(kAngle, get(f, 0, 16));
  m->track_urad = from_raw(kAngle, get(f, 16, 16));
  return true;
}

berm_can_frame berm_encode_payload(const berm_payload* m) {
  berm_can_frame f = empty(BERM_CAN_PAYLOAD);
  put(f, 0, 16, m->kg);
  put(f, 16, 1, m->valid);
  return f;
}
bool berm_decode_payload(const berm_can_frame* f, berm_payload* m) {
  if (!is(f, BERM_CAN_PAYLOAD)) return false;
  m->kg = static_cast<uint16_t>(get(f, 0, 16));
  m->valid = flag(f, 16);
  return true;
}

berm_can_frame berm_encode_estop(const berm_estop* m) {
  berm_can_frame f = empty(BERM_CAN_ESTOP_STATUS);
  put(f, 0, 1, m->pressed);
  put(f, 1, 1, m->receiver_ok);
  put(f, 56, 8, m->alive_counter);
  return f;
}
bool berm_decode_estop(const berm_can_frame* f, berm_estop* m) {
  if (!is(f, BERM_CAN_ESTOP_STATUS)) return false;
  m->pressed = flag(f, 0);
  m->receiver_ok = flag(f, 1);
  m->alive_counter = static_cast<uint8_t>(get(f, 56, 8));
  return true;
}

berm_can_frame berm_encode_operator(const berm_operator* m) {
  berm_can_frame f = empty(BERM_CAN_OPERATOR);
  put(f, 0, 1, m->run);
  put(f, 1, 1, m->stop);
  put(f, 2, 1, m->reset);
  put(f, 3, 1, m->relearn);
  put(f, 56, 8, m->alive_counter);
  return f;
}
bool berm_decode_operator(const berm_can_frame* f, berm_operator* m) {
  if (!is(f, BERM_CAN_OPERATOR)) return false;
  m->run = flag(f, 0);
  m->stop = flag(f, 1);
  m->reset = flag(f, 2);
  m->relearn = flag(f, 3);
  m->alive_counter = static_cast<uint8_t>(get(f, 56, 8));
  return true;
}

berm_can_frame berm_encode_spotter(const berm_spotter* m) {
  berm_can_frame f = empty(BERM_CAN_SPOTTER);
  put(f, 0, 1, m->truck_parked);
  put(f, 1, 1, m->truck_leaving);
  put(f, 2, 1, m->stop);
  put(f, 56, 8, m->alive_counter);
  return f;
}
bool berm_decode_spotter(const berm_can_frame* f, berm_spotter* m) {
  if (!is(f, BERM_CAN_SPOTTER)) return false;
  m->truck_parked = flag(f, 0);
  m->truck_leaving = flag(f, 1);
  m->stop = flag(f, 2);
  m->alive_counter = static_cast<uint8_t>(get(f, 56, 8));
  return true;
}

berm_can_frame berm_encode_machine_setting(const berm_machine_setting* m) {
  berm_can_frame f = empty(BERM_CAN_MACHINE_SETTING_CMD);
  put(f, 0, 8, m->engine_rpm_x10);
  put(f, 8, 1, m->eco);
  put(f, 9, 1, m->fast_travel);
  put(f, 11, 1, m->working_notice);
  put_saturated(f, 12, 2, m->led);
  put(f, 14, 2, m->horn);
  put_saturated(f, 28, 4, m->front_signal);
  put(f, 56, 8, m->alive_counter);
  return f;
}
bool berm_decode_machine_setting(const berm_can_frame* f, berm_machine_setting* m) {
  if (!is(f, BERM_CAN_MACHINE_SETTING_CMD)) return false;
  m->engine_rpm_x10 = static_cast<uint8_t>(get(f, 0, 8));
  m->eco = flag(f, 8);
  m->fast_travel = flag(f, 9);
  m->working_notice = flag(f, 11);
  m->led = static_cast<uint8_t>(get(f, 12, 2));
  m->horn = get(f, 14, 2) == 1;
  m->front_signal = static_cast<uint8_t>(get(f, 28, 4));
  m->alive_counter = static_cast<uint8_t>(get(f, 56, 8));
  return true;
}

berm_can_frame berm_encode_heartbeat(const berm_heartbeat* m) {
  berm_can_frame f = empty(BERM_CAN_HEARTBEAT);
  put(f, 0, 1, m->enable);
  put(f, 8, 8, m->stop_category);
  put(f, 16, 8, m->kernel_state);
  put(f, 24, 8, m->stop_reason);
  put(f, 32, 16, m->cycle);
  put(f, 56, 8, m->alive_counter);
  return f;
}
bool berm_decode_heartbeat(const berm_can_frame* f, berm_heartbeat* m) {
  if (!is(f, BERM_CAN_HEARTBEAT)) return false;
  m->enable = flag(f, 0);
  m->stop_category = static_cast<uint8_t>(get(f, 8, 8));
  m->kernel_state = static_cast<uint8_t>(get(f, 16, 8));
  m->stop_reason = static_cast<uint8_t>(get(f, 24, 8));
  m->cycle = static_cast<uint16_t>(get(f, 32, 16));
  m->alive_counter = static_cast<uint8_t>(get(f, 56, 8));
  return true;
}

berm_can_frame berm_encode_pan_cmd(const berm_pan_cmd* m) {
  berm_can_frame f = empty(BERM_CAN_SCANNER_PAN_CMD);
  put(f, 0, 8, m->scanner);
  put(f, 16, 16, to_raw(kAngle, m->goal_urad));
  put(f, 32, 16, to_raw(kRate, m->rate_urad_s));
  return f;
}
bool berm_decode_pan_cmd(const berm_can_frame* f, berm_pan_cmd* m) {
  if (!is(f, BERM_CAN_SCANNER_PAN_CMD)) return false;
  m->scanner = static_cast<uint8_t>(get(f, 0, 8));
  m->goal_urad = from_raw(kAngle, get(f, 16, 16));
  m->rate_urad_s = from_raw(kRate, get(f, 32, 16));
  return true;
}

berm_can_frame berm_encode_sim_clock(const berm_sim_clock* m) {
  berm_can_frame f = empty(BERM_CAN_SIMULATION_CLOCK);
  put(f, 0, 32, m->cycle);
  put(f, 32, 32, m->scan_packets);
  return f;
}
bool berm_decode_sim_clock(const berm_can_frame* f, berm_sim_clock* m) {
  if (!is(f, BERM_CAN_SIMULATION_CLOCK)) return false;
  m->cycle = get(f, 0, 32);
  m->scan_packets = get(f, 32, 32);
  return true;
}

berm_can_frame berm_encode_guard(uint32_t guard_id, const berm_guard* m) {
  berm_can_frame f = empty(guard_id);
  put(f, 0, 8, m->data_id);
  put(f, 8, 8, m->counter);
  put(f, 16, 16, kGuardPadding);
  put(f, 32, 32, m->crc32);
  return f;
}
bool berm_decode_guard(const berm_can_frame* f, berm_guard* m) {
  if ((f->id & ~0xFFu) != (BERM_CAN_GUARD_MACHINE & ~0xFFu) || f->length != kLength) return false;
  if (get(f, 16, 16) != kGuardPadding) return false;
  m->data_id = f->data[0];
  m->counter = f->data[1];
  m->crc32 = get(f, 32, 32);
  return true;
}

}  // extern "C"
