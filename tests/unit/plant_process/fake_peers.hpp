// Kernel and app of a lockstep run, played by one thread: answers every clock frame with a velocity, a heartbeat and a tick.
#pragma once

#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>

#include "can/can_transport.hpp"
#include "plant/machine/guard_receiver.hpp"

namespace berm::plant::testing {

struct Answer {
  bool enable = true;
  std::array<std::int32_t, 4> velocity_urad_s{};
  bool finished = false;
  std::uint8_t stop_reason = 0;                // that the heartbeat tells
  bool kernel_dies = false, app_dies = false;  // after this answer, respectively instead of it
};

inline std::string test_can_address() { return fmt::format("udp:239.255.66.{}:{}", 1 + getpid() % 250, 30000 + getpid() % 20000); }

class FakePeers {
 public:
  FakePeers(const std::string& address, std::function<Answer(std::uint32_t cycle)> policy) : policy_(std::move(policy)) {
    const std::string error = bus_.open(address);
    if (!error.empty()) throw std::runtime_error(error);
    int tick[2], life[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, tick) != 0 || pipe(life) != 0) throw std::runtime_error("descriptors");
    app_ = tick[0], tick_fd = tick[1], kernel_fd = life[0], life_ = life[1];
    thread_ = std::thread([this] { serve(); });
  }
  ~FakePeers() {
    end_ = true;
    thread_.join();
    for (const int fd : {app_, life_, tick_fd, kernel_fd}) {
      if (fd >= 0) close(fd);
    }
  }
  int tick_fd = -1, kernel_fd = -1;

 private:
  void serve() {
    while (!end_) {
      berm_can_frame frame;
      berm_sim_clock clock;
      if (!bus_.receive(frame, 20) || !berm_decode_sim_clock(&frame, &clock)) continue;
      const Answer a = policy_(clock.cycle);
      if (life_ >= 0) answer_as_kernel(a, clock.cycle);
      if (a.kernel_dies) shut(life_);
      if (a.app_dies) shut(app_);
      if (app_ >= 0 && life_ >= 0) {
        const struct { std::uint64_t cycle; std::uint32_t flags, zero; } tick{clock.cycle, a.finished ? 1u : 0u, 0};
        if (::send(app_, &tick, sizeof tick, MSG_NOSIGNAL) < 0) end_ = true;
      }
    }
  }
  void answer_as_kernel(const Answer& a, std::uint32_t cycle) {
    berm_velocity_cmd velocity{};
    for (std::size_t j = 0; j < 4; ++j) velocity.velocity_urad_s[j] = a.velocity_urad_s[j];
    const berm_heartbeat heartbeat{a.enable, static_cast<std::uint8_t>(a.enable ? 255 : 1), static_cast<std::uint8_t>(a.enable ? 2 : 4), a.stop_reason,
                                   static_cast<std::uint16_t>(cycle), 0};
    for (auto& [guard, frame] : {std::pair<GuardSender*, berm_can_frame>{&velocity_guard_, berm_encode_velocity_cmd(&velocity)},
                                 std::pair<GuardSender*, berm_can_frame>{&heartbeat_guard_, berm_encode_heartbeat(&heartbeat)}}) {
      bus_.send(guard->guard_for(frame));
      bus_.send(frame);
    }
  }
  static void shut(int& fd) {
    if (fd >= 0) close(fd);
    fd = -1;
  }

  can::Transport bus_;
  std::function<Answer(std::uint32_t)> policy_;
  GuardSender velocity_guard_, heartbeat_guard_;
  int app_ = -1, life_ = -1;
  std::atomic<bool> end_{false};
  std::thread thread_;
};

}  // namespace berm::plant::testing
