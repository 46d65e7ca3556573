// Datagrams on a port of 127.0.0.1, without blocking.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "datagram/datagrams.hpp"

namespace berm::kernel {

class UdpReceiver {
 public:
  UdpReceiver() = default;
  ~UdpReceiver();
  UdpReceiver(const UdpReceiver&) = delete;
  UdpReceiver& operator=(const UdpReceiver&) = delete;

  bool open(std::uint16_t port, std::string& error);
  bool is_open() const { return fd_ >= 0; }
  int fd() const { return fd_; }
  // Next datagram: its true length, which may exceed capacity (then it is cut), or -1 when none waits.
  ssize_t receive(std::uint8_t* bytes, std::size_t capacity);

 private:
  int fd_ = -1;
  datagram::Waiting waiting_;
};

}  // namespace berm::kernel
