#include "io/frame_output.hpp"

namespace berm::kernel {

namespace {
constexpr std::uint8_t kEngineRpmX10 = 180;  // 1800 rpm: working speed
constexpr std::uint8_t kFrontSignalVelocity = 2;
}  // namespace

void FrameOutput::add_guarded(const berm_can_frame& frame, std::uint8_t& counter, FrameList& out) {
  ++counter;
  out.add(berm_can_make_guard(&frame, counter));
  out.add(frame);
}

void FrameOutput::make(const MachineOrders& orders, FrameList& out) {
  berm_velocity_cmd velocity{};
  for (int j = 0; j < 4; ++j) velocity.velocity_urad_s[j] = orders.velocity_urad_s[j];
  add_guarded(berm_encode_velocity_cmd(&velocity), velocity_counter_, out);
  if (calls_ % kSettingEvery == 0) {
    berm_machine_setting setting{};
    setting.engine_rpm_x10 = kEngineRpmX10;
    setting.working_notice = true;
    setting.horn = orders.horn;
    setting.front_signal = kFrontSignalVelocity;
    setting.alive_counter = static_cast<std::uint8_t>(setting_counter_ + 1);
    add_guarded(berm_encode_machine_setting(&setting), setting_counter_, out);
  }
  ++calls_;
  for (const berm_pan_cmd& pan : orders.pan) out.add(berm_encode_pan_cmd(&pan));
  berm_heartbeat heartbeat = orders.heartbeat;
  heartbeat.alive_counter = static_cast<std::uint8_t>(heartbeat_counter_ + 1);
  add_guarded(berm_encode_heartbeat(&heartbeat), heartbeat_counter_, out);
}

}  // namespace berm::kernel
