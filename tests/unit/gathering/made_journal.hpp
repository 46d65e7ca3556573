// A journal made in a test: two scanners in a room, panned and swung while their mirrors turn; by SCAN.md's and JOURNAL.md's own words.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "config/compile_parameters.hpp"
#include "core/sk_common.h"
#include "record/journal_file.hpp"
#include "scan/scan_packet.h"
#include "scratch.hpp"

namespace berm::app::made_journal {

constexpr double kTurn = 2.0 * 3.14159265358979323846;
constexpr int kSamples = 400, kPacket = 100;
constexpr double kHead[2][3] = {{0.4, 0.9, 2.6}, {0.4, -0.9, 2.6}};
constexpr double kSwingRate = 0.5, kPanRate = 0.8;  // rad/s
constexpr std::int64_t kCycleUs = 10'000, kPeriodNs = 83'333;

inline berm_journal_start start_of_run() {
  berm_journal_start start{};
  start.version = BERM_JOURNAL_VERSION;
  start.contract_version = BERM_CONTRACT_VERSION;
  start.cell_mm = SK_CELL_MM;
  berm_parameters& p = start.parameters;
  p.magic = BERM_PARAMETERS_MAGIC;
  p.version = BERM_PARAMETERS_VERSION;
  p.size = sizeof p;
  p.range_min_mm = 500;
  p.range_max_mm = 80'000;
  p.own_body_radius_mm = 2'500;
  for (int s = 0; s < 2; ++s) {
    p.scanner[s].x_mm = static_cast<std::int32_t>(kHead[s][0] * 1000.0);
    p.scanner[s].y_mm = static_cast<std::int32_t>(kHead[s][1] * 1000.0);
    p.scanner[s].z_mm = static_cast<std::int32_t>(kHead[s][2] * 1000.0);
  }
  p.crc32 = config::parameters_crc(p);
  return start;
}

// A room: ground at 0, walls 9 m ahead, behind and beside, all as far as a ray from inside goes.
inline double range_in_room(const double (&from)[3], const double (&to)[3]) {
  double range = 1e9;
  for (int i = 0; i < 2; ++i)
    if (std::fabs(to[i]) > 1e-9) range = std::min(range, ((to[i] > 0.0 ? 9.0 : -9.0) - from[i]) / to[i]);
  if (to[2] < -1e-9) range = std::min(range, -from[2] / to[2]);
  return range;
}

inline berm_scan_packet packet_at(int scanner, std::uint32_t scanline, int first, std::int64_t time_us) {
  berm_scan_packet packet{};
  packet.scanner = static_cast<std::uint8_t>(scanner);
  packet.scanline = scanline;
  packet.flags = static_cast<std::uint16_t>((first == 0 ? BERM_SCAN_FLAG_FIRST : 0) | (first + kPacket == kSamples ? BERM_SCAN_FLAG_LAST : 0));
  packet.time_us = static_cast<std::uint64_t>(time_us);
  packet.sample_period_ns = kPeriodNs;
  packet.first_index = static_cast<std::uint16_t>(first);
  packet.samples_per_revolution = kSamples;
  packet.count = kPacket;
  packet.echoes_per_sample = 2;
  const auto pan_at = [&](int i) { return kPanRate * (static_cast<double>(time_us) * 1e-6 + static_cast<double>(kPeriodNs) * i * 1e-9) - 0.3; };
  packet.pan_start_urad = static_cast<std::int32_t>(std::lround(pan_at(0) * 1e6));
  packet.pan_end_urad = static_cast<std::int32_t>(std::lround(pan_at(kPacket - 1) * 1e6));
  for (int i = 0; i < kPacket; ++i) {
    const double e = kTurn * (first + i) / kSamples, pan = pan_at(i);
    const double swing_rad = kSwingRate * (static_cast<double>(time_us) * 1e-6 + static_cast<double>(kPeriodNs) * i * 1e-9);
    const double c = std::cos(swing_rad), s = std::sin(swing_rad), *head = kHead[scanner];
    const double ahead = std::cos(e) * std::cos(pan), left = std::cos(e) * std::sin(pan);
    const double from[3] = {head[0] * c - head[1] * s, head[0] * s + head[1] * c, head[2]}, to[3] = {ahead * c - left * s, ahead * s + left * c, std::sin(e)};
    const double range = range_in_room(from, to);
    packet.range[i][1] = range < 200.0 ? static_cast<std::uint16_t>(std::lround(range * 1000.0 / BERM_SCAN_RANGE_LSB_MM)) : 0;
    packet.range[i][0] = packet.range[i][1] / 2;  // dust before it: the farthest echo counts
  }
  return packet;
}

using Bytes = std::vector<std::uint8_t>;

inline Bytes record_of(std::uint64_t cycle, std::uint32_t confirmed_ms, const std::vector<berm_scan_packet>& packets) {
  berm_journal_cycle head{};
  head.magic = BERM_JOURNAL_RECORD_MAGIC;
  head.sequence = head.cycle = cycle;
  head.now_us = head.state.time_us = static_cast<std::int64_t>(cycle) * kCycleUs;
  head.state.joint_angle_urad[BERM_SWING] = static_cast<std::int32_t>(std::lround(std::remainder(kSwingRate * static_cast<double>(head.now_us) * 1e-6, kTurn) * 1e6));
  head.state.joint_velocity_urad_s[BERM_SWING] = static_cast<std::int32_t>(kSwingRate * 1e6);
  head.state.terrain_confirmed_ms = confirmed_ms;
  head.scan_packets = static_cast<std::uint16_t>(packets.size());
  Bytes bytes(sizeof head);
  for (const berm_scan_packet& p : packets) {
    const berm_journal_scan scan{p.time_us,        p.sequence,    p.scanline, p.sample_period_ns, p.pan_start_urad, p.pan_end_urad, p.flags, p.first_index,
                                 p.samples_per_revolution, p.count, p.scanner,  p.echoes_per_sample, p.window_percent, 0};
    const auto* at = reinterpret_cast<const std::uint8_t*>(&scan);
    bytes.insert(bytes.end(), at, at + sizeof scan);
    for (int i = 0; i < p.count; ++i)
      for (int echo = 0; echo < p.echoes_per_sample; ++echo)
        for (int byte = 0; byte < 2; ++byte) bytes.push_back(static_cast<std::uint8_t>(p.range[i][echo] >> (8 * byte)));
    bytes.resize((bytes.size() + 7) / 8 * 8);
  }
  head.bytes = static_cast<std::uint32_t>(bytes.size());
  std::memcpy(bytes.data(), &head, sizeof head);
  return bytes;
}

// One packet of each scanner a cycle: what was measured in the 10 ms before, from 1 s on. anew: the cycle in which the kernel's map begins anew.
inline std::vector<Bytes> records(int cycles, int anew = -1) {
  std::vector<Bytes> all;
  for (int k = 0; k < cycles; ++k) {
    const int cycle = 100 + k, first = (cycle * kPacket) % kSamples;
    std::vector<berm_scan_packet> packets;
    for (int scanner = 0; scanner < 2; ++scanner) packets.push_back(packet_at(scanner, static_cast<std::uint32_t>(cycle * kPacket / kSamples), first, (cycle - 1) * kCycleUs));
    all.push_back(record_of(static_cast<std::uint64_t>(cycle), k < 10 || k == anew ? UINT32_MAX : 5U, packets));
  }
  return all;
}

inline std::string written(const berm::test::Scratch& scratch, const char* name, const std::vector<Bytes>& all, const berm_journal_start& start = start_of_run()) {
  const std::string path = scratch.path(name);
  std::FILE* out = std::fopen(path.c_str(), "wb");
  record::JournalFile file(fileno(out));
  EXPECT_TRUE(file.begin(start));
  for (const Bytes& bytes : all) EXPECT_TRUE(file.cycle(bytes.data(), bytes.size()));
  EXPECT_TRUE(file.end(all.size()));
  std::fclose(out);
  return path;
}

}  // namespace berm::app::made_journal
