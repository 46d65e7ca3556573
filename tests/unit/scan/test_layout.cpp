// The bytes on the wire, place by place, as SCAN.md has them.
#include <gtest/gtest.h>

#include <vector>

#include "sample_packet.hpp"

namespace {

std::uint64_t at(const std::vector<std::uint8_t>& bytes, std::size_t place, int count) {
  std::uint64_t value = 0;
  for (int i = count - 1; i >= 0; --i) value = value << 8 | bytes[place + static_cast<std::size_t>(i)];
  return value;
}

// verifies: IF-SC-1, IF-SC-2, IF-SC-3, IF-SC-5
TEST(ScanLayout, EveryFieldAtItsPlaceLittleEndian) {
  const berm_scan_packet p = sample_packet(100, 2);
  std::vector<std::uint8_t> bytes(BERM_SCAN_PACKET_MAX_BYTES);
  ASSERT_EQ(berm_scan_encode(&p, bytes.data()), 56u + 100 * 2 * 2 + 4);
  EXPECT_EQ(at(bytes, 0, 4), 0x4E435342u);
  EXPECT_EQ(std::string(bytes.begin(), bytes.begin() + 4), "BSCN");
  EXPECT_EQ(bytes[4], 1);
  EXPECT_EQ(bytes[5], p.scanner);
  EXPECT_EQ(at(bytes, 6, 2), p.flags);
  EXPECT_EQ(at(bytes, 8, 4), p.sequence);
  EXPECT_EQ(at(bytes, 12, 4), p.scanline);
  EXPECT_EQ(at(bytes, 16, 8), p.time_us);
  EXPECT_EQ(at(bytes, 24, 4), p.sample_period_ns);
  EXPECT_EQ(static_cast<std::int32_t>(at(bytes, 28, 4)), p.pan_start_urad);
  EXPECT_EQ(static_cast<std::int32_t>(at(bytes, 32, 4)), p.pan_end_urad);
  EXPECT_EQ(at(bytes, 36, 2), p.first_index);
  EXPECT_EQ(at(bytes, 38, 2), p.samples_per_revolution);
  EXPECT_EQ(at(bytes, 40, 2), p.count);
  EXPECT_EQ(bytes[42], p.echoes_per_sample);
  EXPECT_EQ(bytes[43], p.window_percent);
  for (std::size_t i = 44; i < 56; ++i) EXPECT_EQ(bytes[i], 0) << i;
  for (int i = 0; i < 100; ++i)
    for (int e = 0; e < 2; ++e) EXPECT_EQ(at(bytes, static_cast<std::size_t>(56 + 2 * (2 * i + e)), 2), p.range[i][e]);
  EXPECT_EQ(at(bytes, 456, 4), berm_crc32c(bytes.data(), 456));
}

}  // namespace
