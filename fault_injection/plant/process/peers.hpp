// The other processes of a run as the plant sees them: the kernel on the CAN bus and by its lifeline pipe, the app by its tick socket.
// In lockstep the plant waits for both; a peer that answers nothing for 5 s of wall time is absent and is not waited for until heard again;
// one whose descriptor hangs up is gone at once.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "can/can_transport.hpp"

namespace berm::plant {

enum class PeerState { unused, present, absent, gone };

class Peers {
 public:
  // Descriptors may be -1: no lifeline, no app. on_frame takes each frame of the kernel as it arrives.
  Peers(can::Transport& bus, int kernel_fd, int tick_fd, std::function<void(const berm_can_frame&)> on_frame);

  // Takes all that has arrived; never waits.
  void drain();
  // Drains, then waits for the kernel's heartbeat of this cycle and for the app's tick of it. Returns early when stop_fd is readable.
  void wait_for(std::uint64_t cycle, int stop_fd);

  PeerState kernel() const { return kernel_; }
  PeerState app() const { return app_; }
  bool app_finished() const { return finished_; }

 private:
  bool kernel_answered(std::uint64_t cycle) const;
  bool app_answered(std::uint64_t cycle) const;
  void take_frames();
  void take_ticks();
  void look_at_lifeline();

  can::Transport& bus_;
  int kernel_fd_, tick_fd_;
  std::function<void(const berm_can_frame&)> on_frame_;
  PeerState kernel_ = PeerState::present, app_;
  std::optional<std::uint16_t> heartbeat_cycle_;   // of the newest heartbeat, whatever its guard: for keeping step, not for moving
  std::optional<std::uint64_t> tick_cycle_;
  bool finished_ = false;
};

}  // namespace berm::plant
