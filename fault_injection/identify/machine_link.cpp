#include "identify/machine_link.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace berm::identify {

const std::array<const char*, kManners> kMannerNames{"zero_command", "category_1", "category_0", "silence"};

namespace {

constexpr double kMicro = 1e-6;
constexpr double kCycle_s = 0.01;
constexpr int kPatience_ms = 5000, kFirstPatience_ms = 20000, kWatch_ms = 100;
constexpr std::uint32_t kMachineSource = 0xE8;
constexpr std::uint8_t kNoStop = 255, kRunState = 2, kStoppingState = 3;  // as the contract numbers them; the machine does not look at the state

}  // namespace

MachineLink::MachineLink(const std::string& address) : address_(address) {
  const std::string refused = bus_.open(address);
  if (!refused.empty()) throw std::runtime_error(refused);
}

bool MachineLink::heard(int milliseconds) const {
  pollfd wait{bus_.fd(), POLLIN, 0};
  return poll(&wait, 1, milliseconds) == 1;
}

Reading MachineLink::first() { return next(); }

Reading MachineLink::drive(const Joints& velocity) {
  answer(velocity, true, kNoStop, true);
  return next();
}

Reading MachineLink::stop(StopManner manner) {
  switch (manner) {
    case StopManner::zero_command: answer(Joints{}, true, kNoStop, true); break;
    case StopManner::category_1: answer(Joints{}, false, 1, true); break;
    case StopManner::category_0: answer(Joints{}, false, 0, true); break;
    case StopManner::silence: answer(std::nullopt, false, 0, false); break;
  }
  return next();
}

std::optional<double> MachineLink::weighed_kg() const {
  if (weighed_ == 0) return std::nullopt;
  return weighed_sum_ / static_cast<double>(weighed_);
}

void MachineLink::send_guarded(const berm_can_frame& frame, std::uint8_t& counter) {
  bus_.send(berm_can_make_guard(&frame, counter++));
  bus_.send(frame);
}

void MachineLink::answer(const std::optional<Joints>& velocity, bool enable, std::uint8_t category, bool valid) {
  if (velocity) {
    berm_velocity_cmd command{};
    for (std::size_t j = 0; j < 4; ++j) command.velocity_urad_s[j] = static_cast<std::int32_t>(std::lround((*velocity)[j] / kMicro));
    send_guarded(berm_encode_velocity_cmd(&command), velocity_counter_);
  }
  berm_heartbeat heartbeat{};
  heartbeat.enable = enable;
  heartbeat.stop_category = category;
  heartbeat.kernel_state = enable ? kRunState : kStoppingState;
  heartbeat.cycle = static_cast<std::uint16_t>(cycle_);
  heartbeat.alive_counter = alive_++;
  const berm_can_frame frame = berm_encode_heartbeat(&heartbeat);
  if (valid) {
    send_guarded(frame, heartbeat_counter_);
  } else {
    bus_.send(frame);
  }
}

bool MachineLink::guarded(const berm_can_frame& frame) {
  const auto guard = std::exchange(guard_, std::nullopt);
  const std::uint8_t data_id = BERM_CAN_DATA_ID(frame.id);
  if (!guard || guard->data_id != data_id || frame.length != 8 || berm_can_guard_crc(frame.id, guard->counter, frame.data) != guard->crc32) return false;
  auto& last = last_counter_[data_id];
  const auto ahead = static_cast<std::uint8_t>(guard->counter - last.value_or(static_cast<std::uint8_t>(guard->counter - 1)));
  last = guard->counter;
  return ahead >= 1 && ahead <= 3;
}

void MachineLink::take(const berm_can_frame& frame) {
  if ((frame.id & 0xFFu) != kMachineSource) return;  // own frames come back on a multicast bus; panel and spotter do not matter here
  berm_guard guard;
  if (frame.id == BERM_CAN_GUARD_MACHINE) {
    guard_.reset();
    if (berm_decode_guard(&frame, &guard)) guard_ = guard;
    return;
  }
  berm_front_angle angle;
  berm_front_velocity velocity;
  berm_payload payload;
  const auto joints = [](const std::int32_t(&micro)[4]) {
    Joints out{};
    for (std::size_t j = 0; j < 4; ++j) out[j] = micro[j] * kMicro;
    return out;
  };
  if (berm_decode_front_angle(&frame, &angle)) {
    if (guarded(frame)) angle_ = joints(angle.angle_urad);
  } else if (berm_decode_front_velocity(&frame, &velocity)) {
    if (guarded(frame)) velocity_ = joints(velocity.velocity_urad_s);
  } else if (berm_decode_payload(&frame, &payload) && payload.valid) {
    weighed_sum_ += payload.kg;
    ++weighed_;
  }
}

Reading MachineLink::next() {
  angle_.reset();
  velocity_.reset();
  const int patience = cycle_ == 0 ? kFirstPatience_ms : kPatience_ms;
  const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(patience);
  for (;;) {
    berm_can_frame frame;
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - std::chrono::steady_clock::now()).count();
    if (left <= 0) throw std::runtime_error(fmt::format("{}: the machine is silent for {} s after cycle {}", address_, patience / 1000, cycle_));
    if (!bus_.receive(frame, std::min(static_cast<int>(left), kWatch_ms))) {
      if (while_silent_) while_silent_();
      continue;
    }
    berm_sim_clock clock;
    if (!berm_decode_sim_clock(&frame, &clock)) {
      take(frame);
      continue;
    }
    cycle_ = clock.cycle;
    const double now = clock.cycle * kCycle_s;
    if (!angle_ || !velocity_) throw std::runtime_error(fmt::format("{}: no valid state frame in cycle {}", address_, cycle_));
    if (last_state_s_) largest_gap_s_ = std::max(largest_gap_s_, now - *last_state_s_);
    last_state_s_ = now;
    return {now, *angle_, *velocity_};
  }
}

}  // namespace berm::identify
