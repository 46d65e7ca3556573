// Every single bit flip of a datagram of every number of echoes is refused; every double one of a short datagram.
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "sample_packet.hpp"

namespace {

std::vector<std::uint8_t> datagram(int count, int echoes) {
  const berm_scan_packet p = sample_packet(static_cast<std::uint16_t>(count), static_cast<std::uint8_t>(echoes));
  std::vector<std::uint8_t> bytes(BERM_SCAN_PACKET_MAX_BYTES);
  bytes.resize(berm_scan_encode(&p, bytes.data()));
  return bytes;
}

void flip(std::vector<std::uint8_t>& bytes, std::size_t bit) { bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1u << (bit % 8))); }

bool refused_untouched(const std::vector<std::uint8_t>& bytes) {
  berm_scan_packet in, before;
  std::memset(&before, 0x5A, sizeof before);
  std::memcpy(&in, &before, sizeof in);
  return berm_scan_decode(bytes.data(), bytes.size(), &in) != BERM_SCAN_OK && std::memcmp(&in, &before, sizeof in) == 0;
}

// verifies: IF-SC-5, IF-SC-6
TEST(ScanBitFlips, Single) {
  for (int echoes = 1; echoes <= BERM_SCAN_ECHOES; ++echoes) {
    std::vector<std::uint8_t> bytes = datagram(BERM_SCAN_PACKET_SAMPLES, echoes);
    ASSERT_FALSE(refused_untouched(bytes));
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      flip(bytes, bit);
      EXPECT_TRUE(refused_untouched(bytes)) << "echoes " << echoes << " bit " << bit;
      flip(bytes, bit);
    }
  }
}

// verifies: IF-SC-5, IF-SC-6
TEST(ScanBitFlips, Double) {
  std::vector<std::uint8_t> bytes = datagram(1, 1);
  for (std::size_t i = 0; i < 8 * bytes.size(); ++i) {
    flip(bytes, i);
    for (std::size_t k = i + 1; k < 8 * bytes.size(); ++k) {
      flip(bytes, k);
      ASSERT_TRUE(refused_untouched(bytes)) << "bits " << i << ", " << k;
      flip(bytes, k);
    }
    flip(bytes, i);
  }
}

}  // namespace
