// What is out of its range is neither encoded nor decoded, and leaves everything as it was.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "sample_packet.hpp"

namespace {

struct Change {
  const char* what;
  std::function<void(berm_scan_packet&)> apply;
  bool good;
};

std::vector<Change> changes() {
  using P = berm_scan_packet;
  return {
      {"scanner 0", [](P& p) { p.scanner = 0; }, true},
      {"scanner 2", [](P& p) { p.scanner = 2; }, false},
      {"scanner 255", [](P& p) { p.scanner = 255; }, false},
      {"all flags", [](P& p) { p.flags = 15; }, true},
      {"unknown flag", [](P& p) { p.flags = 16; }, false},
      {"highest flag", [](P& p) { p.flags = 0x8000; }, false},
      {"count 1", [](P& p) { p.count = 1; }, true},
      {"count 0", [](P& p) { p.count = 0; }, false},
      {"count 121", [](P& p) { p.count = 121; }, false},
      {"count 65535", [](P& p) { p.count = 65535; }, false},
      {"samples end at the revolution", [](P& p) { p.first_index = 280; }, true},
      {"samples go past the revolution", [](P& p) { p.first_index = 281; }, false},
      {"first index that wraps with count", [](P& p) { p.first_index = 65535; }, false},
      {"no samples a revolution", [](P& p) { p.samples_per_revolution = 0; }, false},
      {"most samples a revolution", [](P& p) { p.samples_per_revolution = 65535; }, true},
      {"echoes 0", [](P& p) { p.echoes_per_sample = 0; }, false},
      {"echoes 1", [](P& p) { p.echoes_per_sample = 1; }, true},
      {"echoes 4", [](P& p) { p.echoes_per_sample = 4; }, false},
      {"echoes 255", [](P& p) { p.echoes_per_sample = 255; }, false},
      {"window 100", [](P& p) { p.window_percent = 100; }, true},
      {"window 101", [](P& p) { p.window_percent = 101; }, false},
      {"period 0", [](P& p) { p.sample_period_ns = 0; }, false},
      {"period 10 ms", [](P& p) { p.sample_period_ns = 10000000; }, true},
      {"period above 10 ms", [](P& p) { p.sample_period_ns = 10000001; }, false},
      {"pan one turn", [](P& p) { p.pan_start_urad = -6283186; }, true},
      {"pan start below one turn", [](P& p) { p.pan_start_urad = -6283187; }, false},
      {"pan start above", [](P& p) { p.pan_start_urad = INT32_MAX; }, false},
      {"pan end above one turn", [](P& p) { p.pan_end_urad = 6283187; }, false},
      {"pan end below", [](P& p) { p.pan_end_urad = INT32_MIN; }, false},
      {"latest time", [](P& p) { p.time_us = INT64_MAX; }, true},
      {"time that is no int64", [](P& p) { p.time_us = 1ULL << 63; }, false},
  };
}

// Writes the header's fields over a good datagram of the same size and puts the CRC right: what a faulty sender would send.
std::vector<std::uint8_t> forged(const berm_scan_packet& fields) {
  const berm_scan_packet good = sample_packet();
  std::vector<std::uint8_t> bytes(BERM_SCAN_PACKET_MAX_BYTES);
  bytes.resize(berm_scan_encode(&good, bytes.data()));
  const auto put = [&bytes](std::size_t place, std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) bytes[place + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(value >> (8 * i));
  };
  put(5, fields.scanner, 1);
  put(6, fields.flags, 2);
  put(16, fields.time_us, 8);
  put(24, fields.sample_period_ns, 4);
  put(28, static_cast<std::uint32_t>(fields.pan_start_urad), 4);
  put(32, static_cast<std::uint32_t>(fields.pan_end_urad), 4);
  put(36, fields.first_index, 2);
  put(38, fields.samples_per_revolution, 2);
  put(40, fields.count, 2);
  put(42, fields.echoes_per_sample, 1);
  put(43, fields.window_percent, 1);
  put(bytes.size() - 4, berm_crc32c(bytes.data(), bytes.size() - 4), 4);
  return bytes;
}

bool untouched(const berm_scan_packet& p) {
  berm_scan_packet before;
  std::memset(&before, 0x5A, sizeof before);
  return std::memcmp(&p, &before, sizeof p) == 0;
}

// verifies: IF-SC-4, IF-SC-6
TEST(ScanRefusals, FieldsOutOfTheirRange) {
  for (const Change& change : changes()) {
    berm_scan_packet p = sample_packet();
    change.apply(p);
    std::vector<std::uint8_t> out(BERM_SCAN_PACKET_MAX_BYTES, 0xEE);
    const std::size_t n = berm_scan_encode(&p, out.data());
    EXPECT_EQ(n > 0, change.good) << change.what;
    if (!change.good) {
      EXPECT_EQ(out, std::vector<std::uint8_t>(BERM_SCAN_PACKET_MAX_BYTES, 0xEE)) << change.what << ": wrote";
    }
    const std::vector<std::uint8_t> bytes = forged(p);
    berm_scan_packet in;
    std::memset(&in, 0x5A, sizeof in);
    const int result = berm_scan_decode(bytes.data(), bytes.size(), &in);
    const bool same_size = p.count == BERM_SCAN_PACKET_SAMPLES && p.echoes_per_sample == BERM_SCAN_ECHOES;
    EXPECT_EQ(result, !change.good ? BERM_SCAN_FIELD : same_size ? BERM_SCAN_OK : BERM_SCAN_LENGTH) << change.what;
    EXPECT_EQ(untouched(in), result != BERM_SCAN_OK) << change.what;
  }
}

// verifies: IF-SC-4, IF-SC-6
TEST(ScanRefusals, ReservedBytes) {
  for (std::size_t i = 44; i < BERM_SCAN_HEADER_BYTES; ++i) {
    std::vector<std::uint8_t> bytes = forged(sample_packet());
    bytes[i] = 1;
    const std::uint32_t crc = berm_crc32c(bytes.data(), bytes.size() - 4);
    for (std::size_t k = 0; k < 4; ++k) bytes[bytes.size() - 4 + k] = static_cast<std::uint8_t>(crc >> (8 * k));
    berm_scan_packet in;
    std::memset(&in, 0x5A, sizeof in);
    EXPECT_EQ(berm_scan_decode(bytes.data(), bytes.size(), &in), BERM_SCAN_FIELD) << i;
    EXPECT_TRUE(untouched(in));
  }
}

// verifies: IF-SC-6
TEST(ScanRefusals, EveryLengthButTheRightOne) {
  for (const auto& [count, echoes] : {std::pair<int, int>{1, 1}, {2, 3}, {60, 2}, {120, 3}}) {
    const berm_scan_packet p = sample_packet(static_cast<std::uint16_t>(count), static_cast<std::uint8_t>(echoes));
    std::vector<std::uint8_t> bytes(2 * BERM_SCAN_PACKET_MAX_BYTES);
    const std::size_t right = berm_scan_encode(&p, bytes.data());
    for (std::size_t n = 0; n <= bytes.size(); ++n) {
      berm_scan_packet in;
      std::memset(&in, 0x5A, sizeof in);
      const int result = berm_scan_decode(bytes.data(), n, &in);
      EXPECT_EQ(result == BERM_SCAN_OK, n == right) << n;
      EXPECT_EQ(untouched(in), n != right) << n;
    }
  }
}

// A cut datagram whose CRC was put right again is still refused by its length.
// verifies: IF-SC-6
TEST(ScanRefusals, CutOffWithARightCrc) {
  const berm_scan_packet p = sample_packet(10, 2);
  std::vector<std::uint8_t> whole(BERM_SCAN_PACKET_MAX_BYTES);
  const std::size_t right = berm_scan_encode(&p, whole.data());
  for (std::size_t body = 0; body + 4 <= BERM_SCAN_PACKET_MAX_BYTES; ++body) {
    if (body + 4 == right) continue;
    std::vector<std::uint8_t> bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(body));
    const std::uint32_t crc = berm_crc32c(bytes.data(), body);
    for (int k = 0; k < 4; ++k) bytes.push_back(static_cast<std::uint8_t>(crc >> (8 * k)));
    berm_scan_packet in;
    std::memset(&in, 0x5A, sizeof in);
    EXPECT_EQ(berm_scan_decode(bytes.data(), bytes.size(), &in), BERM_SCAN_LENGTH) << body;
    EXPECT_TRUE(untouched(in));
  }
}

// verifies: IF-SC-6
TEST(ScanRefusals, EveryResultHasAText) {
  std::vector<std::string> texts;
  for (int result = BERM_SCAN_OK; result <= BERM_SCAN_FIELD; ++result) {
    for (const std::string& other : texts) EXPECT_NE(berm_scan_result_text(result), other);
    texts.push_back(berm_scan_result_text(result));
  }
  EXPECT_STREQ(berm_scan_result_text(-1), berm_scan_result_text(99));
}

}  // namespace
