// Any datagram, in a block of memory just as long as it is: decoded into what can be encoded again, or refused and nothing changed. BERM_SAMPLES sets the number.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <random>
#include <vector>

#include "sample_packet.hpp"

namespace {

constexpr std::size_t kCrcBytes = 4;

// So that what stands before it is looked at.
void make_crc_right(std::vector<std::uint8_t>& bytes) {
  if (bytes.size() < kCrcBytes) return;
  const std::size_t n = bytes.size() - kCrcBytes;
  const std::uint32_t crc = berm_crc32c(bytes.data(), n);
  for (std::size_t i = 0; i < kCrcBytes; ++i) bytes[n + i] = static_cast<std::uint8_t>(crc >> (8 * i));
}

// verifies: IF-SC-6
TEST(ScanFuzz, AnyBytes) {
  const char* samples = std::getenv("BERM_SAMPLES");
  const int count = samples != nullptr ? std::atoi(samples) : 20000;
  constexpr unsigned kSeed = 7;
  std::mt19937 random(kSeed);
  const auto draw = [&random](std::size_t below) { return static_cast<std::size_t>(random() % below); };
  int accepted = 0;
  for (int i = 0; i < count; ++i) {
    const berm_scan_packet whole = sample_packet(static_cast<std::uint16_t>(1 + draw(BERM_SCAN_PACKET_SAMPLES)), static_cast<std::uint8_t>(1 + draw(BERM_SCAN_ECHOES)));
    std::vector<std::uint8_t> bytes(BERM_SCAN_PACKET_MAX_BYTES);
    bytes.resize(berm_scan_encode(&whole, bytes.data()));
    for (std::size_t edits = draw(3); edits > 0 && !bytes.empty(); --edits) {
      const std::size_t at = draw(draw(2) == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), BERM_SCAN_HEADER_BYTES));
      if (draw(4) == 0) bytes.resize(draw(2) == 0 ? at : bytes.size() + draw(9));
      else bytes[at] = static_cast<std::uint8_t>(random());
    }
    if (draw(8) != 0) make_crc_right(bytes);
    bytes.shrink_to_fit();
    berm_scan_packet in, before;
    std::memset(&before, 0x5A, sizeof before);
    std::memcpy(&in, &before, sizeof in);
    if (berm_scan_decode(bytes.data(), bytes.size(), &in) == BERM_SCAN_OK) {
      ++accepted;
      std::vector<std::uint8_t> again(BERM_SCAN_PACKET_MAX_BYTES);
      again.resize(berm_scan_encode(&in, again.data()));
      ASSERT_EQ(again, bytes) << "datagram " << i << " of seed " << kSeed;
    } else {
      ASSERT_EQ(std::memcmp(&in, &before, sizeof in), 0) << "datagram " << i << " of seed " << kSeed;
    }
  }
  EXPECT_GT(accepted, count / 10);
  EXPECT_LT(accepted, count * 9 / 10);
}

}  // namespace
