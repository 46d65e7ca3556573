#include "run/reserved_port.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <system_error>

namespace berm::run {

namespace {

constexpr int kTries = 1000;

// A name in the abstract namespace is bound once in a network namespace, by whoever's process, and free again when that ends: what a lock on a file
// would do, without a folder that every user can write to. -1: another has it.
int claimed(std::uint16_t port) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = fmt::format("berm-udp-port-{}", port);
  std::memcpy(address.sun_path + 1, name.data(), name.size());
  const int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) throw std::system_error(errno, std::generic_category(), name);
  if (bind(fd, reinterpret_cast<const sockaddr*>(&address), static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size())) == 0) return fd;
  const int error = errno;
  close(fd);
  if (error != EADDRINUSE) throw std::system_error(error, std::generic_category(), name);
  return -1;
}

}  // namespace

std::uint16_t free_udp_port() {
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  const bool good = fd >= 0 && bind(fd, reinterpret_cast<sockaddr*>(&address), size) == 0 && getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size) == 0;
  const int error = errno;
  if (fd >= 0) close(fd);
  if (!good) throw std::system_error(error, std::generic_category(), "no free UDP port on loopback");
  return ntohs(address.sin_port);
}

ReservedPort::ReservedPort(const std::function<std::uint16_t()>& draw) {
  for (int i = 0; i < kTries && fd_ < 0; ++i) {
    number_ = draw();
    fd_ = claimed(number_);
  }
  if (fd_ < 0) throw std::system_error(EADDRINUSE, std::generic_category(), "no UDP port on loopback that no other run has");
}

ReservedPort::~ReservedPort() {
  if (fd_ >= 0) close(fd_);
}

std::string ReservedPort::can_address() const { return fmt::format("udp:239.255.66.{}:{}", 1 + number_ % 250, number_); }

}  // namespace berm::run
