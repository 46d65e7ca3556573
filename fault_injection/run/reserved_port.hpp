// A UDP port on loopback that no other run on this computer has or gets, as long as the object lives: kernel and plant open it later, each by its number.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace berm::run {

// One that nobody has bound now.
std::uint16_t free_udp_port();

class ReservedPort {
 public:
  // The first number drawn that no run has reserved. Throws std::system_error when there is none.
  explicit ReservedPort(const std::function<std::uint16_t()>& draw = free_udp_port);
  ~ReservedPort();
  ReservedPort(ReservedPort&& other) noexcept : number_(other.number_), fd_(other.fd_) { other.fd_ = -1; }
  ReservedPort(const ReservedPort&) = delete;
  ReservedPort& operator=(const ReservedPort&) = delete;

  std::uint16_t number() const { return number_; }
  std::string text() const { return std::to_string(number_); }
  // A CAN bus of its own by multicast on loopback: "udp:GROUP:PORT". Sockets of one bus share it, so nothing would tell of two runs on the same.
  std::string can_address() const;

 private:
  std::uint16_t number_ = 0;
  int fd_ = -1;
};

}  // namespace berm::run
