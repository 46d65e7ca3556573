// Carries CAN frames: SocketCAN ("can:can0", "can:vcan0"), or the same frames as struct canfd_frame datagrams by multicast on loopback
// ("udp:GROUP:PORT") where the running kernel has no CAN. Sending and receiving neither allocate nor throw.
#pragma once

#include <netinet/in.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "can/berm_can.h"
#include "datagram/datagrams.hpp"

namespace berm::can {

struct TransportCounters {
  std::uint64_t sent = 0;
  std::uint64_t received = 0;
  std::uint64_t wrong_length = 0;  // datagrams that are no struct canfd_frame, frames longer than eight bytes, or without a 29-bit id
  std::uint64_t send_failed = 0;
};

class Transport {
 public:
  Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;
  ~Transport();

  // Empty when open; otherwise one line with the address and what is wrong.
  std::string open(const std::string& address);
  bool send(const berm_can_frame& frame);
  // In their order, by as few calls of the system as it allows; whether all went.
  bool send(const berm_can_frame* frames, int count);
  // The next frame already here. False when there is none.
  bool receive(berm_can_frame& frame);
  // Waits at most this long for a frame; a signal ends the wait early.
  bool receive(berm_can_frame& frame, int timeout_ms);
  int fd() const { return fd_; }
  const TransportCounters& counters() const { return counters_; }

 private:
  static constexpr int kBatch = 32;  // frames that one call of the system takes

  bool send_batch(const berm_can_frame* frames, int count);
  std::string open_multicast(const std::string& group, int port);
  std::string open_socketcan(const std::string& interface);

  int fd_ = -1;
  bool multicast_ = false;
  bool segments_ = true;  // the system cuts one message into datagrams; until it says that it does not
  sockaddr_in group_{};
  datagram::Waiting waiting_;
  TransportCounters counters_;
};

}  // namespace berm::can
