// UDP payloads of a capture file (pcap or pcapng).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace berm::run {

struct CapturedDatagram {
  std::size_t packet;  // its number in the file, from 1
  double time_s;       // capture time
  std::uint16_t destination_port;
  std::vector<std::uint8_t> payload;
};

// Reads the whole file; throws std::runtime_error with one line naming the file and what is wrong: not a capture, truncated, a link layer that
// is none of Ethernet, raw IP and Linux cooked. Fragmented and non-UDP packets are passed over.
std::vector<CapturedDatagram> read_capture(const std::string& path);

}  // namespace berm::run
