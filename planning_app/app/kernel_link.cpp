#include "app/kernel_link.hpp"

#include <fcntl.h>
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstring>
#include <ctime>

namespace berm::app {

namespace {

constexpr int connect_attempts = 50;
constexpr long connect_pause_ns = 100'000'000;

[[noreturn]] void fail(const std::string& what) { throw LinkError(what); }

std::string reason() { return std::strerror(errno); }

int connect_to(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) fail("--socket: path longer than " + std::to_string(sizeof address.sun_path - 1) + " bytes");
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  for (int attempt = 0;; ++attempt) {
    const int fd = ::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
    if (fd < 0) fail("socket: " + reason());
    if (::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return fd;
    const int error = errno;
    ::close(fd);
    if ((error != ENOENT && error != ECONNREFUSED) || attempt + 1 >= connect_attempts) fail(path + ": no kernel: " + std::strerror(error));
    const timespec pause{0, connect_pause_ns};
    ::nanosleep(&pause, nullptr);
  }
}

// The welcome with its two descriptors: state, request.
berm_welcome receive_welcome(int socket, const std::string& path, int (&fds)[2]) {
  const timeval patience{5, 0};
  ::setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  berm_welcome welcome{};
  alignas(cmsghdr) char control[CMSG_SPACE(2 * sizeof(int))] = {};
  iovec io{&welcome, sizeof welcome};
  msghdr message{};
  message.msg_iov = &io;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  const ssize_t n = ::recvmsg(socket, &message, MSG_CMSG_CLOEXEC);
  if (n < 0) fail(path + ": no welcome: " + reason());
  if (n == 0) fail(path + ": the kernel refused the connection");
  if (n != static_cast<ssize_t>(sizeof welcome) || welcome.magic != BERM_CONTRACT_MAGIC) fail(path + ": not a Berm kernel's welcome");
  welcome.reason[sizeof welcome.reason - 1] = '\0';
  if (welcome.version != BERM_CONTRACT_VERSION) fail(path + ": contract version " + std::to_string(welcome.version) + ", this app speaks " + std::to_string(BERM_CONTRACT_VERSION));
  if (welcome.accepted != 1) fail(path + ": refused: " + welcome.reason);
  const cmsghdr* header = CMSG_FIRSTHDR(&message);
  if (!header || header->cmsg_level != SOL_SOCKET || header->cmsg_type != SCM_RIGHTS || header->cmsg_len != CMSG_LEN(2 * sizeof(int)))
    fail(path + ": the welcome lacks its two segments");
  std::memcpy(fds, CMSG_DATA(header), sizeof fds);
  return welcome;
}

// A segment that could shrink would kill its reader.
void* map_segment(int fd, std::size_t size, std::size_t announced, int protection, const std::string& name) {
  struct stat status {};
  if (announced != size) fail(name + " segment: " + std::to_string(announced) + " bytes announced, " + std::to_string(size) + " expected");
  if (::fstat(fd, &status) != 0 || status.st_size < static_cast<off_t>(size)) fail(name + " segment is shorter than announced");
  const int seals = ::fcntl(fd, F_GET_SEALS);
  if (seals < 0 || (seals & F_SEAL_SHRINK) == 0) fail(name + " segment is not sealed against shrinking");
  void* at = ::mmap(nullptr, size, protection, MAP_SHARED, fd, 0);
  if (at == MAP_FAILED) fail(name + " segment: mmap: " + reason());
  ::close(fd);
  return at;
}

}  // namespace

KernelLink::KernelLink(const std::string& socket_path) {
  socket_ = connect_to(socket_path);
  const std::uint8_t role = BERM_ROLE_APP;
  if (::send(socket_, &role, 1, MSG_NOSIGNAL) != 1) fail(socket_path + ": " + reason());
  int fds[2] = {-1, -1};
  const berm_welcome welcome = receive_welcome(socket_, socket_path, fds);
  state_ = static_cast<const berm_state_segment*>(map_segment(fds[0], sizeof(berm_state_segment), welcome.state_size, PROT_READ, "state"));
  request_ = static_cast<berm_request_segment*>(map_segment(fds[1], sizeof(berm_request_segment), welcome.request_size, PROT_READ | PROT_WRITE, "request"));
  if (state_->magic != BERM_CONTRACT_MAGIC || state_->version != BERM_CONTRACT_VERSION || state_->size != sizeof(berm_state_segment))
    fail("state segment: magic, version or size is not the contract's");
}

KernelLink::~KernelLink() {
  if (state_) ::munmap(const_cast<berm_state_segment*>(state_), sizeof *state_);
  if (request_) ::munmap(request_, sizeof *request_);
  if (socket_ >= 0) ::close(socket_);
}

std::uint32_t KernelLink::wake() const { return __atomic_load_n(&state_->wake, __ATOMIC_ACQUIRE); }

void KernelLink::wait(std::uint32_t seen, int timeout_ms) const {
  const timespec timeout{timeout_ms / 1000, (timeout_ms % 1000) * 1'000'000L};
  ::syscall(SYS_futex, &state_->wake, FUTEX_WAIT, seen, &timeout, nullptr, 0);
}

bool KernelLink::read(berm_state& out) const {
  constexpr int attempts = 1000;
  for (int i = 0; i < attempts; ++i) {
    const std::uint32_t before = __atomic_load_n(&state_->state_guard, __ATOMIC_ACQUIRE);
    if (before & 1u) continue;
    std::memcpy(&out, &state_->state, sizeof out);
    __atomic_thread_fence(__ATOMIC_ACQUIRE);
    if (__atomic_load_n(&state_->state_guard, __ATOMIC_RELAXED) == before) return true;
  }
  return false;
}

void KernelLink::write(const berm_request& request) {
  const std::uint32_t guard = __atomic_load_n(&request_->guard, __ATOMIC_RELAXED) | 1u;
  __atomic_store_n(&request_->guard, guard, __ATOMIC_RELAXED);
  __atomic_thread_fence(__ATOMIC_SEQ_CST);
  std::memcpy(&request_->request, &request, sizeof request);
  __atomic_store_n(&request_->guard, guard + 1u, __ATOMIC_RELEASE);
}

bool KernelLink::kernel_gone() const {
  char byte = 0;
  const ssize_t n = ::recv(socket_, &byte, 1, MSG_DONTWAIT);
  return n == 0 || (n < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR);
}

}  // namespace berm::app
