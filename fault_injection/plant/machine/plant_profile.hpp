// The plant's machine profile (profiles/*.toml): true geometry, dynamics, machine controller, sensor noise. SI units, radians.
#pragma once

#include <array>
#include <string>

#include "plant/machine/implement_shape.hpp"

namespace berm::plant {

struct JointConfig {
  double low = 0.0, high = 0.0;         // hard stops
  double velocity_max = 0.0;
  double acceleration = 0.0;            // largest, away from standstill
  double brake = 0.0;                   // deceleration towards zero; not for the swing, which has a torque
  double dead_time = 0.0;               // from a command's arrival to its effect
  double lag = 0.0;                     // first-order time constant of the velocity loop
  double dead_band = 0.0;               // commands below move nothing
  double reversal = 0.0;                // rest before the motion turns round: the spool crosses its dead band
  double ripple = 0.0;                  // relative, slow wander of the speed reached
};

struct InertiaConfig {                  // lumped masses about the swing axis
  double upper = 0.0;                   // kg m2, upper body alone
  double boom_mass = 0.0, boom_radius = 0.0;
  double stick_mass = 0.0, bucket_mass = 0.0;
  OutlinePoint stick_centre{}, bucket_centre{};  // centres of mass in the link frames; the payload's is the bucket's
};

struct CylinderConfig {                 // the moment about the joint's pin that a kPa in either side makes, N m; taken as constant over the range
  double bottom = 0.0, rod = 0.0;
};

struct DynamicsConfig {
  std::array<JointConfig, 4> joint;     // swing, boom, stick, bucket
  InertiaConfig inertia;
  double swing_drive_torque = 0.0, swing_brake_torque = 0.0;  // N m
  double boom_lower_brake_loaded = 0.0; // boom's deceleration when lowering with the reference payload
  double payload_reference = 0.0;       // kg
  std::array<CylinderConfig, 3> cylinder;  // boom, stick, bucket
  double flow_limit = 0.0;              // most of the sum of |v| / v_max that the pumps feed
};

struct ControllerConfig {
  double heartbeat_silence = 0.0;       // s without a valid heartbeat until power is removed
  double command_silence = 0.0;         // s without a valid velocity frame until the command is zero
  double pan_silence = 0.0;             // s without a pan command until the servo stops
};

struct SensorConfig {                   // standard deviations of bounded noise
  double angle = 0.0, velocity = 0.0;   // rad, rad/s
  double payload_relative = 0.0, payload_offset = 0.0;
  double roll_pitch = 0.0;
};

struct PlantProfile {
  std::string name;
  ImplementShape shape;
  DynamicsConfig dynamics;
  ControllerConfig controller;
  SensorConfig sensors;
};

// Throws ConfigError ("FILE: field: reason").
PlantProfile load_plant_profile(const std::string& file);

}  // namespace berm::plant
