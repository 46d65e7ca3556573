// The other processes of a run as the plant sees them: the kernel on the CAN bus and by its lifeline pipe, the app by its tick socket, the
// journal's writer by its pace socket. In lockstep the plant waits for kernel and app, and for the writer when it is so far behind that the
// kernel's ring could overflow; a peer that answers nothing for 5 s of wall time is absent and is not waited for until heard again;
// one whose descriptor hangs up is gone at once. Without a kernel that ever answered there is no run.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "can/can_transport.hpp"

namespace berm::plant {

enum class PeerState { unused, present, absent, gone };

class Peers {
 public:
  struct Descriptors {  // -1: no such peer
    int kernel = -1;    // read end of its lifeline
    int tick = -1;      // the app's ticks
    int journal = -1;   // the cycles that the journal's writer has taken
    int silence_s = 5;  // of wall clock: who was heard before and says nothing for so long is absent
    int first_contact_s = 120;  // for who was never heard: it may still be starting, on a computer that has other things to do
  };
  // Cycles that the writer may be behind: with four lidars a cycle is 37 kB of journal, so this is a quarter of the kernel's ring.
  static constexpr std::uint64_t kUnreadMost = 100;

  // on_frame takes each frame of the kernel as it arrives.
  Peers(can::Transport& bus, const Descriptors& descriptors, std::function<void(const berm_can_frame&)> on_frame);

  // Takes all that has arrived; never waits.
  void drain();
  // Drains, then waits for the kernel's heartbeat of this cycle, for the app's tick of it, and for the journal's writer to be no more than
  // kUnreadMost cycles behind. Returns early when stop_fd is readable. Throws std::runtime_error when the kernel was never heard and its time is up.
  void wait_for(std::uint64_t cycle, int stop_fd) { wait_for(cycle, stop_fd, Whom::all); }
  // Takes its frames; never waits.
  bool kernel_has_answered(std::uint64_t cycle);
  // The same as wait_for, for the kernel's heartbeat alone.
  void wait_for_kernel(std::uint64_t cycle, int stop_fd) { wait_for(cycle, stop_fd, Whom::kernel); }

  PeerState kernel() const { return kernel_; }
  PeerState app() const { return app_; }
  PeerState journal() const { return journal_; }
  bool app_finished() const { return finished_; }

 private:
  enum class Whom { kernel, all };
  void wait_for(std::uint64_t cycle, int stop_fd, Whom whom);
  bool kernel_answered(std::uint64_t cycle) const;
  bool app_answered(std::uint64_t cycle) const;
  void take_frames();
  void take_ticks();
  void take_pace();
  void look_at_lifeline();
  // The peer to wait for next; nullptr: none.
  PeerState* waits_for(std::uint64_t cycle, Whom whom);
  bool was_heard(const PeerState* peer) const;

  can::Transport& bus_;
  Descriptors fd_;
  std::function<void(const berm_can_frame&)> on_frame_;
  PeerState kernel_ = PeerState::present, app_, journal_;
  std::optional<std::uint16_t> heartbeat_cycle_;   // of the newest heartbeat, whatever its guard: for keeping step, not for moving
  std::optional<std::uint64_t> tick_cycle_, journal_cycle_;
  bool finished_ = false;
};

}  // namespace berm::plant
