// A miniature machine for tests of the kernel: joints that follow velocity commands, guarded frames, two scanners over flat ground with an
// optional wall. No soil, no occlusion by its own implements.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "can/berm_can.h"
#include "config/parameter_block.h"
#include "contract/berm_contract.h"
#include "scan/scan_packet.h"

namespace berm::test {

constexpr std::int64_t kCycleUs = 10000;

// The parameter block of the demonstration machine and site.
berm_parameters demo_parameters();

// Degrees to microradians.
std::int32_t urad(double degrees);

// A wall across the plane y = y_mm (base frame), from the ground up; absent when height is 0.
struct Wall {
  double y_m = 0.0;
  double height_m = 0.0;
};

class MiniMachine {
 public:
  explicit MiniMachine(const berm_parameters& parameters);

  // Faults and inputs, changed by the test between cycles.
  bool joints_silent = false;
  bool angle_sticks[4] = {};     // the joint's angle is said to be what it was
  bool scanners_silent = false;
  bool operator_silent = false;
  bool reset_key = false;
  bool relearn_key = false;
  bool run_switch = true;        // the operator lets it run: switches off at the start and after what latched, and on when the kernel has stood by
  bool run_left_on = false;      // or forgets to switch off
  bool operator_stop = false;
  bool estop_pressed = false;
  bool spotter_present = false;  // says that a truck is parked
  bool truck_leaving = false;    // or that it leaves
  bool system_error = false;
  bool attitude_silent = false;  // Roll_Pitch
  bool azimuth_silent = false;   // Vehicle_Azimuth
  std::int32_t roll_urad = 0, pitch_urad = 0, track_urad = 0;
  double ground_m = 0.0;
  double relief_m = 0.0;              // of the ground: waves of this height
  double base_x_m = 0.0, base_y_m = 0.0;  // where the base stands on it
  Wall wall;
  double angle_rad[4];     // swing, boom, stick, bucket
  double velocity_rad_s[4] = {};
  double command_rad_s[4] = {};
  double pan_low_rad, pan_high_rad;  // of the scanners' own sweep, relative to the implements

  // One cycle of 10 ms: motion, frames, packets of the samples taken meanwhile.
  void step();
  // What the kernel sent: velocity command, heartbeat. The machine obeys the command while the heartbeat enables it.
  void obey(const std::vector<berm_can_frame>& frames);

  std::uint32_t cycle() const { return cycle_; }
  std::int64_t time_us() const { return cycle_ * kCycleUs; }
  const std::vector<berm_can_frame>& frames() const { return frames_; }
  const std::vector<berm_scan_packet>& packets() const { return packets_; }
  const berm_heartbeat& heartbeat() const { return heartbeat_; }
  const berm_velocity_cmd& velocity_command() const { return velocity_; }

  // Appends the message behind its guard frame.
  void add_guarded(const berm_can_frame& frame);

 private:
  void move();
  void make_frames();
  bool switched_on();
  void make_packets(int scanner);
  double relief_at(double x, double y) const;  // base frame
  double range_m(int scanner, double pan_rad, double elevation_rad, double swing_rad) const;
  double pan_at(double time_s) const;

  berm_parameters parameters_;
  std::uint32_t cycle_ = 0;
  bool was_off_ = false;         // the run switch, while the kernel stood by
  std::int32_t said_urad_[4] = {};
  std::uint8_t counter_[256] = {};  // by data id
  std::uint32_t sequence_[2] = {};
  std::uint64_t sample_[2] = {};
  std::vector<berm_can_frame> frames_;
  std::vector<berm_scan_packet> packets_;
  berm_heartbeat heartbeat_{};
  berm_velocity_cmd velocity_{};
};

// A request that the kernel accepts.
berm_request make_request(std::uint32_t sequence, std::int64_t stamp_us, const std::int32_t (&velocity_urad_s)[4]);

}  // namespace berm::test
