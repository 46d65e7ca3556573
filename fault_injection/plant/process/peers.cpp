#include "plant/process/peers.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>

namespace berm::plant {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kSilence{5};
constexpr std::chrono::seconds kFirstContact{30};  // a peer that is still starting
constexpr std::uint32_t kKernelSource = 0x0A;
constexpr std::uint32_t kFinishedFlag = 1;

struct Tick {
  std::uint64_t cycle;
  std::uint32_t flags;
  std::uint32_t zero;
};
static_assert(sizeof(Tick) == 16);

bool hung_up(int fd) {
  pollfd p{fd, POLLIN, 0};
  return poll(&p, 1, 0) > 0 && (p.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0;
}

}  // namespace

Peers::Peers(can::Transport& bus, int kernel_fd, int tick_fd, std::function<void(const berm_can_frame&)> on_frame)
    : bus_(bus), kernel_fd_(kernel_fd), tick_fd_(tick_fd), on_frame_(std::move(on_frame)),
      app_(tick_fd >= 0 ? PeerState::present : PeerState::unused) {}

void Peers::take_frames() {
  berm_can_frame frame;
  while (bus_.receive(frame)) {
    if ((frame.id & 0xFFu) != kKernelSource) continue;  // own frames come back on a multicast bus
    berm_heartbeat heartbeat;
    if (berm_decode_heartbeat(&frame, &heartbeat)) {
      heartbeat_cycle_ = heartbeat.cycle;
      if (kernel_ == PeerState::absent) kernel_ = PeerState::present;
    }
    on_frame_(frame);
  }
}

void Peers::take_ticks() {
  if (app_ == PeerState::unused || app_ == PeerState::gone) return;
  for (;;) {
    Tick tick{};
    const ssize_t n = recv(tick_fd_, &tick, sizeof tick, MSG_DONTWAIT);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return;
    if (n <= 0) {
      app_ = PeerState::gone;
      return;
    }
    if (n != static_cast<ssize_t>(sizeof tick)) continue;
    tick_cycle_ = tick.cycle;
    finished_ = finished_ || (tick.flags & kFinishedFlag) != 0;
    app_ = PeerState::present;
  }
}

void Peers::look_at_lifeline() {
  if (kernel_fd_ >= 0 && kernel_ != PeerState::gone && hung_up(kernel_fd_)) kernel_ = PeerState::gone;
}

void Peers::drain() {
  take_frames();
  take_ticks();
  look_at_lifeline();
}

bool Peers::kernel_answered(std::uint64_t cycle) const {
  return heartbeat_cycle_ && *heartbeat_cycle_ == static_cast<std::uint16_t>(cycle);
}

bool Peers::app_answered(std::uint64_t cycle) const { return tick_cycle_ && *tick_cycle_ >= cycle; }

void Peers::wait_for(std::uint64_t cycle, int stop_fd) {
  auto begin = Clock::now();
  bool kernel_was_waiting = true;
  for (;;) {
    drain();
    const bool wait_kernel = kernel_ == PeerState::present && !kernel_answered(cycle);
    // the app ticks when the kernel has published: without the kernel's answer there is nothing to wait for
    const bool wait_app = !wait_kernel && kernel_ == PeerState::present && app_ == PeerState::present && !app_answered(cycle);
    if (!wait_kernel && !wait_app) return;
    if (kernel_was_waiting && !wait_kernel) begin = Clock::now();  // each peer has its own time
    kernel_was_waiting = wait_kernel;
    const bool known = wait_kernel ? heartbeat_cycle_.has_value() : tick_cycle_.has_value();
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>((known ? kSilence : kFirstContact) - (Clock::now() - begin)).count();
    if (left <= 0) {
      (wait_kernel ? kernel_ : app_) = PeerState::absent;
      continue;
    }
    std::array<pollfd, 4> fds{{{bus_.fd(), POLLIN, 0}, {stop_fd, POLLIN, 0}, {kernel_ == PeerState::gone ? -1 : kernel_fd_, 0, 0},
                               {app_ == PeerState::gone ? -1 : tick_fd_, POLLIN, 0}}};
    if (poll(fds.data(), fds.size(), static_cast<int>(left)) > 0 && (fds[1].revents & POLLIN) != 0) return;
  }
}

}  // namespace berm::plant
