#include "io/peers.hpp"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "contract/berm_contract.h"

namespace berm::kernel {

namespace {

void drop(int& fd) {
  if (fd >= 0) close(fd);
  fd = -1;
}

// A peer says nothing after its role: anything it sends is thrown away, an end of file is its end.
bool hung_up(int fd) {
  char byte[16];
  for (int i = 0; i < 4; ++i) {
    const ssize_t n = recv(fd, byte, sizeof byte, MSG_DONTWAIT);
    if (n == 0) return true;
    if (n < 0) return errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR;
  }
  return false;
}

bool peer_uid(int fd, uid_t& uid) {
  ucred who{};
  socklen_t size = sizeof who;
  if (getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &who, &size) != 0) return false;
  uid = who.uid;
  return true;
}

bool send_welcome(int fd, const berm_welcome& welcome, const int* descriptors, int count) {
  iovec part{const_cast<berm_welcome*>(&welcome), sizeof welcome};
  alignas(cmsghdr) char control[CMSG_SPACE(2 * sizeof(int))] = {};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  if (count > 0) {
    const std::size_t bytes = static_cast<std::size_t>(count) * sizeof(int);
    message.msg_control = control;
    message.msg_controllen = CMSG_SPACE(bytes);
    cmsghdr* header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(bytes);
    std::memcpy(CMSG_DATA(header), descriptors, bytes);
  }
  return sendmsg(fd, &message, MSG_DONTWAIT | MSG_NOSIGNAL) == static_cast<ssize_t>(sizeof welcome);
}

}  // namespace

PeerServer::~PeerServer() {
  drop(app_);
  drop(journal_);
  for (int& fd : recorder_) drop(fd);
  for (Pending& pending : pending_) drop(pending.fd);
  if (listener_ >= 0) unlink(path_.c_str());
  drop(listener_);
}

bool PeerServer::open(const std::string& path, const PeerPolicy& policy, const SharedSegment& state, const SharedSegment& request, std::string& error) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) {
    error = path + ": a socket's path has at most " + std::to_string(sizeof address.sun_path - 1) + " characters";
    return false;
  }
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  struct stat left_over {};
  if (lstat(path.c_str(), &left_over) == 0 && S_ISSOCK(left_over.st_mode)) unlink(path.c_str());
  int fd = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd < 0 || bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 || listen(fd, kPending) != 0) {
    error = path + ": " + std::strerror(errno);
    drop(fd);
    return false;
  }
  // Anyone may knock; the peer's uid decides.
  chmod(path.c_str(), 0666);
  path_ = path;
  policy_ = policy;
  state_ = &state;
  request_ = &request;
  listener_ = fd;
  return true;
}

void PeerServer::serve_journal(const SharedSegment& ring, const SharedSegment& tail) {
  ring_ = &ring;
  tail_ = &tail;
}

void PeerServer::poll() {
  if (app_ >= 0 && hung_up(app_)) drop(app_);
  if (journal_ >= 0 && hung_up(journal_)) drop(journal_);
  for (int& fd : recorder_)
    if (fd >= 0 && hung_up(fd)) drop(fd);
  accept_newcomers();
  for (Pending& pending : pending_)
    if (pending.fd >= 0) greet(pending);
}

void PeerServer::accept_newcomers() {
  for (Pending& pending : pending_) {
    if (pending.fd >= 0) continue;
    pending.fd = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    pending.polls = 0;
    if (pending.fd < 0) return;
  }
}

void PeerServer::greet(Pending& pending) {
  std::uint8_t role = 0;
  const ssize_t n = recv(pending.fd, &role, 1, MSG_DONTWAIT);
  if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) {
    if (++pending.polls > kHandshakePolls) drop(pending.fd);
    return;
  }
  uid_t uid = 0;
  if (n != 1 || !peer_uid(pending.fd, uid)) {
    drop(pending.fd);
    return;
  }
  admit(pending.fd, role, uid);
  pending.fd = -1;
}

const char* PeerServer::refusal(std::uint8_t role, uid_t uid) const {
  if (role != BERM_ROLE_APP && role != BERM_ROLE_RECORDER && role != BERM_ROLE_JOURNAL) return "no such role";
  if (role == BERM_ROLE_JOURNAL) {
    if (ring_ == nullptr || !policy_.journal_uid) return "the kernel keeps no journal";
    if (uid != *policy_.journal_uid) return "this uid may not take that role";
    return journal_ >= 0 ? "the journal has a writer already" : nullptr;
  }
  if (uid != (role == BERM_ROLE_APP ? policy_.app_uid : policy_.recorder_uid)) return "this uid may not take that role";
  if (role == BERM_ROLE_RECORDER) return nullptr;
  if (policy_.refuse_app) return "the kernel runs without a machine";
  return app_ >= 0 ? "an app is connected already" : nullptr;
}

int* PeerServer::free_recorder() {
  for (int& fd : recorder_)
    if (fd < 0) return &fd;
  return nullptr;
}

int* PeerServer::place_for(std::uint8_t role) {
  if (role == BERM_ROLE_JOURNAL) return &journal_;
  return role == BERM_ROLE_APP ? &app_ : free_recorder();
}

void PeerServer::admit(int fd, std::uint8_t role, uid_t uid) {
  const char* reason = refusal(role, uid);
  int* place = place_for(role);
  if (reason == nullptr && place == nullptr) reason = "too many recorders";
  berm_welcome welcome{};
  welcome.magic = BERM_CONTRACT_MAGIC;
  welcome.version = BERM_CONTRACT_VERSION;
  welcome.accepted = reason == nullptr ? 1U : 0U;
  const bool journal = role == BERM_ROLE_JOURNAL && reason == nullptr;
  const SharedSegment& first = journal ? *ring_ : *state_;
  const SharedSegment& second = journal ? *tail_ : *request_;
  welcome.state_size = static_cast<std::uint32_t>(first.size());
  welcome.request_size = static_cast<std::uint32_t>(second.size());
  if (reason != nullptr) std::snprintf(welcome.reason, sizeof welcome.reason, "%s", reason);
  const int descriptors[2] = {first.fd(), second.fd()};
  const int count = reason != nullptr ? 0 : role == BERM_ROLE_RECORDER ? 1 : 2;
  if (!send_welcome(fd, welcome, descriptors, count) || reason != nullptr) {
    drop(fd);
    return;
  }
  *place = fd;
  if (role == BERM_ROLE_APP) ++app_connections_;
  journal_seen_ = journal_seen_ || journal;
}

}  // namespace berm::kernel
