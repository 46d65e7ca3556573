// Values that other programs rely on.
#include <gtest/gtest.h>

#include <cstring>

#include "contract/berm_contract.h"

namespace {

// verifies: IF-CT-3
TEST(ContractValues, MagicReadsBermInMemory) {
  const std::uint32_t magic = BERM_CONTRACT_MAGIC;
  EXPECT_EQ(std::memcmp(&magic, "BERM", 4), 0);
  EXPECT_EQ(BERM_CONTRACT_VERSION, 2u);
}

// verifies: IF-CT-4
TEST(ContractValues, JointOrder) {
  EXPECT_EQ(BERM_SWING, 0);
  EXPECT_EQ(BERM_BOOM, 1);
  EXPECT_EQ(BERM_STICK, 2);
  EXPECT_EQ(BERM_BUCKET, 3);
}

// verifies: IF-CT-9 (its place)
TEST(ContractValues, TheCrcCoversAllBytesBeforeIt) {
  EXPECT_EQ(offsetof(berm_request, crc32), 60u);
  EXPECT_EQ(offsetof(berm_request_segment, request), 64u) << "a cache line away from the lock";
}

}  // namespace
