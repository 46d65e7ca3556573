#include "plant/process/peers.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>

namespace berm::plant {

namespace {

using Clock = std::chrono::steady_clock;
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

// All messages that have come from a peer; what has another size is none.
template <class Message, class Take>
void take_messages(int fd, PeerState& state, const Take& take) {
  if (state == PeerState::unused || state == PeerState::gone) return;
  for (;;) {
    Message message{};
    const ssize_t n = recv(fd, &message, sizeof message, MSG_DONTWAIT);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return;
    if (n <= 0) {
      state = PeerState::gone;
      return;
    }
    if (n != static_cast<ssize_t>(sizeof message)) continue;
    take(message);
    state = PeerState::present;
  }
}

}  // namespace

Peers::Peers(can::Transport& bus, const Descriptors& descriptors, std::function<void(const berm_can_frame&)> on_frame)
    : bus_(bus), fd_(descriptors), on_frame_(std::move(on_frame)), app_(fd_.tick >= 0 ? PeerState::present : PeerState::unused),
      journal_(fd_.journal >= 0 ? PeerState::present : PeerState::unused) {}

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
  take_messages<Tick>(fd_.tick, app_, [this](const Tick& tick) {
    tick_cycle_ = tick.cycle;
    finished_ = finished_ || (tick.flags & kFinishedFlag) != 0;
  });
}

void Peers::take_pace() {
  take_messages<std::uint64_t>(fd_.journal, journal_, [this](std::uint64_t cycle) { journal_cycle_ = cycle; });
}

void Peers::look_at_lifeline() {
  if (fd_.kernel >= 0 && kernel_ != PeerState::gone && hung_up(fd_.kernel)) kernel_ = PeerState::gone;
}

void Peers::drain() {
  take_frames();
  take_ticks();
  take_pace();
  look_at_lifeline();
}

bool Peers::kernel_answered(std::uint64_t cycle) const {
  return heartbeat_cycle_ && *heartbeat_cycle_ == static_cast<std::uint16_t>(cycle);
}

bool Peers::kernel_has_answered(std::uint64_t cycle) {
  take_frames();
  return kernel_answered(cycle);
}

bool Peers::app_answered(std::uint64_t cycle) const { return tick_cycle_ && *tick_cycle_ >= cycle; }

PeerState* Peers::waits_for(std::uint64_t cycle, Whom whom) {
  // app and writer have something to answer when the kernel has published: without it there is nothing to wait for
  if (kernel_ != PeerState::present) return nullptr;
  if (!kernel_answered(cycle)) return &kernel_;
  if (whom == Whom::kernel) return nullptr;
  if (app_ == PeerState::present && !app_answered(cycle)) return &app_;
  if (journal_ == PeerState::present && cycle > journal_cycle_.value_or(0) + kUnreadMost) return &journal_;
  return nullptr;
}

bool Peers::was_heard(const PeerState* peer) const {
  if (peer == &kernel_) return heartbeat_cycle_.has_value();
  return peer == &app_ ? tick_cycle_.has_value() : journal_cycle_.has_value();
}

void Peers::wait_for(std::uint64_t cycle, int stop_fd, Whom whom) {
  auto begin = Clock::now();
  const PeerState* waited_for = nullptr;
  for (;;) {
    drain();
    PeerState* const peer = waits_for(cycle, whom);
    if (peer == nullptr) return;
    if (peer != waited_for) begin = Clock::now();  // each peer has its own time
    waited_for = peer;
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(std::chrono::seconds(was_heard(peer) ? fd_.silence_s : fd_.first_contact_s) - (Clock::now() - begin)).count();
    if (left <= 0) {
      if (peer == &kernel_ && !was_heard(peer))
        throw std::runtime_error(fmt::format("the kernel never answered: no heartbeat within {} s of the first clock frame (is the computer too busy?)", fd_.first_contact_s));
      *peer = PeerState::absent;
      continue;
    }
    const auto unless_gone = [](PeerState state, int fd) { return state == PeerState::gone ? -1 : fd; };
    const bool others = whom == Whom::all;
    std::array<pollfd, 5> fds{{{bus_.fd(), POLLIN, 0},
                               {stop_fd, POLLIN, 0},
                               {unless_gone(kernel_, fd_.kernel), 0, 0},
                               {others ? unless_gone(app_, fd_.tick) : -1, POLLIN, 0},
                               {others ? unless_gone(journal_, fd_.journal) : -1, POLLIN, 0}}};
    if (poll(fds.data(), fds.size(), static_cast<int>(left)) > 0 && (fds[1].revents & POLLIN) != 0) return;
  }
}

}  // namespace berm::plant
