#include "plant/world/spinning_lidar.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace berm::plant {
namespace {

constexpr std::int64_t firing_ns = 55296;       // of all sixteen lasers, one after the other
constexpr double turns_per_s = 10.0;
constexpr double range_least = 0.5, range_most = 100.0, range_lsb = 0.002;
constexpr int lasers = 16, firings_a_packet = 24;
constexpr std::size_t block_bytes = 100, record_bytes = 3;
constexpr std::int64_t hour_us = 3'600'000'000;
constexpr double half_sector = 80.0 / 180.0 * std::numbers::pi;  // about azimuth 0; what looks elsewhere is blanked, as the sensor can be told
constexpr std::uint8_t strongest = 0x37, product = 0x22, reflectivity = 30;

// Of laser k in firing order, degrees.
constexpr double elevation_deg(int laser) { return laser % 2 == 0 ? -15.0 + laser : laser; }

double azimuth(std::int64_t firing) {
  const double turns = static_cast<double>(firing) * firing_ns * 1e-9 * turns_per_s;
  return 2 * std::numbers::pi * (turns - std::floor(turns));
}

void put16(std::uint8_t* to, unsigned v) {
  to[0] = static_cast<std::uint8_t>(v & 0xFF);
  to[1] = static_cast<std::uint8_t>(v >> 8);
}

}  // namespace

SpinningLidar::SpinningLidar(const ScannerConfig& noise, const LidarMount& mount, std::uint8_t number, std::uint64_t seed)
    : noise_(noise), mount_(mount), number_(number), random_(seed) {
  const BaseFrame turn({0, 0, mount.yaw, mount.roll, mount.pitch});
  x_ = turn.turned({1, 0, 0});
  y_ = turn.turned({0, 1, 0});
  z_ = turn.turned({0, 0, 1});
}

Vec3 SpinningLidar::turned(const Vec3& v) const { return v.x * x_ + v.y * y_ + v.z * z_; }

void SpinningLidar::fire(std::int64_t firing, double swing, bool blocked, const Scene& scene, const BaseFrame& stand, std::uint8_t* records,
                         std::vector<MoverReturn>* returns) {
  const double at = azimuth(firing);
  const bool in_sector = std::min(at, 2 * std::numbers::pi - at) <= half_sector;
  const PlanarFrame body(0, 0, 0, swing);
  for (int laser = 0; laser < lasers; ++laser) {
    std::uint8_t* to = records + record_bytes * static_cast<std::size_t>(laser);
    std::fill(to, to + record_bytes, std::uint8_t{0});
    if (!in_sector) continue;
    const double noise = random_.normal(), lost = random_.uniform();  // drawn whatever is hit
    if (blocked || lost < noise_.dropout_probability) continue;
    const double e = elevation_deg(laser) * std::numbers::pi / 180, turn = at + turns_per_s * 2 * std::numbers::pi * laser * 2304e-9;
    const Vec3 direction = turned({std::cos(e) * std::cos(turn), -std::cos(e) * std::sin(turn), std::sin(e)});
    const Ray upper{{mount_.position[0], mount_.position[1], mount_.position[2]}, direction};
    const Ray base{body.out(upper.origin), body.out(upper.direction)};
    const Ray world = stand.out(base);
    const std::optional<SceneHit> hit = scene.meet(world, base, upper, range_most);
    if (!hit || hit->range < range_least) continue;
    note(*hit, world, returns);
    const double range = std::max(range_least, hit->range + noise_.range_stddev * noise);
    put16(to, static_cast<unsigned>(std::clamp<long>(std::lround(range / range_lsb), 1, 65535)));
    to[2] = reflectivity;
  }
}

void SpinningLidar::step(double t, double dt, double swing_before, double swing_now, bool blocked, const Scene& scene, const BaseFrame& stand,
                         std::vector<LidarPacket>& out, std::vector<MoverReturn>* returns) {
  const std::int64_t end = std::llround(t * 1e9), begin = end - std::llround(dt * 1e9);
  const auto time_ns = [](std::int64_t firing) { return (firing + 1) * firing_ns; };
  if (time_ns(next_) <= begin) next_ = begin / firing_ns;  // a caller that left a span of time out gets no firings of it
  while (time_ns(next_) <= begin) ++next_;
  for (; time_ns(next_) <= end; ++next_) {
    const double f = static_cast<double>(time_ns(next_) - begin) / static_cast<double>(end - begin);
    const auto place = static_cast<std::size_t>(next_ % firings_a_packet);
    std::uint8_t* block = packet_.bytes.data() + block_bytes * (place / 2);
    if (place % 2 == 0) {
      put16(block, 0xEEFF);
      put16(block + 2, static_cast<unsigned>(azimuth(next_) * 18000 / std::numbers::pi) % 36000);
    }
    fire(next_, swing_before + f * (swing_now - swing_before), blocked, scene, stand, block + 4 + (place % 2) * lasers * record_bytes, returns);
    if (place + 1 < firings_a_packet) continue;
    const auto stamp = static_cast<std::uint32_t>((time_ns(next_) / 1000) % hour_us);
    for (std::size_t i = 0; i < 4; ++i) packet_.bytes[1200 + i] = static_cast<std::uint8_t>(stamp >> (8 * i));
    packet_.bytes[1204] = strongest;
    packet_.bytes[1205] = product;
    packet_.lidar = number_;
    out.push_back(packet_);
  }
}

}  // namespace berm::plant
