#include "plant/machine/machine_controller.hpp"

#include <cmath>

namespace berm::plant {

namespace {

constexpr double kMicro = 1e-6;
constexpr double kVelocityTolerance = 0.001;  // rad/s; two steps of the frame's resolution
constexpr double kTimeTolerance = 1e-6;       // s; times are multiples of the cycle in floating point

}  // namespace

MachineController::MachineController(const PlantProfile& profile) : profile_(profile) {}

bool MachineController::silent(double since, double limit, double t) const { return t - since > limit + kTimeTolerance; }

void MachineController::take_velocity(const berm_can_frame& frame, double t) {
  berm_velocity_cmd message;
  if (!berm_decode_velocity_cmd(&frame, &message)) return;
  std::array<double, 4> velocity{};
  for (std::size_t j = 0; j < 4; ++j) {
    velocity[j] = message.velocity_urad_s[j] * kMicro;
    if (std::abs(velocity[j]) > profile_.dynamics.joint[j].velocity_max + kVelocityTolerance) {
      ++out_of_range_;
      return;
    }
  }
  newest_velocity_ = velocity;
  velocity_time_ = t;
}

void MachineController::receive(const berm_can_frame& frame, double t) {
  if (velocity_guard_.accept(frame, t)) take_velocity(frame, t);
  if (heartbeat_guard_.accept(frame, t) && berm_decode_heartbeat(&frame, &heartbeat_)) {
    heartbeat_heard_ = true;
    heartbeat_time_ = t;
  }
  if (setting_guard_.accept(frame, t)) {
    berm_machine_setting setting;
    if (berm_decode_machine_setting(&frame, &setting)) {
      horn_ = setting.horn;
    }
  }
  berm_pan_cmd pan;
  if (frame.id == BERM_CAN_SCANNER_PAN_CMD && berm_decode_pan_cmd(&frame, &pan) && pan.scanner < pan_.size()) {
    pan_[pan.scanner] = {pan.goal_urad * kMicro, pan.rate_urad_s * kMicro};
    pan_time_[pan.scanner] = t;
  }
}

void MachineController::decide(double t, bool standstill) {
  const bool heard = heartbeat_heard_ && !silent(heartbeat_time_, profile_.controller.heartbeat_silence, t);
  const bool enabled = heard && heartbeat_.enable;
  drive_ = enabled ? Drive::obey : Drive::brake;
  if (enabled) {
    pilot_unlocked_ = true;
  } else if (!heard || heartbeat_.stop_category == 0 || standstill) {
    pilot_unlocked_ = false;  // category 1 keeps the pilot pressure until standstill
  }
  const bool fresh = !silent(velocity_time_, profile_.controller.command_silence, t);
  command_ = enabled && fresh ? newest_velocity_ : std::array<double, 4>{};
  if (levers_) {
    drive_ = Drive::obey;
    command_ = *levers_;
  }
}

PanGoal MachineController::pan(std::size_t scanner, double t, double present) const {
  if (silent(pan_time_[scanner], profile_.controller.pan_silence, t)) return {present, 0.0};
  return pan_[scanner];
}

std::uint64_t MachineController::refused_frames() const {
  return velocity_guard_.refused() + heartbeat_guard_.refused() + setting_guard_.refused() + out_of_range_;
}

}  // namespace berm::plant
