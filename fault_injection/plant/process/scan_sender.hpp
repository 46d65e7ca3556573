// Sends scan packets as datagrams to a port on loopback.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plant/world/spinning_lidar.hpp"
#include "scan/scan_packet.h"

namespace berm::plant {

class ScanSender {
 public:
  // Throws std::runtime_error.
  explicit ScanSender(std::uint16_t port);
  ScanSender(const ScanSender&) = delete;
  ScanSender& operator=(const ScanSender&) = delete;
  ~ScanSender();

  // Throws std::runtime_error when a packet is not valid. A datagram that cannot be delivered is lost, as on a real network, but counted.
  // epoch_us is added to the stamps: the time of the receiver's clock when the packets' time was zero.
  void send(std::vector<berm_scan_packet>& packets, std::uint64_t epoch_us);
  // As they are, by as few calls of the system as it allows.
  void send(std::span<const LidarPacket> packets);
  void send_bytes(const std::uint8_t* bytes, std::size_t size);
  std::uint32_t sent() const { return sent_; }

 private:
  bool send_batch(std::span<const LidarPacket> packets);

  int fd_ = -1;
  bool segments_ = true;  // the system cuts one message into datagrams; until it says that it does not
  std::uint32_t sent_ = 0;
};

}  // namespace berm::plant
