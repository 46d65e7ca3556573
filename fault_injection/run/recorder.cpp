#include "run/recorder.hpp"

#include <fmt/format.h>
#include <linux/futex.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <stdexcept>

#include "run/contract_text.hpp"

namespace berm::run {

namespace {

constexpr int kPathEvery = 10;  // one point of the bucket's path every 0.1 s

// The kernel writes these words while we read them.
std::uint32_t load(const std::uint32_t& word) { return __atomic_load_n(&word, __ATOMIC_ACQUIRE); }

}  // namespace

Recorder::~Recorder() {
  if (segment_ != nullptr) munmap(const_cast<berm_state_segment*>(segment_), sizeof(berm_state_segment));
  if (socket_ >= 0) close(socket_);
}

void Recorder::connect(const std::string& socket_path) {
  socket_ = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (socket_path.size() >= sizeof address.sun_path) throw std::runtime_error("socket path too long: " + socket_path);
  strcpy(address.sun_path, socket_path.c_str());
  if (socket_ < 0 || ::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error(fmt::format("{}: {}", socket_path, strerror(errno)));
  const timeval patience{5, 0};
  setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  const char role = BERM_ROLE_RECORDER;
  if (send(socket_, &role, 1, MSG_NOSIGNAL) != 1) throw std::runtime_error("the kernel closed the recorder's connection");

  berm_welcome welcome{};
  iovec part{&welcome, sizeof welcome};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int) * 2)];
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  const ssize_t n = recvmsg(socket_, &message, MSG_CMSG_CLOEXEC);
  if (n != static_cast<ssize_t>(sizeof welcome)) throw std::runtime_error("the kernel gave the recorder no welcome");
  if (welcome.accepted == 0) throw std::runtime_error(std::string("the kernel refused the recorder: ") + welcome.reason);
  const cmsghdr* header = CMSG_FIRSTHDR(&message);
  if (header == nullptr || header->cmsg_type != SCM_RIGHTS) throw std::runtime_error("the kernel's welcome carries no segment");
  int fd = -1;
  memcpy(&fd, CMSG_DATA(header), sizeof fd);
  if (welcome.version != BERM_CONTRACT_VERSION || welcome.state_size != sizeof(berm_state_segment)) {
    close(fd);
    throw std::runtime_error("the kernel speaks another version of the contract");
  }
  void* memory = mmap(nullptr, sizeof(berm_state_segment), PROT_READ, MAP_SHARED, fd, 0);
  close(fd);
  if (memory == MAP_FAILED) throw std::runtime_error("cannot map the state segment");
  segment_ = static_cast<const berm_state_segment*>(memory);
  next_ = 0;
}

void Recorder::poll(double seconds) {
  const std::uint32_t seen = load(segment_->wake);
  if (load(segment_->decision_head) == next_) {
    const timespec patience{static_cast<time_t>(seconds), static_cast<long>((seconds - std::floor(seconds)) * 1e9)};
    syscall(SYS_futex, &segment_->wake, FUTEX_WAIT, seen, &patience, nullptr, 0);
  }
  std::uint32_t head = load(segment_->decision_head);
  while (next_ != head) {
    if (head - next_ > BERM_DECISION_RING) {  // overtaken: what is gone is counted, never guessed
      lost_ += head - BERM_DECISION_RING - next_;
      next_ = head - BERM_DECISION_RING;
    }
    const berm_decision copy = segment_->decision[next_ % BERM_DECISION_RING];
    std::atomic_thread_fence(std::memory_order_acquire);
    head = load(segment_->decision_head);
    // The slot of decision n is written again for n + ring: valid only while the head has not come that far.
    if (head - next_ >= BERM_DECISION_RING) {
      ++lost_;
    } else {
      take(copy);
    }
    ++next_;
  }
}

void Recorder::take(const berm_decision& d) {
  if (decisions_ == 0 && from_first_) origin_us_ = d.time_us;
  if (decisions_ > 0 && last_.kernel_state == BERM_STATE_RUN && d.kernel_state != BERM_STATE_RUN && d.stop_reason != BERM_STOP_NONE) {
    const std::string reason = stop_reason_name(d.stop_reason);
    ++stops_[reason];
    stop_events_.push_back({seconds(d), reason, BERM_STOP_HAS_CELL(d.stop_reason), d.blocked_x_mm * 1e-3, d.blocked_y_mm * 1e-3, d.blocked_height_mm * 1e-3});
  }
  if (d.kernel_state == BERM_STATE_FAULT && (decisions_ == 0 || last_.kernel_state != BERM_STATE_FAULT)) {
    ++faults_;
    if (first_fault_.empty()) first_fault_ = stop_reason_name(d.stop_reason);
  }
  const double speed = d.joint_velocity_urad_s[BERM_SWING] * 1e-6;
  if (std::abs(speed) > std::abs(fastest_.swing_speed_rad_s) + 0.01) snapshot_slices(speed);
  if (d.cycle % kPathEvery == 0) {
    BucketPoint point{seconds(d), {}, d.kernel_state};
    for (int j = 0; j < BERM_JOINTS; ++j) point.angle_rad[static_cast<std::size_t>(j)] = d.joint_angle_urad[j] * 1e-6;
    path_.push_back(point);
  }
  last_ = d;
  ++decisions_;
}

void Recorder::snapshot_slices(double speed) {
  for (int attempt = 0; attempt < 3; ++attempt) {
    const std::uint32_t before = load(segment_->slice_guard);
    if (before & 1u) continue;
    const std::uint32_t count = std::min<std::uint32_t>(segment_->slice_count, BERM_SLICE_SNAPSHOT);
    std::vector<berm_slice> copy(segment_->slice, segment_->slice + count);
    std::atomic_thread_fence(std::memory_order_acquire);
    if (load(segment_->slice_guard) != before) continue;
    fastest_ = {std::move(copy), speed, time_s()};
    return;
  }
}

MapSnapshot Recorder::map() const {
  MapSnapshot map;
  map.cell_m = segment_->cell_mm * 1e-3;
  map.origin_m = segment_->map_origin_mm * 1e-3;
  const auto* heights = &segment_->map_height_mm[0][0];
  const auto* status = &segment_->map_status[0][0];
  map.height_mm.assign(heights, heights + BERM_MAP_CELLS * BERM_MAP_CELLS);
  map.status.assign(status, status + BERM_MAP_CELLS * BERM_MAP_CELLS);
  return map;
}

}  // namespace berm::run
