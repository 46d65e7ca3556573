// Whatever packet is in range comes back field by field; whatever bytes are decoded encode to the same bytes. A failure prints its seed
// (RC_PARAMS="seed=..." repeats it).
#include <gtest/gtest.h>

#include <rapidcheck.h>

#include <cstring>
#include <vector>

#include "scan/scan_packet.h"

namespace {

rc::Gen<berm_scan_packet> packets() {
  return rc::gen::exec([] {
    berm_scan_packet p{};
    p.scanner = *rc::gen::element<std::uint8_t>(0, 1);
    p.flags = *rc::gen::inRange<std::uint16_t>(0, 16);
    p.sequence = *rc::gen::arbitrary<std::uint32_t>();
    p.scanline = *rc::gen::arbitrary<std::uint32_t>();
    p.time_us = *rc::gen::arbitrary<std::uint64_t>() >> 1;
    p.sample_period_ns = *rc::gen::inRange<std::uint32_t>(1, 10000001);
    p.pan_start_urad = *rc::gen::inRange<std::int32_t>(-6283186, 6283187);
    p.pan_end_urad = *rc::gen::inRange<std::int32_t>(-6283186, 6283187);
    p.count = *rc::gen::inRange<std::uint16_t>(1, BERM_SCAN_PACKET_SAMPLES + 1);
    p.samples_per_revolution = static_cast<std::uint16_t>(*rc::gen::inRange<int>(p.count, 65536));
    p.first_index = static_cast<std::uint16_t>(*rc::gen::inRange<int>(0, p.samples_per_revolution - p.count + 1));
    p.echoes_per_sample = *rc::gen::inRange<std::uint8_t>(1, BERM_SCAN_ECHOES + 1);
    p.window_percent = *rc::gen::inRange<std::uint8_t>(0, 101);
    const auto ranges = *rc::gen::container<std::vector<std::uint16_t>>(static_cast<std::size_t>(p.count) * p.echoes_per_sample, rc::gen::arbitrary<std::uint16_t>());
    std::size_t next = 0;
    for (int i = 0; i < p.count; ++i)
      for (int e = 0; e < p.echoes_per_sample; ++e) p.range[i][e] = ranges[next++];
    return p;
  });
}

bool same(const berm_scan_packet& a, const berm_scan_packet& b) {
  return a.scanner == b.scanner && a.flags == b.flags && a.sequence == b.sequence && a.scanline == b.scanline && a.time_us == b.time_us &&
         a.sample_period_ns == b.sample_period_ns && a.pan_start_urad == b.pan_start_urad && a.pan_end_urad == b.pan_end_urad &&
         a.first_index == b.first_index && a.samples_per_revolution == b.samples_per_revolution && a.count == b.count &&
         a.echoes_per_sample == b.echoes_per_sample && a.window_percent == b.window_percent && std::memcmp(a.range, b.range, sizeof a.range) == 0;
}

// verifies: IF-SC-1, IF-SC-4
TEST(ScanRoundTrip, PacketToBytesAndBack) {
  EXPECT_TRUE(rc::check("every packet in range comes back", [] {
    const berm_scan_packet p = *packets();
    std::vector<std::uint8_t> bytes(BERM_SCAN_PACKET_MAX_BYTES);
    const std::size_t n = berm_scan_encode(&p, bytes.data());
    RC_ASSERT(n == 60u + 2u * p.count * p.echoes_per_sample);
    berm_scan_packet back;
    std::memset(&back, 0xA5, sizeof back);
    RC_ASSERT(berm_scan_decode(bytes.data(), n, &back) == BERM_SCAN_OK);
    RC_ASSERT(same(p, back));
    std::vector<std::uint8_t> again(BERM_SCAN_PACKET_MAX_BYTES);
    RC_ASSERT(berm_scan_encode(&back, again.data()) == n);
    RC_ASSERT(again == bytes);
  }));
}

// verifies: IF-SC-6
TEST(ScanRoundTrip, ArbitraryBytesWithARightCrcAreRefusedOrEncodeToThemselves) {
  EXPECT_TRUE(rc::check("no two byte strings mean the same packet", [] {
    const berm_scan_packet p = *packets();
    std::vector<std::uint8_t> bytes(BERM_SCAN_PACKET_MAX_BYTES);
    const std::size_t n = berm_scan_encode(&p, bytes.data());
    bytes.resize(n);
    const auto flips = *rc::gen::container<std::vector<std::size_t>>(3, rc::gen::inRange<std::size_t>(0, 8 * (n - 4)));
    for (const std::size_t bit : flips) bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1u << (bit % 8)));
    const std::uint32_t crc = berm_crc32c(bytes.data(), n - 4);
    for (std::size_t k = 0; k < 4; ++k) bytes[n - 4 + k] = static_cast<std::uint8_t>(crc >> (8 * k));
    berm_scan_packet in{};
    const int result = berm_scan_decode(bytes.data(), n, &in);
    if (result != BERM_SCAN_OK) return;
    std::vector<std::uint8_t> again(BERM_SCAN_PACKET_MAX_BYTES);
    again.resize(berm_scan_encode(&in, again.data()));
    RC_ASSERT(again == bytes);
  }));
}

}  // namespace
