// Any bytes as a packet of the VLP-16, in a block of memory just as long as they are: returns within what the decoder says, or a refusal that changes
// nothing. BERM_SAMPLES sets the number.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <random>
#include <vector>

#include "io/vlp16.hpp"

namespace berm::kernel {
namespace {

constexpr std::size_t kBlockBytes = 100, kModeOffset = 1204;

std::vector<std::uint8_t> packet(std::uint8_t mode, std::mt19937& random) {
  std::vector<std::uint8_t> bytes(kVlp16PacketBytes);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  const std::uint32_t first = static_cast<std::uint32_t>(random()) % 36000U, step = static_cast<std::uint32_t>(random()) % 300U;
  for (std::size_t block = 0; block < kVlp16Blocks; ++block) {
    const std::size_t at = block * kBlockBytes;
    const std::uint32_t turn = (first + step * static_cast<std::uint32_t>(mode == 0x39 ? block / 2 : block)) % 36000U;
    bytes[at] = 0xFF;
    bytes[at + 1] = 0xEE;
    bytes[at + 2] = static_cast<std::uint8_t>(turn);
    bytes[at + 3] = static_cast<std::uint8_t>(turn >> 8);
  }
  bytes[kModeOffset] = mode;
  bytes[kModeOffset + 1] = 0x22;
  return bytes;
}

void expect_sound(const std::vector<std::uint8_t>& bytes, const Vlp16Packet& decoded) {
  ASSERT_EQ(decoded.firings, vlp16_firings(bytes.data()));
  ASSERT_TRUE(decoded.count >= 0 && decoded.count <= decoded.firings * kVlp16Channels);
  for (int i = 0; i < decoded.count; ++i) {
    const Vlp16Return& p = decoded.point[i];
    ASSERT_TRUE(p.channel < kVlp16Channels && p.firing < decoded.firings && p.azimuth_mdeg < kVlp16TurnMdeg && p.range_mm >= kVlp16RangeMinMm);
    vlp16_project({}, p);
  }
  for (int firing = 0; firing < decoded.firings; ++firing) ASSERT_LT(vlp16_firing(bytes.data(), firing).azimuth_mdeg, kVlp16TurnMdeg);
  for (int block = 0; block < kVlp16Blocks; ++block) ASSERT_LT(vlp16_block_mdeg(bytes.data(), block), kVlp16TurnMdeg);
  vlp16_clock_us(bytes.data());
}

TEST(Vlp16Fuzz, AnyBytes) {
  const char* samples = std::getenv("BERM_SAMPLES");
  const int count = samples != nullptr ? std::atoi(samples) : 10000;
  constexpr unsigned kSeed = 9;
  std::mt19937 random(kSeed);
  constexpr std::uint8_t kModes[] = {0x37, 0x38, 0x39};
  int accepted = 0;
  for (int i = 0; i < count; ++i) {
    std::vector<std::uint8_t> bytes = packet(kModes[random() % 3], random);
    for (std::uint32_t edits = static_cast<std::uint32_t>(random()) % 4U; edits > 0 && !bytes.empty(); --edits) {
      const std::size_t at = random() % bytes.size();
      if (random() % 8 == 0) bytes.resize(random() % 2 == 0 ? at : bytes.size() + random() % 9);
      else bytes[random() % 2 == 0 ? at : std::min(bytes.size() - 1, at / kBlockBytes * kBlockBytes + random() % 4)] = static_cast<std::uint8_t>(random());
    }
    bytes.shrink_to_fit();
    Vlp16Packet decoded, before;
    std::memset(static_cast<void*>(&before), 0x5A, sizeof before);
    std::memcpy(static_cast<void*>(&decoded), &before, sizeof decoded);
    if (vlp16_decode(bytes.data(), bytes.size(), decoded) == Vlp16Result::kOk) {
      ++accepted;
      expect_sound(bytes, decoded);
    } else {
      ASSERT_EQ(std::memcmp(&decoded, &before, sizeof decoded), 0);
    }
    if (testing::Test::HasFatalFailure()) {
      ADD_FAILURE() << "packet " << i << " of seed " << kSeed;
      return;
    }
  }
  EXPECT_GT(accepted, count / 10);
  EXPECT_LT(accepted, count * 9 / 10);
}

}  // namespace
}  // namespace berm::kernel
