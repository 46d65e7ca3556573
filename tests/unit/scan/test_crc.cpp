// Both CRCs against their published check values.
#include <gtest/gtest.h>

#include <cstring>

#include "scan/scan_packet.h"

namespace {

const auto* kCheck = reinterpret_cast<const std::uint8_t*>("123456789");

TEST(Crc, Ieee) {  // verifies: IF-CAN-11
  EXPECT_EQ(berm_crc32(kCheck, 9), 0xCBF43926u);
  EXPECT_EQ(berm_crc32(kCheck, 0), 0u);
}

TEST(Crc, Castagnoli) {  // verifies: IF-SC-5
  EXPECT_EQ(berm_crc32c(kCheck, 9), 0xE3069283u);
  std::uint8_t bytes[32];  // RFC 3720, B.4
  std::memset(bytes, 0, sizeof bytes);
  EXPECT_EQ(berm_crc32c(bytes, sizeof bytes), 0x8A9136AAu);
  std::memset(bytes, 0xFF, sizeof bytes);
  EXPECT_EQ(berm_crc32c(bytes, sizeof bytes), 0x62A8AB43u);
}

}  // namespace
