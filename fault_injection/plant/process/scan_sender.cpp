#include "plant/process/scan_sender.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "datagram/datagrams.hpp"

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

void ScanSender::send(std::span<const LidarPacket> packets) {
  constexpr std::size_t most = 32;  // in one message: half of what the system takes
  while (!packets.empty()) {
    const auto batch = packets.first(std::min(packets.size(), most));
    if (batch.size() == 1 || !segments_ || !send_batch(batch))
      for (const LidarPacket& packet : batch) send_bytes(packet.bytes.data(), packet.bytes.size());
    packets = packets.subspan(batch.size());
  }
}

bool ScanSender::send_batch(std::span<const LidarPacket> packets) {
  std::vector<iovec> part;
  for (const LidarPacket& packet : packets) part.push_back({const_cast<std::uint8_t*>(packet.bytes.data()), packet.bytes.size()});
  const auto sends = [&] { return datagram::send_cut(fd_, part.data(), part.size(), lidar_packet_bytes); };
  bool good = sends();
  if (!good && errno == ECONNREFUSED) good = sends();  // of the datagram before, as in send_bytes
  if (!good && errno != ECONNREFUSED) segments_ = false;
  if (good) sent_ += static_cast<std::uint32_t>(packets.size());
  return good;
}

void ScanSender::send_bytes(const std::uint8_t* bytes, std::size_t size) {
  // nobody may be listening (a kernel that died): the error of the datagram before is reported here and is no fault of this one
  if (::send(fd_, bytes, size, MSG_NOSIGNAL) < 0 && errno == ECONNREFUSED) ::send(fd_, bytes, size, MSG_NOSIGNAL);
  ++sent_;
}

}  // namespace berm::plant
