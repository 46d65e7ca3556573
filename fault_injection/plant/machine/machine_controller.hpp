// The machine's own controller: what it accepts from the bus, and when it moves. Trusts no frame without its guard, no velocity beyond
// the joints' limits (an all-zero velocity frame means -16 rad/s), and no silence.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "can/berm_can.h"
#include "plant/machine/guard_receiver.hpp"
#include "plant/machine/joint_dynamics.hpp"
#include "plant/machine/plant_profile.hpp"

namespace berm::plant {

struct PanGoal { double goal = 0.0, rate = 0.0; };

class MachineController {
 public:
  explicit MachineController(const PlantProfile& profile);

  // A frame that arrived at time t.
  void receive(const berm_can_frame& frame, double t);
  // The selector in the cab: the joints' speeds by the levers, rad/s, in place of the bus; nullopt: automatic. The kernel has no part in it.
  void select(const std::optional<std::array<double, 4>>& levers) { levers_ = levers; }
  // Decides for the step that begins at t; standstill: all joints are at rest.
  void decide(double t, bool standstill);

  Drive drive() const { return drive_; }
  std::array<double, 4> command() const { return command_; }  // rad/s; zero when silent or braking
  PanGoal pan(std::size_t scanner, double t, double present) const;
  bool pilot_unlocked() const { return pilot_unlocked_; }
  bool horn() const { return horn_; }                          // sounds now
  // From the newest valid heartbeat.
  bool heartbeat_heard() const { return heartbeat_heard_; }
  const berm_heartbeat& heartbeat() const { return heartbeat_; }
  double heartbeat_time() const { return heartbeat_time_; }
  std::uint64_t refused_frames() const;                        // guard wrong, or velocity out of range

 private:
  void take_velocity(const berm_can_frame& frame, double t);
  bool silent(double since, double limit, double t) const;

  PlantProfile profile_;
  GuardReceiver velocity_guard_{BERM_CAN_VELOCITY_CMD_1}, heartbeat_guard_{BERM_CAN_HEARTBEAT}, setting_guard_{BERM_CAN_MACHINE_SETTING_CMD};
  std::array<double, 4> newest_velocity_{}, command_{};
  double velocity_time_ = -1e9, heartbeat_time_ = -1e9;
  std::array<PanGoal, 2> pan_{};
  std::array<double, 2> pan_time_{-1e9, -1e9};
  berm_heartbeat heartbeat_{};
  bool heartbeat_heard_ = false;
  bool horn_ = false;
  bool pilot_unlocked_ = false;
  Drive drive_ = Drive::brake;
  std::optional<std::array<double, 4>> levers_;
  std::uint64_t out_of_range_ = 0;
};

}  // namespace berm::plant
