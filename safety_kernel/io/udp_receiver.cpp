#include "io/udp_receiver.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

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
  datagram::take_uncut(fd_);
  return true;
}

ssize_t UdpReceiver::receive(std::uint8_t* bytes, std::size_t capacity) {
  datagram::Waiting::One one;
  if (!waiting_.next(fd_, one)) return -1;
  std::memcpy(bytes, one.bytes, std::min(capacity, one.length));
  return static_cast<ssize_t>(one.length);
}

}  // namespace berm::kernel
