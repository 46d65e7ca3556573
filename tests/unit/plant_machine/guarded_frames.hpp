// What the kernel would send: frames with their guards.
#pragma once

#include <array>
#include <vector>

#include "plant/machine/guard_receiver.hpp"
#include "plant/machine/machine_controller.hpp"

namespace berm::plant::testing {

class KernelSide {
 public:
  explicit KernelSide(MachineController& controller) : controller_(controller) {}

  void heartbeat(double t, bool enable, std::uint8_t category = 255) {
    const berm_heartbeat m{enable, category, 2, 0, ++cycle_, 0};
    send(t, heartbeat_guard_, berm_encode_heartbeat(&m));
  }
  void velocity(double t, const std::array<double, 4>& rad_s) {
    berm_velocity_cmd m{};
    for (std::size_t j = 0; j < 4; ++j) m.velocity_urad_s[j] = static_cast<std::int32_t>(rad_s[j] * 1e6);
    send(t, velocity_guard_, berm_encode_velocity_cmd(&m));
  }
  void zero_frame(double t) {  // guarded as it should be, data all zero
    berm_can_frame frame{BERM_CAN_VELOCITY_CMD_1, 8, {}};
    send(t, velocity_guard_, frame);
  }
  void setting(double t, bool horn) {
    berm_machine_setting m{};
    m.horn = horn;
    send(t, setting_guard_, berm_encode_machine_setting(&m));
  }
  void send(double t, GuardSender& guard, const berm_can_frame& frame) {
    controller_.receive(guard.guard_for(frame), t);
    controller_.receive(frame, t);
  }
  GuardSender& velocity_guard() { return velocity_guard_; }

 private:
  MachineController& controller_;
  GuardSender heartbeat_guard_, velocity_guard_, setting_guard_;
  std::uint16_t cycle_ = 0;
};

}  // namespace berm::plant::testing
