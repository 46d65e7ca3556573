// What the machine, the operator's panel and the spotter send in one cycle, in the order of sending; guarded messages with their guards.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "can/berm_can.h"
#include "plant/machine/guard_receiver.hpp"
#include "plant/machine/plant_profile.hpp"
#include "plant/machine/seeded_noise.hpp"
#include "plant/world/base_pose.hpp"
#include "plant/world/world.hpp"

namespace berm::plant {

struct PanelInput {
  bool run = false, stop = false, reset = false, relearn = false, emergency = false;
};

struct MachineSnapshot {                 // true values
  JointState joints;
  BasePose base;
  double payload_kg = 0.0;
  bool digging = false;                  // soil resists a joint: the weighing is not valid
  EdgeForce edge;
  bool pilot_unlocked = false;
  PanelInput panel;
  bool truck_parked = false, truck_leaving = false;
};

class StateFrames {
 public:
  StateFrames(const PlantProfile& profile, std::uint64_t seed);
  // Frames of this cycle (10 ms each, from 1), without the simulation clock.
  std::vector<berm_can_frame> frames(std::uint64_t cycle, const MachineSnapshot& now);
  // From now on this joint's angle (0 swing, 1 boom, 2 stick, 3 bucket) is said to be what it was, or what it is again.
  void stick_angle(std::size_t joint, bool sticks) { angle_sticks_[joint] = sticks; }
  // From now on the machine says that it has an error of its own, or none.
  void report_error(bool error) { own_error_ = error; }

 private:
  void guarded(std::vector<berm_can_frame>& out, GuardSender& guard, const berm_can_frame& frame);
  void every_cycle(std::vector<berm_can_frame>& out, const MachineSnapshot& now);
  void every_50_ms(std::vector<berm_can_frame>& out, const MachineSnapshot& now);
  void every_100_ms(std::vector<berm_can_frame>& out, const MachineSnapshot& now);

  PlantProfile profile_;
  SeededNoise noise_;
  SeededNoise track_noise_, pressure_noise_;  // streams of their own
  GuardSender angle_guard_, velocity_guard_, machine_guard_, estop_guard_, operator_guard_, spotter_guard_;
  std::uint8_t alive_ = 0;
  std::array<bool, 4> angle_sticks_{};
  bool own_error_ = false;
  std::array<std::int32_t, 4> last_angle_urad_{};
};

}  // namespace berm::plant
