#include "plant/machine/state_frames.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plant/machine/cylinder_pressures.hpp"

namespace berm::plant {

namespace {

constexpr double kReturnPressure = 500.0;  // kPa in the swing motor
constexpr double kPressureNoise = 0.01;    // of the reading

std::int32_t micro(double x) { return static_cast<std::int32_t>(std::lround(x * 1e6)); }

}  // namespace

StateFrames::StateFrames(const PlantProfile& profile, std::uint64_t seed) : profile_(profile), noise_(seed, 12), track_noise_(seed, 13), pressure_noise_(seed, 14) {}

void StateFrames::guarded(std::vector<berm_can_frame>& out, GuardSender& guard, const berm_can_frame& frame) {
  out.push_back(guard.guard_for(frame));
  out.push_back(frame);
}

void StateFrames::every_cycle(std::vector<berm_can_frame>& out, const MachineSnapshot& now) {
  berm_front_angle angle{};
  berm_front_velocity velocity{};
  for (std::size_t j = 0; j < 4; ++j) {
    angle.angle_urad[j] = micro(now.joints.angle[j] + noise_.bounded(profile_.sensors.angle));
    if (angle_sticks_[j]) angle.angle_urad[j] = last_angle_urad_[j];
    last_angle_urad_[j] = angle.angle_urad[j];
    velocity.velocity_urad_s[j] = micro(now.joints.velocity[j] + noise_.bounded(profile_.sensors.velocity));
  }
  guarded(out, angle_guard_, berm_encode_front_angle(&angle));
  guarded(out, velocity_guard_, berm_encode_front_velocity(&velocity));
  berm_pressure pressure{};
  for (std::int32_t& kpa : pressure.kpa) kpa = static_cast<std::int32_t>(kReturnPressure);
  const auto kilopascal = [](SeededNoise& noise, double true_kpa) { return static_cast<std::int32_t>(std::lround(true_kpa * (1.0 + noise.bounded(kPressureNoise)))); };
  const std::array<SidePressures, 3> sides = cylinder_pressures(profile_.dynamics, profile_.shape, now.joints, now.payload_kg, now.edge);
  for (std::size_t c = 0; c < sides.size(); ++c) {
    pressure.kpa[2 * c] = kilopascal(c == 0 ? noise_ : pressure_noise_, sides[c].bottom_kpa);
    pressure.kpa[2 * c + 1] = kilopascal(pressure_noise_, sides[c].rod_kpa);
  }
  out.push_back(berm_encode_pressure(&pressure));
}

void StateFrames::every_50_ms(std::vector<berm_can_frame>& out, const MachineSnapshot& now) {
  berm_machine_state machine{};
  machine.pilot_unlocked = now.pilot_unlocked;
  machine.lock_command = !now.pilot_unlocked;
  machine.system_error = own_error_;
  machine.oil_temperature_c = 50;
  machine.engine_on = true;
  machine.alive_counter = alive_;
  guarded(out, machine_guard_, berm_encode_machine_state(&machine));
  const berm_estop estop{now.panel.emergency, true, alive_};
  guarded(out, estop_guard_, berm_encode_estop(&estop));
  const berm_operator panel{now.panel.run, now.panel.stop, now.panel.reset, now.panel.relearn, alive_};
  guarded(out, operator_guard_, berm_encode_operator(&panel));
  const berm_spotter spotter{now.truck_parked, now.truck_leaving, false, alive_};
  guarded(out, spotter_guard_, berm_encode_spotter(&spotter));
  ++alive_;
}

void StateFrames::every_100_ms(std::vector<berm_can_frame>& out, const MachineSnapshot& now) {
  const double upper = std::remainder(now.joints.angle[0] + now.base.yaw, 2.0 * std::numbers::pi);
  const berm_vehicle_azimuth azimuth{micro(upper + noise_.bounded(profile_.sensors.angle)), micro(now.base.yaw + track_noise_.bounded(profile_.sensors.angle))};
  out.push_back(berm_encode_vehicle_azimuth(&azimuth));
  const double weighed = now.payload_kg * (1.0 + noise_.bounded(profile_.sensors.payload_relative)) + noise_.bounded(profile_.sensors.payload_offset);
  const berm_payload payload{static_cast<std::uint16_t>(std::lround(std::clamp(weighed, 0.0, 60000.0))), !now.digging};
  out.push_back(berm_encode_payload(&payload));
}

std::vector<berm_can_frame> StateFrames::frames(std::uint64_t cycle, const MachineSnapshot& now) {
  std::vector<berm_can_frame> out;
  every_cycle(out, now);
  if (cycle % 2 == 1) {
    const berm_roll_pitch level{micro(now.base.roll + noise_.bounded(profile_.sensors.roll_pitch)),
                                micro(now.base.pitch + noise_.bounded(profile_.sensors.roll_pitch))};
    out.push_back(berm_encode_roll_pitch(&level));
  }
  if (cycle % 5 == 1) every_50_ms(out, now);
  if (cycle % 10 == 1) every_100_ms(out, now);
  return out;
}

}  // namespace berm::plant
