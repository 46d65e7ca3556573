// Packets of sensors over level ground, with what lies on a window and dust drawn in.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>

#include "io/lidar_mount.hpp"
#include "io/vlp16.hpp"
#include "scan/scan_packet.h"

namespace berm::kernel::test {

constexpr double kTurn = 2.0 * 3.14159265358979323846;
using Vlp16Bytes = std::array<std::uint8_t, kVlp16PacketBytes>;

// Echoes, nearest first, mm.
struct Shot {
  double echo_mm[2] = {0.0, 0.0};
};

// A whole turn of a panning scanner, in packets of 100 samples. shot: of a mirror's angle (rad) and the sine of its elevation.
inline void turn_of(std::uint8_t scanner, double pan_rad, std::uint64_t time_us, const std::function<Shot(double, double)>& shot,
                    const std::function<void(const berm_scan_packet&)>& take) {
  for (std::uint16_t first = 0; first < 400; first = static_cast<std::uint16_t>(first + 100)) {
    berm_scan_packet p{};
    p.scanner = scanner;
    p.time_us = time_us + first * 83U;
    p.sample_period_ns = 83333;
    p.pan_start_urad = p.pan_end_urad = static_cast<std::int32_t>(std::lround(pan_rad * 1e6));
    p.first_index = first;
    p.samples_per_revolution = 400;
    p.count = 100;
    p.echoes_per_sample = 2;
    for (int i = 0; i < 100; ++i) {
      const double mirror = kTurn * (first + i) / 400.0;
      const Shot s = shot(mirror, std::sin(mirror));
      for (int k = 0; k < 2; ++k) p.range[i][k] = static_cast<std::uint16_t>(std::lround(s.echo_mm[k] / BERM_SCAN_RANGE_LSB_MM));
    }
    take(p);
  }
}

// A packet of a VLP-16 from this azimuth on. shot: of an azimuth (degrees) and the elevation's channel.
inline Vlp16Bytes vlp16_packet(std::uint32_t clock_us, double from_deg, bool dual, const std::function<Shot(double, int)>& shot) {
  constexpr int kChannel[kVlp16Channels] = {0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15};
  Vlp16Bytes b{};
  const auto put = [&](std::size_t at, unsigned v) {
    b[at] = static_cast<std::uint8_t>(v & 0xFF);
    b[at + 1] = static_cast<std::uint8_t>(v >> 8);
  };
  const int step = dual ? 2 : 1;
  for (int block = 0; block < 12; block += step) {
    const double azimuth = std::fmod(from_deg + 0.4 * (block / step), 360.0);
    Shot shots[2 * kVlp16Channels];
    for (int k = 0; k < 2 * kVlp16Channels; ++k) shots[k] = shot(azimuth, kChannel[k % kVlp16Channels]);
    for (int side = 0; side < step; ++side) {
      const std::size_t at = 100 * static_cast<std::size_t>(block + side);
      put(at, 0xEEFF);
      put(at + 2, static_cast<unsigned>(std::lround(azimuth * 100)) % 36000);
      for (int k = 0; k < 2 * kVlp16Channels; ++k) {
        const Shot& s = shots[k];
        // The last return in the even block, the strongest but it in the odd one: the last again where there is none.
        const double last = std::max(s.echo_mm[0], s.echo_mm[1]), nearer = std::min(s.echo_mm[0], s.echo_mm[1]), other = nearer > 0 ? nearer : last;
        put(at + 4 + 3 * static_cast<std::size_t>(k), static_cast<unsigned>(std::lround((side == 0 ? last : other) / 2.0)));
      }
    }
  }
  for (std::size_t i = 0; i < 4; ++i) b[1200 + i] = static_cast<std::uint8_t>(clock_us >> (8 * i));
  b[1204] = dual ? 0x39 : 0x37;
  b[1205] = 0x22;
  return b;
}

// How far down a lidar's beam looks: z of its direction, upper body's frame.
inline double beam_z(const LidarMount& mount, double azimuth_deg, int channel) {
  const double e = (-15.0 + 2.0 * channel) * kTurn / 360.0, a = azimuth_deg * kTurn / 360.0;
  return (mount.turn * Eigen::Vector3d(std::cos(e) * std::cos(a), -std::cos(e) * std::sin(a), std::sin(e))).z();
}

}  // namespace berm::kernel::test
