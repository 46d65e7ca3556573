#include "mini_machine.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "config/compile_parameters.hpp"

namespace berm::test {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kSamplesPerTurn = 400;
constexpr std::uint32_t kSamplePeriodNs = 83333;
constexpr int kSamplesPerCycle = 120;
constexpr double kPanRateRadS = 0.7;
constexpr double kRangeMaxM = 50.0;

}  // namespace

berm_parameters demo_parameters() {
  const std::string files = BERM_CONFIG_FILES;
  config::SiteFile site = config::load_site_file(files + "/sites/bench.toml");
  site.ground_zone.clear();  // the miniature machine's ground is level
  return config::compile_parameters(config::load_machine_file(files + "/machines/zx200.toml"), site);
}

std::int32_t urad(double degrees) { return static_cast<std::int32_t>(std::lround(degrees * kPi / 180.0 * 1e6)); }

MiniMachine::MiniMachine(const berm_parameters& parameters)
    : angle_rad{kPi / 2, 50.0 * kPi / 180, -90.0 * kPi / 180, -40.0 * kPi / 180},  // out of the dig zone, bucket high over the ground
      pan_low_rad(-0.75),
      pan_high_rad(0.75),
      parameters_(parameters) {}

void MiniMachine::add_guarded(const berm_can_frame& frame) {
  frames_.push_back(berm_can_make_guard(&frame, ++counter_[BERM_CAN_DATA_ID(frame.id)]));
  frames_.push_back(frame);
}

void MiniMachine::step() {
  ++cycle_;
  move();
  frames_.clear();
  packets_.clear();
  make_frames();
  for (int s = 0; s < 2; ++s) make_packets(s);
}

void MiniMachine::move() {
  constexpr double dt = kCycleUs * 1e-6;
  for (int j = 0; j < 4; ++j) {
    const double change = parameters_.acceleration_max_urad_s2[j] * 1e-6 * 0.9 * dt;
    velocity_rad_s[j] += std::clamp(command_rad_s[j] - velocity_rad_s[j], -change, change);
    angle_rad[j] += velocity_rad_s[j] * dt;
  }
}

// Of each frame of the panel.
bool MiniMachine::switched_on() {
  const bool stands_by = heartbeat_.kernel_state == BERM_STATE_STANDBY;
  const bool latched = heartbeat_.kernel_state == BERM_STATE_FAULT || (heartbeat_.kernel_state == BERM_STATE_STOPPED && heartbeat_.stop_category != 2);
  if (heartbeat_.kernel_state == BERM_STATE_INIT || latched) was_off_ = false;
  const bool on = run_switch && (run_left_on || was_off_);
  if (stands_by) was_off_ = true;
  return on;
}

void MiniMachine::make_frames() {
  if (!joints_silent) {
    berm_front_angle angle{};
    berm_front_velocity velocity{};
    for (int j = 0; j < 4; ++j) {
      angle.angle_urad[j] = static_cast<std::int32_t>(std::lround(angle_rad[j] * 1e6));
      if (angle_sticks[j]) angle.angle_urad[j] = said_urad_[j];
      said_urad_[j] = angle.angle_urad[j];
      velocity.velocity_urad_s[j] = static_cast<std::int32_t>(std::lround(velocity_rad_s[j] * 1e6));
    }
    add_guarded(berm_encode_front_angle(&angle));
    add_guarded(berm_encode_front_velocity(&velocity));
  }
  if (!attitude_silent && cycle_ % 2 == 1) {
    const berm_roll_pitch level{roll_urad, pitch_urad};
    frames_.push_back(berm_encode_roll_pitch(&level));
  }
  if (!azimuth_silent && cycle_ % 10 == 1) {
    const berm_vehicle_azimuth azimuth{0, track_urad};
    frames_.push_back(berm_encode_vehicle_azimuth(&azimuth));
  }
  if (cycle_ % 5 != 1) return;
  berm_machine_state state{};
  state.engine_on = true;
  state.system_error = system_error;
  add_guarded(berm_encode_machine_state(&state));
  const berm_estop estop{estop_pressed, true, 0};
  add_guarded(berm_encode_estop(&estop));
  if (!operator_silent) {
    const berm_operator panel{switched_on(), operator_stop, reset_key, relearn_key, 0};
    add_guarded(berm_encode_operator(&panel));
  }
  if (spotter_present) {
    const berm_spotter spotter{!truck_leaving, truck_leaving, false, 0};
    add_guarded(berm_encode_spotter(&spotter));
  }
}

double MiniMachine::pan_at(double time_s) const {
  const double width = pan_high_rad - pan_low_rad;
  const double way = std::fmod(time_s * kPanRateRadS, 2 * width);
  return pan_low_rad + (way < width ? way : 2 * width - way);
}

double MiniMachine::relief_at(double x, double y) const {
  const double u = x + base_x_m, v = y + base_y_m;
  return relief_m * (std::sin(3.1 * u + 1.3 * v) + std::sin(4.7 * v - 2.3 * u) + std::sin(1.7 * u - 0.9 * v + 2.0)) / 3;
}

double MiniMachine::range_m(int scanner, double pan_rad, double elevation_rad, double swing_rad) const {
  const berm_scanner_mount& mount = parameters_.scanner[scanner];
  const double x = mount.x_mm * 1e-3, y = mount.y_mm * 1e-3, z = mount.z_mm * 1e-3;
  const double head_y = x * std::sin(swing_rad) + y * std::cos(swing_rad);
  const double along_y = std::cos(elevation_rad) * std::sin(pan_rad + swing_rad);
  const double along_z = std::sin(elevation_rad);
  double range = along_z < 0 ? (ground_m - z) / along_z : kRangeMaxM + 1;
  for (int i = 0; relief_m > 0 && along_z < 0 && i < 4; ++i) {  // the ground is nearly level: this settles
    const double head_x = x * std::cos(swing_rad) - y * std::sin(swing_rad), along_x = std::cos(elevation_rad) * std::cos(pan_rad + swing_rad);
    range = (ground_m + relief_at(head_x + range * along_x, head_y + range * along_y) - z) / along_z;
  }
  if (wall.height_m > 0) {
    const double to_wall = (wall.y_m - head_y) / along_y;
    if (to_wall > 0 && to_wall < range && z + to_wall * along_z < wall.height_m) range = to_wall;
  }
  return range <= kRangeMaxM ? range : 0.0;
}

void MiniMachine::make_packets(int scanner) {
  if (scanners_silent) return;
  const double start_s = static_cast<double>(time_us() - kCycleUs) * 1e-6;
  for (int done = 0; done < kSamplesPerCycle;) {
    berm_scan_packet p{};
    const int index = static_cast<int>(sample_[scanner] % kSamplesPerTurn);
    const int count = std::min(kSamplesPerCycle - done, kSamplesPerTurn - index);
    p.scanner = static_cast<std::uint8_t>(scanner);
    p.flags = static_cast<std::uint16_t>((index == 0 ? BERM_SCAN_FLAG_FIRST : 0) | (index + count == kSamplesPerTurn ? BERM_SCAN_FLAG_LAST : 0));
    p.sequence = ++sequence_[scanner];
    p.scanline = static_cast<std::uint32_t>(sample_[scanner] / kSamplesPerTurn);
    p.sample_period_ns = kSamplePeriodNs;
    p.time_us = static_cast<std::uint64_t>(time_us() - kCycleUs + done * static_cast<std::int64_t>(kSamplePeriodNs) / 1000);
    p.first_index = static_cast<std::uint16_t>(index);
    p.samples_per_revolution = kSamplesPerTurn;
    p.count = static_cast<std::uint16_t>(count);
    p.echoes_per_sample = 1;
    p.window_percent = 100;
    const auto pan_of = [&](int i) { return pan_at(start_s + (done + i) * kSamplePeriodNs * 1e-9); };
    p.pan_start_urad = static_cast<std::int32_t>(std::lround(pan_of(0) * 1e6));
    p.pan_end_urad = static_cast<std::int32_t>(std::lround(pan_of(count - 1) * 1e6));
    for (int i = 0; i < count; ++i) {
      const double range = range_m(scanner, pan_of(i), 2 * kPi * (index + i) / kSamplesPerTurn, angle_rad[0]);
      p.range[i][0] = static_cast<std::uint16_t>(std::lround(range * 1e3 / BERM_SCAN_RANGE_LSB_MM));
    }
    packets_.push_back(p);
    sample_[scanner] += static_cast<std::uint64_t>(count);
    done += count;
  }
}

void MiniMachine::obey(const std::vector<berm_can_frame>& frames) {
  for (const berm_can_frame& frame : frames) {
    berm_decode_velocity_cmd(&frame, &velocity_);
    berm_decode_heartbeat(&frame, &heartbeat_);
  }
  for (int j = 0; j < 4; ++j) command_rad_s[j] = heartbeat_.enable ? velocity_.velocity_urad_s[j] * 1e-6 : 0.0;
}

berm_request make_request(std::uint32_t sequence, std::int64_t stamp_us, const std::int32_t (&velocity_urad_s)[4]) {
  berm_request r{};
  r.magic = BERM_CONTRACT_MAGIC;
  r.version = BERM_CONTRACT_VERSION;
  r.phase = BERM_PHASE_WAIT;
  r.sequence = sequence;
  r.stamp_us = stamp_us;
  std::copy(velocity_urad_s, velocity_urad_s + 4, r.joint_velocity_urad_s);
  r.crc32 = berm_crc32(reinterpret_cast<const std::uint8_t*>(&r), offsetof(berm_request, crc32));
  return r;
}

}  // namespace berm::test
