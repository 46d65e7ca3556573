#include "io/udp_receiver.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "io/vlp16.hpp"
#include "scan/scan_packet.h"

namespace berm::kernel {

namespace {
constexpr int kReceiveBufferBytes = 4 << 20;  // two revolutions of a VLP-16 while the kernel waits for its next cycle
}

UdpReceiver::~UdpReceiver() {
  if (fd_ >= 0) close(fd_);
}

bool UdpReceiver::open(std::uint16_t port, std::string& error) {
  fd_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  if (fd_ < 0 || bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    error = "UDP port " + std::to_string(port) + " on 127.0.0.1: " + std::strerror(errno);
    return false;
  }
  // Beyond the system's limit only with privilege; the plain call takes what the system grants.
  if (setsockopt(fd_, SOL_SOCKET, SO_RCVBUFFORCE, &kReceiveBufferBytes, sizeof kReceiveBufferBytes) != 0)
    setsockopt(fd_, SOL_SOCKET, SO_RCVBUF, &kReceiveBufferBytes, sizeof kReceiveBufferBytes);
  return true;
}

bool UdpReceiver::refill() {
  iovec part[kBatch];
  mmsghdr message[kBatch] = {};
  for (int i = 0; i < kBatch; ++i) {
    part[i] = {waiting_[i], kRoom};
    message[i].msg_hdr.msg_iov = &part[i];
    message[i].msg_hdr.msg_iovlen = 1;
  }
  int n = 0;
  do {
    n = recvmmsg(fd_, message, kBatch, MSG_DONTWAIT | MSG_TRUNC, nullptr);
  } while (n < 0 && errno == EINTR);
  next_ = 0;
  taken_ = std::max(n, 0);
  for (int i = 0; i < taken_; ++i) length_[i] = message[i].msg_len;
  return taken_ > 0;
}

ssize_t UdpReceiver::receive(std::uint8_t* bytes, std::size_t capacity) {
  static_assert(kRoom > BERM_SCAN_PACKET_MAX_BYTES && kRoom > kVlp16PacketBytes);
  if (next_ == taken_ && !refill()) return -1;
  const std::size_t length = length_[next_];
  std::memcpy(bytes, waiting_[next_++], std::min({capacity, kRoom, length}));
  return static_cast<ssize_t>(length);
}

}  // namespace berm::kernel
