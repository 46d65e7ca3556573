#include "plant/process/scan_sender.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace berm::plant {

ScanSender::ScanSender(std::uint16_t port) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(port);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  fd_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd_ < 0 || connect(fd_, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0) {
    throw std::runtime_error(fmt::format("--scan-port {}: {}", port, std::strerror(errno)));
  }
}

ScanSender::~ScanSender() {
  if (fd_ >= 0) close(fd_);
}

void ScanSender::send(std::vector<berm_scan_packet>& packets, std::uint64_t epoch_us) {
  std::array<std::uint8_t, BERM_SCAN_PACKET_MAX_BYTES> bytes{};
  for (berm_scan_packet& packet : packets) {
    packet.time_us += epoch_us;
    const std::size_t n = berm_scan_encode(&packet, bytes.data());
    if (n == 0) throw std::runtime_error("the world made a scan packet with a field out of range");
    send_bytes(bytes.data(), n);
  }
}

void ScanSender::send_bytes(const std::uint8_t* bytes, std::size_t size) {
  // nobody may be listening (a kernel that died): the error of the datagram before is reported here and is no fault of this one
  if (::send(fd_, bytes, size, MSG_NOSIGNAL) < 0 && errno == ECONNREFUSED) ::send(fd_, bytes, size, MSG_NOSIGNAL);
  ++sent_;
}

}  // namespace berm::plant
