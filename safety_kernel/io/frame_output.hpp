// Frames to the machine: each guarded one behind its guard frame, the heartbeat last.
#pragma once

#include <cstdint>

#include "can/berm_can.h"

namespace berm::kernel {

struct FrameList {
  static constexpr int kCapacity = 16;
  int count = 0;
  berm_can_frame frame[kCapacity];
  void add(const berm_can_frame& f) {
    if (count < kCapacity) frame[count++] = f;
  }
};

// What goes out in one cycle.
struct MachineOrders {
  std::int32_t velocity_urad_s[4];  // zeros: neutral
  berm_pan_cmd pan[2];
  bool horn;
  berm_heartbeat heartbeat;         // its alive counter is filled in here
};

class FrameOutput {
 public:
  // Appends velocity, machine setting (every fifth call), pans, heartbeat.
  void make(const MachineOrders& orders, FrameList& out);

 private:
  static constexpr std::uint32_t kSettingEvery = 5;
  void add_guarded(const berm_can_frame& frame, std::uint8_t& counter, FrameList& out);

  std::uint32_t calls_ = 0;
  std::uint8_t velocity_counter_ = 0;
  std::uint8_t setting_counter_ = 0;
  std::uint8_t heartbeat_counter_ = 0;
};

}  // namespace berm::kernel
