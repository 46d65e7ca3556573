#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "core/crc32.h"
#include "scan/scan_packet.h"

namespace {

// verifies: SK-RQ-2, SK-FG-3
TEST(Crc32, CheckValue) {
  const std::uint8_t text[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(sk_crc32(text, 9), 0xCBF43926u);
  EXPECT_EQ(sk_crc32(text, 0), 0u);
}

// The interface's own implementation is another one.
// verifies: SK-RQ-2, SK-FG-3
TEST(Crc32, AgreesWithTheInterfaces) {
  std::mt19937_64 draw(20260101);
  for (std::int32_t n = 0; n <= 300; ++n) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(n) + 1);
    for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(draw());
    EXPECT_EQ(sk_crc32(bytes.data(), n), berm_crc32(bytes.data(), static_cast<std::size_t>(n))) << n << " bytes";
  }
}

}  // namespace
