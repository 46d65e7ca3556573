#include "record/kernel_link.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace berm::record {

namespace {
constexpr std::size_t kRingSegment = BERM_JOURNAL_HEADER_BYTES + BERM_JOURNAL_RING_BYTES;
constexpr time_t kPatienceS = 5;
}  // namespace

KernelLink::~KernelLink() {
  if (ring_ != nullptr) munmap(const_cast<berm_journal_ring*>(ring_), kRingSegment);
  if (tail_ != nullptr) munmap(tail_, sizeof *tail_);
  if (socket_ >= 0) close(socket_);
}

bool KernelLink::connect(const std::string& socket_path, std::string& error) {
  int descriptors[2] = {-1, -1};
  const bool good = greet(socket_path, descriptors, error) && map(descriptors, error);
  for (const int fd : descriptors)
    if (fd >= 0) close(fd);
  return good;
}

bool KernelLink::greet(const std::string& socket_path, int (&descriptors)[2], std::string& error) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (socket_path.size() >= sizeof address.sun_path) {
    error = socket_path + ": a socket's path has at most " + std::to_string(sizeof address.sun_path - 1) + " characters";
    return false;
  }
  std::memcpy(address.sun_path, socket_path.c_str(), socket_path.size() + 1);
  socket_ = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
  const timeval patience{kPatienceS, 0};
  const char role = BERM_ROLE_JOURNAL;
  if (socket_ < 0 || ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience) != 0 || send(socket_, &role, 1, MSG_NOSIGNAL) != 1) {
    error = socket_path + ": " + std::strerror(errno);
    return false;
  }
  berm_welcome welcome{};
  iovec part{&welcome, sizeof welcome};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof descriptors)];
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  if (recvmsg(socket_, &message, MSG_CMSG_CLOEXEC) != static_cast<ssize_t>(sizeof welcome)) {
    error = socket_path + ": the kernel gave no welcome";
    return false;
  }
  welcome.reason[sizeof welcome.reason - 1] = '\0';
  const cmsghdr* header = CMSG_FIRSTHDR(&message);
  if (header != nullptr && header->cmsg_type == SCM_RIGHTS && header->cmsg_len == CMSG_LEN(sizeof descriptors)) std::memcpy(descriptors, CMSG_DATA(header), sizeof descriptors);
  if (welcome.accepted == 0) {
    error = socket_path + ": the kernel refused: " + welcome.reason;
    return false;
  }
  const bool same = welcome.magic == BERM_CONTRACT_MAGIC && welcome.version == BERM_CONTRACT_VERSION && welcome.state_size == kRingSegment &&
                    welcome.request_size == sizeof(berm_journal_tail) && descriptors[1] >= 0;
  if (!same) error = socket_path + ": the kernel speaks another version of the journal";
  return same;
}

bool KernelLink::map(const int (&descriptors)[2], std::string& error) {
  for (const int fd : descriptors) {
    const int seals = fcntl(fd, F_GET_SEALS);
    if (seals < 0 || (seals & F_SEAL_SHRINK) == 0) {
      error = "the kernel's segments are not sealed against shrinking";
      return false;
    }
  }
  void* ring = mmap(nullptr, kRingSegment, PROT_READ, MAP_SHARED, descriptors[0], 0);
  void* tail = mmap(nullptr, sizeof(berm_journal_tail), PROT_READ | PROT_WRITE, MAP_SHARED, descriptors[1], 0);
  if (ring != MAP_FAILED) ring_ = static_cast<const berm_journal_ring*>(ring);
  if (tail != MAP_FAILED) tail_ = static_cast<berm_journal_tail*>(tail);
  const bool good = ring_ != nullptr && tail_ != nullptr && ring_->magic == BERM_JOURNAL_MAGIC && ring_->size == BERM_JOURNAL_RING_BYTES &&
                    ring_->header_bytes == BERM_JOURNAL_HEADER_BYTES && ring_->start.version == BERM_JOURNAL_VERSION;
  if (!good) error = "the kernel's ring cannot be mapped, or is of another version";
  return good;
}

bool KernelLink::kernel_gone(int wait_ms) const {
  pollfd wait{socket_, POLLIN, 0};
  if (poll(&wait, 1, wait_ms) <= 0) return false;
  char byte;
  const ssize_t n = recv(socket_, &byte, 1, MSG_DONTWAIT);
  return n == 0 || (n < 0 && errno != EAGAIN && errno != EINTR);
}

}  // namespace berm::record
