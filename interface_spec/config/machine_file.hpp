// A machine profile as its TOML file has it (CONFIG.md), in SI units and radians.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "config/response_file.hpp"

namespace berm::config {

constexpr std::size_t kJoints = 4;  // swing, boom, stick, bucket
extern const std::array<const char*, kJoints> kJointNames;

struct JointFile {
  double low, high;            // permitted range, rad
  double velocity_max;         // rad/s
  double acceleration_max;     // rad/s2, either direction
  double creep_velocity;       // rad/s, recovery motion
  double angle_error, velocity_error;  // of the measurement, rad and rad/s
};

struct CylinderFile { double bottom, rod; };   // moment about the joint's pin that a kPa in either side makes, N m

struct BrakingFile {
  std::string provenance;
  std::vector<double> reach;                                        // m, ascending: upper end of each row
  std::array<std::vector<std::vector<double>>, kJoints> angle;      // [joint][reach][speed], rad
  std::array<std::vector<std::vector<double>>, kJoints> time;       // s
};

struct PartFile {
  int link;                                   // 1 boom, 2 stick, 3 bucket
  double half_width;                          // m
  std::vector<std::array<double, 2>> outline; // x, z in the link's frame, m; convex, counter-clockwise
};

struct ScannerFile {
  std::array<double, 3> position;             // m, upper body's frame
  double pan_low, pan_high;                   // rad
  double pan_rate_max;                        // rad/s
};

struct LidarFile {                            // VLP-16 on the upper body
  std::array<double, 3> position;             // m, upper body's frame
  double roll, pitch, yaw;                    // rad: turned by yaw, then pitch (front down), then roll (left up)
};

struct KernelFile {  // seconds, metres, radians
  double cycle, margin, fresh, generation, dig_swing_limit, scanner_silent, spurious_range, range_min, range_max, self_margin, request_age, request_hold,
      request_silent, state_frame_age, machine_state_age, operator_age, standstill_speed, standstill,
      base_tilt, base_tilt_hard, base_azimuth, base_frame_age;
};

struct TailFile {
  bool watched;                               // a sensor sees the ground round it
  double radius, half_width;                  // m, from the swing axis, about the swing plane
  double underside, top;                      // m, above the ground
  double clearance;                           // m, beyond tail and own body
  double fresh;                               // s
};

struct WorkspaceFile {
  bool watched;                               // what rises in the safety region stops the machine
  double radius;                              // m, of the safety region about the swing axis
  double rise, neighbour, slope;              // m
  double wait, period, dwell, learn;          // s
  double learn_speed;                         // share of the largest speeds, while the ground is learned
  double lidar_wait, lidar_period;            // s, of what the lidars see
  int foreign;                                // voxels of free space with something in them that are an intruder; 0: not kept
  bool follows;                               // the map that is compared with follows what is seen
  bool histogram;                             // a histogram of heights per cell is compared with, not one height
  int separation;                             // BERM_SEPARATION_*
  double approach_speed, intrusion_distance;  // K, m/s, and C, m, of ISO 13855
};

struct SightFile {
  double blind;                               // share of a strip's rays that must be blind
  double dust_slow, dust_stop;                // shares of returns with more than one echo
  double dust_speed;                          // share of the largest speeds
  double dust_dwell;                          // s
};

struct MachineFile {
  std::string name;
  double boom_pin_x, boom_pin_z, boom, stick, bucket, own_body_radius;  // m
  std::array<JointFile, kJoints> joint;
  std::array<CylinderFile, kJoints - 1> cylinder;  // boom, stick, bucket
  double bucket_payload;                  // of a heaped bucket, kg
  double state_latency, command_latency;  // s
  BrakingFile braking;
  std::optional<ResponseFile> response;   // none: never identified
  std::vector<PartFile> part;
  std::array<ScannerFile, 2> scanner;     // left, right
  std::vector<LidarFile> lidar;
  TailFile tail;
  WorkspaceFile workspace;
  SightFile sight;
  KernelFile kernel;
};

// Throws ConfigError (strict_table.hpp) with one line: file, field, limit.
MachineFile load_machine_file(const std::string& path);

}  // namespace berm::config
