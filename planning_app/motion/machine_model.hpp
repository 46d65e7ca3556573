// What the app knows of the machine, in SI units and radians; filled from the machine file (app/machine_loader.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "motion/angles.hpp"

namespace berm::app {

struct JointLimits {
  double low = 0.0, high = 0.0;     // permitted range
  double velocity_max = 0.0;
  double acceleration_max = 0.0;
  double creep_velocity = 0.0;      // the kernel's recovery speed
  double angle_error = 0.0;
  double velocity_error = 0.0;
};

// A convex prism over a link: outline in the link's frame (x along the pin line, z to its left).
struct Prism {
  std::size_t link = 0;             // boom, stick or bucket
  double half_width = 0.0;
  std::vector<std::array<double, 2>> outline;
};

struct ScannerMount {
  double x = 0.0, y = 0.0, z = 0.0; // upper body's frame
  double pan_low = 0.0, pan_high = 0.0;
  double pan_rate_max = 0.0;
};

// Worst-case stop angle: angle[joint][row of reach][column of speed k * velocity_max / (columns - 1)].
struct BrakingTable {
  std::vector<double> reach;        // upper ends of the rows, ascending, m
  std::array<std::vector<std::vector<double>>, joints> angle;
};

struct Cylinder { double bottom = 0.0, rod = 0.0; };  // moment about the joint's pin that a kPa in either side makes, N m

// s without a heartbeat of the kernel, after which the machine brakes by itself (interface_spec/can/CAN.md, IF-CAN-14).
constexpr double heartbeat_silence = 0.05;
// s after its cycle's start in which the kernel sends, or not at all (IF-CAN-22).
constexpr double kernel_sends_within = 0.005;

struct MachineModel {
  // Of one joint in one direction, identified from step responses. Rates in rad/s2, [empty, heaviest payload][reach]; joints that the reach does not
  // matter to have one for all.
  struct StepResponse {
    double dead_time = 0.0, lag = 0.0, stop_lag = 0.0, gain = 1.0;
    std::array<std::vector<double>, 2> speeding, slowing;
  };
  struct TwoWayStep { StepResponse up, down; };
  struct StepResponses {
    double payload_kg = 0.0;
    std::vector<double> reach;        // m, ascending
    std::array<TwoWayStep, joints> joint;
  };

  double boom_pin_x = 0.0, boom_pin_z = 0.0;
  double boom_length = 0.0, stick_length = 0.0, bucket_length = 0.0;
  double own_body_radius = 0.0;
  double bucket_payload_kg = 0.0;       // what the bucket holds, heaped
  std::array<JointLimits, joints> joint;
  std::array<Cylinder, 3> cylinder;     // boom, stick, bucket
  double state_latency = 0.0, command_latency = 0.0;
  double cycle = 0.01;
  BrakingTable braking;
  std::optional<StepResponses> responses;
  std::vector<Prism> parts;
  std::array<ScannerMount, 2> scanner;  // left, right
  double margin = 0.0;                  // the kernel's, on every column
  double fresh = 0.0;                   // the kernel's limit for the age of a cell
  double dig_swing_limit = 0.0;
  double range_min = 0.0, range_max = 0.0; // of a scanner's return that is used, m
  double spurious_range = 0.0;          // m: a return that differs by more from what is beside it is doubted
  double self_margin = 0.0;             // m: returns nearer to the implements are their own
};

}  // namespace berm::app
