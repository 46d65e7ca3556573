#include "in_process/supervisor.hpp"

#include <algorithm>
#include <cstring>

#include "io/cycle.hpp"

namespace berm::in_process {

namespace {

constexpr std::int64_t cycle_us = 10000;

class Kernel final : public Supervisor {
 public:
  explicit Kernel(const berm_parameters& parameters)
      : parameters_(parameters), cycle_(std::make_unique<kernel::Cycle>(parameters_, false)), in_(std::make_unique<kernel::CycleInputs>()),
        out_(std::make_unique<kernel::CycleOutputs>()) {
    in_->app_connected = true;
    in_->app_connections = 1;
  }

  const std::vector<berm_can_frame>& step(std::uint64_t cycle, const Arrived& arrived, const berm_request* request) override {
    in_->clear();
    in_->cycle = cycle;
    in_->now_us = static_cast<std::int64_t>(cycle) * cycle_us;
    for (const auto& frame : arrived.frames)
      if (in_->frame_count < kernel::CycleInputs::kFrames) in_->frame[in_->frame_count++] = frame;
    for (const auto& packet : arrived.scans) {
      std::uint8_t bytes[BERM_SCAN_PACKET_MAX_BYTES];
      const std::size_t n = berm_scan_encode(&packet, bytes);
      if (in_->packet_count < kernel::CycleInputs::kPackets && berm_scan_decode(bytes, n, &in_->packet[in_->packet_count]) == BERM_SCAN_OK)
        ++in_->packet_count;
    }
    for (const auto& packet : arrived.lidars) in_->take_lidar(packet.lidar, packet.bytes.data(), packet.bytes.size());
    if (request != nullptr) std::memcpy(in_->request, request, sizeof *request);
    cycle_->step(*in_, *out_);
    sent_.assign(out_->frames.frame, out_->frames.frame + out_->frames.count);
    return sent_;
  }
  const berm_state& state() const override { return out_->state; }
  bool needs_scans() const override { return true; }
  const kernel::Cycle* cycle() const override { return cycle_.get(); }

 private:
  berm_parameters parameters_;
  std::unique_ptr<kernel::Cycle> cycle_;
  std::unique_ptr<kernel::CycleInputs> in_;
  std::unique_ptr<kernel::CycleOutputs> out_;
  std::vector<berm_can_frame> sent_;
};

class Obedient final : public Supervisor {
 public:
  const std::vector<berm_can_frame>& step(std::uint64_t cycle, const Arrived& arrived, const berm_request* request) override {
    state_.cycle = cycle;
    state_.time_us = static_cast<std::int64_t>(cycle) * cycle_us;
    state_.kernel_state = BERM_STATE_RUN;
    for (const auto& frame : arrived.frames) {
      berm_front_angle angle{};
      berm_front_velocity velocity{};
      if (berm_decode_front_angle(&frame, &angle)) std::copy(angle.angle_urad, angle.angle_urad + 4, state_.joint_angle_urad);
      if (berm_decode_front_velocity(&frame, &velocity))
        std::copy(velocity.velocity_urad_s, velocity.velocity_urad_s + 4, state_.joint_velocity_urad_s);
    }
    for (const auto& packet : arrived.scans) state_.pan_angle_urad[packet.scanner] = packet.pan_end_urad;
    berm_velocity_cmd command{};
    if (request != nullptr) std::copy(request->joint_velocity_urad_s, request->joint_velocity_urad_s + 4, command.velocity_urad_s);
    std::copy(command.velocity_urad_s, command.velocity_urad_s + 4, state_.commanded_urad_s);
    sent_.clear();
    add(berm_encode_velocity_cmd(&command), velocity_counter_);
    for (std::uint8_t i = 0; i < 2 && request != nullptr; ++i) {
      const berm_pan_cmd pan{i, request->pan_goal_urad[i], request->pan_rate_urad_s[i]};
      sent_.push_back(berm_encode_pan_cmd(&pan));
    }
    berm_heartbeat heartbeat{};
    heartbeat.enable = true;
    heartbeat.stop_category = 255;
    heartbeat.kernel_state = BERM_STATE_RUN;
    heartbeat.alive_counter = static_cast<std::uint8_t>(heartbeat_counter_ + 1);
    add(berm_encode_heartbeat(&heartbeat), heartbeat_counter_);
    return sent_;
  }
  const berm_state& state() const override { return state_; }
  bool needs_scans() const override { return false; }

 private:
  void add(const berm_can_frame& frame, std::uint8_t& counter) {
    ++counter;
    sent_.push_back(berm_can_make_guard(&frame, counter));
    sent_.push_back(frame);
  }

  berm_state state_{};
  std::vector<berm_can_frame> sent_;
  std::uint8_t velocity_counter_ = 0, heartbeat_counter_ = 0;
};

}  // namespace

std::unique_ptr<Supervisor> make_kernel(const berm_parameters& parameters) { return std::make_unique<Kernel>(parameters); }
std::unique_ptr<Supervisor> make_obedient() { return std::make_unique<Obedient>(); }

}  // namespace berm::in_process
