#include "io/frame_intake.hpp"

namespace berm::kernel {

namespace {

constexpr std::uint32_t kGuardedId[] = {BERM_CAN_FRONT_ANGLE, BERM_CAN_FRONT_ANGULAR_VELOCITY, BERM_CAN_MACHINE_STATE,
                                        BERM_CAN_ESTOP_STATUS, BERM_CAN_OPERATOR, BERM_CAN_SPOTTER};
// What the reach box accepts (core/reach_box.h); the fields of the frames reach further.
constexpr std::int32_t kAngleMaxUrad = 10000000;
constexpr std::int32_t kVelocityMaxUradS = 5000000;

bool within(const std::int32_t (&value)[4], std::int32_t limit) {
  for (const std::int32_t v : value)
    if (v < -limit || v > limit) return false;
  return true;
}

bool without_error(const berm_machine_state& s) {
  return !s.system_error && s.can_errors == 0 && !s.lock_receiver_error && !s.estop_receiver_error && !s.switch_error;
}

bool is_guard(std::uint32_t id) {
  return id == BERM_CAN_GUARD_MACHINE || id == BERM_CAN_GUARD_OPERATOR || id == BERM_CAN_GUARD_SPOTTER;
}

}  // namespace

FrameIntake::FrameIntake(const berm_parameters& parameters) : parameters_(parameters) {
  static_assert(sizeof kGuardedId / sizeof kGuardedId[0] == kMessages, "one id a message");
  for (int m = 0; m < kMessages; ++m) sk_guard_init(&guard_[m], kGuardedId[m]);
  sk_base_init(&base_);
}

void FrameIntake::take(const berm_can_frame& frame, std::int64_t now_us) {
  if (is_guard(frame.id)) {
    take_guard(frame, now_us);
    return;
  }
  for (int m = 0; m < kMessages; ++m) {
    if (frame.id != kGuardedId[m]) continue;
    if (!take_guarded(m, frame, now_us)) ++rejected_;
    return;
  }
  if (!take_plain(frame, now_us)) ++rejected_;
}

void FrameIntake::take_guard(const berm_can_frame& frame, std::int64_t now_us) {
  for (int m = 0; m < kMessages; ++m) {
    if (frame.length < 1 || berm_can_guard_id(kGuardedId[m]) != frame.id || BERM_CAN_DATA_ID(kGuardedId[m]) != frame.data[0]) continue;
    sk_guard_arm(&guard_[m], frame.data, frame.length, now_us);
    if (!guard_[m].armed) ++rejected_;
    return;
  }
  ++rejected_;
}

bool FrameIntake::take_guarded(int message, const berm_can_frame& frame, std::int64_t now_us) {
  // On a copy: a message whose content is refused must not count as heard.
  sk_guard_state guard = guard_[message];
  const std::int32_t result = sk_guard_accept(&guard, frame.data, frame.length, now_us);
  guard_[message].armed = false;
  if (result != SK_FRAME_OK || !decode(message, frame)) return false;
  guard_[message] = guard;
  return true;
}

bool FrameIntake::decode(int message, const berm_can_frame& frame) {
  switch (message) {
    case kAngle: {
      berm_front_angle angle{};
      if (!berm_decode_front_angle(&frame, &angle) || !within(angle.angle_urad, kAngleMaxUrad)) return false;
      picture_.angle = angle;
      return true;
    }
    case kVelocity: {
      berm_front_velocity velocity{};
      if (!berm_decode_front_velocity(&frame, &velocity) || !within(velocity.velocity_urad_s, kVelocityMaxUradS)) return false;
      picture_.velocity = velocity;
      return true;
    }
    case kMachineState: return decode_machine_state(frame);
    case kEstop: return decode_estop(frame);
    case kOperator: return decode_operator(frame);
    case kSpotter: return decode_spotter(frame);
    default: return false;
  }
}

bool FrameIntake::decode_machine_state(const berm_can_frame& frame) {
  if (!berm_decode_machine_state(&frame, &picture_.state)) return false;
  said_.machine_error = said_.machine_error || !without_error(picture_.state);
  return true;
}

bool FrameIntake::decode_estop(const berm_can_frame& frame) {
  if (!berm_decode_estop(&frame, &picture_.estop)) return false;
  said_.estop_pressed = said_.estop_pressed || picture_.estop.pressed;
  said_.machine_error = said_.machine_error || !picture_.estop.receiver_ok;
  return true;
}

bool FrameIntake::decode_operator(const berm_can_frame& frame) {
  if (!berm_decode_operator(&frame, &picture_.panel)) return false;
  said_.operator_stop = said_.operator_stop || picture_.panel.stop;
  return true;
}

bool FrameIntake::decode_spotter(const berm_can_frame& frame) {
  if (!berm_decode_spotter(&frame, &picture_.spotter)) return false;
  said_.spotter_stop = said_.spotter_stop || picture_.spotter.stop;
  said_.truck_leaving = said_.truck_leaving || picture_.spotter.truck_leaving;
  said_.no_truck = said_.no_truck || !picture_.spotter.truck_parked;
  return true;
}

bool FrameIntake::take_plain(const berm_can_frame& frame, std::int64_t now_us) {
  if (frame.id == BERM_CAN_PAYLOAD) {
    berm_payload payload{};
    if (!berm_decode_payload(&frame, &payload)) return false;
    picture_.payload_kg = payload.valid ? payload.kg : -1;
  } else if (frame.id == BERM_CAN_PRESSURE_1) {
    berm_pressure pressure{};
    if (!berm_decode_pressure(&frame, &pressure)) return false;
    for (int c = 0; c < BERM_CYLINDERS; ++c)
      for (int side = 0; side < 2; ++side) picture_.cylinder_kpa[c][side] = pressure.kpa[2 * c + side];
  } else if (frame.id == BERM_CAN_ROLL_PITCH) {
    berm_roll_pitch level{};
    if (!berm_decode_roll_pitch(&frame, &level)) return false;
    sk_base_attitude(&base_, &parameters_, level.roll_urad, level.pitch_urad, now_us);
  } else if (frame.id == BERM_CAN_VEHICLE_AZIMUTH) {
    berm_vehicle_azimuth azimuth{};
    if (!berm_decode_vehicle_azimuth(&frame, &azimuth)) return false;
    sk_base_azimuth(&base_, &parameters_, azimuth.track_urad, now_us);
  }
  return true;
}

bool FrameIntake::state_heard() const { return heard(kAngle) && heard(kVelocity) && heard(kMachineState) && heard(kEstop); }

bool FrameIntake::joints_fresh(std::int64_t now_us) const {
  return sk_guard_fresh(&guard_[kAngle], now_us, parameters_.state_frame_age_us) && sk_guard_fresh(&guard_[kVelocity], now_us, parameters_.state_frame_age_us);
}

bool FrameIntake::machine_fresh(std::int64_t now_us) const {
  return sk_guard_fresh(&guard_[kMachineState], now_us, parameters_.machine_state_age_us) &&
         sk_guard_fresh(&guard_[kEstop], now_us, parameters_.machine_state_age_us);
}

bool FrameIntake::operator_fresh(std::int64_t now_us) const { return sk_guard_fresh(&guard_[kOperator], now_us, parameters_.operator_age_us); }

bool FrameIntake::spotter_fresh(std::int64_t now_us) const { return sk_guard_fresh(&guard_[kSpotter], now_us, parameters_.operator_age_us); }

bool FrameIntake::truck_admitted(std::int64_t now_us) const {
  return spotter_fresh(now_us) && truck_parked() && !truck_leaving();
}

bool FrameIntake::spotter_lost(std::int64_t now_us) const { return heard(kSpotter) && !spotter_fresh(now_us); }

bool FrameIntake::machine_healthy() const { return without_error(picture_.state) && picture_.estop.receiver_ok && !said_.machine_error; }

}  // namespace berm::kernel
