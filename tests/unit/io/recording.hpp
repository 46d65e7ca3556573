// Recordings of real sensors, read from where they lie; empty where they are absent.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace berm::kernel::test {

inline std::string vlp16_recording(const char* name) {
  const char* folder = std::getenv("BERM_REAL_DATA");
  return std::string(folder != nullptr ? folder : BERM_REAL_DATA) + "/vlp16_dual_return/" + name;
}

inline std::vector<std::uint8_t> bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

template <class T>
T read_at(const std::uint8_t* p) {
  T value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

// UDP payloads of a classic little-endian pcap with Ethernet and IPv4 headers of 42 bytes.
inline std::vector<std::vector<std::uint8_t>> payloads(const std::vector<std::uint8_t>& file) {
  std::vector<std::vector<std::uint8_t>> all;
  for (std::size_t at = 24; at + 16 <= file.size();) {
    const auto length = read_at<std::uint32_t>(&file[at + 8]);
    all.emplace_back(file.begin() + static_cast<std::ptrdiff_t>(at + 16 + 42), file.begin() + static_cast<std::ptrdiff_t>(at + 16 + length));
    at += 16 + length;
  }
  return all;
}

}  // namespace berm::kernel::test
