#include "can/can_transport.hpp"

#include <arpa/inet.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>

namespace berm::can {

namespace {

constexpr int kReceiveBuffer = 4 << 20;
constexpr std::size_t kData = 8;

std::string failed(const std::string& address, const char* what) { return address + ": " + what + ": " + strerror(errno); }

std::int64_t now_ms() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1000 + now.tv_nsec / 1000000;
}

}  // namespace

Transport::~Transport() {
  if (fd_ >= 0) close(fd_);
}

std::string Transport::open(const std::string& address) {
  if (fd_ >= 0) return address + ": this transport is open already";
  if (address.rfind("can:", 0) == 0) return open_socketcan(address.substr(4));
  const auto colon = address.rfind(':');
  if (address.rfind("udp:", 0) != 0 || colon == 3) return address + ": a CAN address is can:INTERFACE or udp:GROUP:PORT";
  char* end = nullptr;
  const std::string port = address.substr(colon + 1);
  const long number = std::strtol(port.c_str(), &end, 10);
  if (port.empty() || *end != '\0' || number < 1 || number > 65535) return address + ": port: not within 1..65535";
  return open_multicast(address.substr(4, colon - 4), static_cast<int>(number));
}

std::string Transport::open_multicast(const std::string& group, int port) {
  const std::string address = "udp:" + group + ":" + std::to_string(port);
  group_.sin_family = AF_INET;
  group_.sin_port = htons(static_cast<std::uint16_t>(port));
  if (inet_pton(AF_INET, group.c_str(), &group_.sin_addr) != 1 || !IN_MULTICAST(ntohl(group_.sin_addr.s_addr)))
    return address + ": group: not an IPv4 multicast address";
  fd_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd_ < 0) return failed(address, "socket");
  const int yes = 1;
  ip_mreq membership{};
  membership.imr_multiaddr = group_.sin_addr;
  membership.imr_interface.s_addr = htonl(INADDR_LOOPBACK);
  const in_addr loopback = membership.imr_interface;
  setsockopt(fd_, SOL_SOCKET, SO_RCVBUF, &kReceiveBuffer, sizeof kReceiveBuffer);
  datagram::take_uncut(fd_);
  if (setsockopt(fd_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0 || bind(fd_, reinterpret_cast<const sockaddr*>(&group_), sizeof group_) != 0)
    return failed(address, "bind");
  if (setsockopt(fd_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) != 0) return failed(address, "join");
  if (setsockopt(fd_, IPPROTO_IP, IP_MULTICAST_IF, &loopback, sizeof loopback) != 0) return failed(address, "loopback");
  multicast_ = true;
  return {};
}

std::string Transport::open_socketcan(const std::string& interface) {
  const std::string address = "can:" + interface;
  ifreq request{};
  if (interface.empty() || interface.size() >= sizeof request.ifr_name) return address + ": interface: 1 to 15 characters";
  fd_ = socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, CAN_RAW);
  if (fd_ < 0) return failed(address, "this kernel has no CAN socket");
  memcpy(request.ifr_name, interface.c_str(), interface.size());
  if (ioctl(fd_, SIOCGIFINDEX, &request) != 0) return failed(address, "interface");
  setsockopt(fd_, SOL_SOCKET, SO_RCVBUF, &kReceiveBuffer, sizeof kReceiveBuffer);
  sockaddr_can can{};
  can.can_family = AF_CAN;
  can.can_ifindex = request.ifr_ifindex;
  if (bind(fd_, reinterpret_cast<const sockaddr*>(&can), sizeof can) != 0) return failed(address, "bind");
  multicast_ = false;
  return {};
}

bool Transport::send(const berm_can_frame& frame) {
  bool good = false;
  if (multicast_) {
    canfd_frame out{};
    out.can_id = frame.id | CAN_EFF_FLAG;
    out.len = frame.length;
    memcpy(out.data, frame.data, kData);
    good = sendto(fd_, &out, sizeof out, 0, reinterpret_cast<const sockaddr*>(&group_), sizeof group_) == static_cast<ssize_t>(sizeof out);
  } else {
    can_frame out{};
    out.can_id = frame.id | CAN_EFF_FLAG;
    out.can_dlc = frame.length;
    memcpy(out.data, frame.data, kData);
    good = write(fd_, &out, sizeof out) == static_cast<ssize_t>(sizeof out);
  }
  ++(good ? counters_.sent : counters_.send_failed);
  return good;
}

bool Transport::send(const berm_can_frame* frames, int count) {
  for (int sent = 0; sent < count;) {
    const int batch = std::min(count - sent, kBatch);
    if (multicast_ && segments_ && batch > 1 && send_batch(frames + sent, batch)) {
      counters_.sent += static_cast<std::uint64_t>(batch);
      sent += batch;
    } else if (!send(frames[sent++])) {
      counters_.send_failed += static_cast<std::uint64_t>(count - sent);
      return false;
    }
  }
  return true;
}

// One message that the system cuts into datagrams, each as send() makes it.
bool Transport::send_batch(const berm_can_frame* frames, int count) {
  canfd_frame out[kBatch] = {};
  for (int i = 0; i < count; ++i) {
    out[i].can_id = frames[i].id | CAN_EFF_FLAG;
    out[i].len = frames[i].length;
    memcpy(out[i].data, frames[i].data, kData);
  }
  iovec part{out, static_cast<std::size_t>(count) * sizeof out[0]};
  const bool good = datagram::send_cut(fd_, &part, 1, sizeof out[0], &group_);
  segments_ = good || !datagram::cuts_none(errno);
  return good;
}

bool Transport::receive(berm_can_frame& frame) {
  datagram::Waiting::One one;
  while (waiting_.next(fd_, one)) {
    canfd_frame in{};
    const std::size_t expected = multicast_ ? sizeof(canfd_frame) : sizeof(can_frame);
    const bool whole = one.length == expected;
    if (whole) memcpy(&in, one.bytes, expected);
    if (!whole || in.len > kData || (in.can_id & CAN_EFF_FLAG) == 0 || (in.can_id & (CAN_RTR_FLAG | CAN_ERR_FLAG)) != 0) {
      ++counters_.wrong_length;
      continue;
    }
    frame.id = in.can_id & CAN_EFF_MASK;
    frame.length = in.len;
    memcpy(frame.data, in.data, kData);
    ++counters_.received;
    return true;
  }
  return false;
}

bool Transport::receive(berm_can_frame& frame, int timeout_ms) {
  const std::int64_t deadline_ms = now_ms() + timeout_ms;
  for (;;) {
    if (receive(frame)) return true;
    const std::int64_t left_ms = deadline_ms - now_ms();
    if (left_ms <= 0) return false;
    pollfd wait{fd_, POLLIN, 0};
    // A signal ends the wait, so that its flag is looked at; a datagram that is no frame does not.
    if (poll(&wait, 1, static_cast<int>(left_ms)) != 1) return false;
  }
}

}  // namespace berm::can
