#include "plant/world/spinning_lidar.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench.hpp"

namespace berm::plant {
namespace {

unsigned u16(const std::uint8_t* p) { return static_cast<unsigned>(p[0]) | (static_cast<unsigned>(p[1]) << 8); }

WorldConfig level_site() {
  WorldConfig c;
  c.terrain.crest_x = c.terrain.crest_y = 1000;
  c.terrain.toe_x = c.terrain.toe_y = 1001;
  c.terrain.roughness = 0;
  return c;
}

// One lidar 3.4 m over level ground, its x axis straight down: laser k at azimuth a looks cos(e) cos(a) down.
ImplementShape one_lidar() {
  ImplementShape s = bench::machine();
  s.parts.clear();
  s.upper_body.clear();
  s.tracks.clear();
  s.lidar = {{{-2.65, 1.4, 3.4}, 0.0, std::numbers::pi / 2, 2.5}};
  return s;
}

std::vector<LidarPacket> steps(World& world, int n, double from_s = 0.0) {
  std::vector<LidarPacket> out;
  std::vector<berm_scan_packet> scans;
  const JointState pose{{0.3, 0.6, -2.2, -1.5}, {}};
  for (int i = 1; i <= n; ++i) {
    const double t = from_s + 0.01 * i;
    world.step(t, 0.01, pose, pose);
    world.scan(t, 0.01, pose, pose, {}, {}, scans);
    world.scan_lidars(t, 0.01, pose, pose, out);
  }
  return out;
}

TEST(SpinningLidar, SendsNativePacketsAtTheSensorsRate) {
  World world(level_site(), one_lidar(), 1, 0);
  const auto packets = steps(world, 100);
  EXPECT_NEAR(static_cast<double>(packets.size()), 754.0, 1.0);  // 18,084 firings of 24 a packet
  std::uint32_t before = 0;
  for (const LidarPacket& p : packets) {
    EXPECT_EQ(p.bytes[1204], 0x37);
    EXPECT_EQ(p.bytes[1205], 0x22);
    const std::uint32_t clock = u16(&p.bytes[1200]) | (u16(&p.bytes[1202]) << 16);
    EXPECT_NEAR(clock, before + 24 * 55.296, 1.5);
    before = clock;
  }
}

TEST(SpinningLidar, MeasuresTheGroundAndBlanksWhatLooksElsewhere) {
  World world(level_site(), one_lidar(), 1, 0);
  int measured = 0, blank = 0;
  for (const LidarPacket& p : steps(world, 30))
    for (std::size_t block = 0; block < 12; ++block) {
      const std::uint8_t* b = &p.bytes[100 * block];
      ASSERT_EQ(u16(b), 0xEEFFu);
      const double azimuth = u16(b + 2) / 100.0, off = std::min(azimuth, 360 - azimuth);
      for (std::size_t laser = 0; laser < 16; ++laser) {
        const double range = u16(b + 4 + 3 * laser) * 0.002;
        if (off > 80.5) {
          ASSERT_EQ(range, 0.0) << azimuth;
          ++blank;
        } else if (off < 60) {
          const double e = (laser % 2 == 0 ? -15.0 + static_cast<double>(laser) : static_cast<double>(laser)) * std::numbers::pi / 180;
          const double turn = azimuth * std::numbers::pi / 180 + 20 * std::numbers::pi * static_cast<double>(laser) * 2304e-9;
          ASSERT_NEAR(range, 3.4 / (std::cos(e) * std::cos(turn)), 0.006) << azimuth << " laser " << laser;
          ++measured;
        }
      }
    }
  EXPECT_GT(measured, 5000);
  EXPECT_GT(blank, 5000);
}

TEST(SpinningLidar, FaultsBlockOrSilenceItForTheirTime) {
  WorldConfig config = level_site();
  config.lidar_faults = {{0, false, 0.5, 0.5}, {0, true, 1.5, 0.5}};
  World world(config, one_lidar(), 1, 0);
  const auto returns = [](const std::vector<LidarPacket>& packets) {
    long count = 0;
    for (const LidarPacket& p : packets)
      for (std::size_t block = 0; block < 12; ++block)
        for (std::size_t k = 0; k < 32; ++k) count += u16(&p.bytes[100 * block + 4 + 3 * k]) != 0 ? 1 : 0;
    return count;
  };
  const auto clear = steps(world, 48), edge = steps(world, 3, 0.48), blocked = steps(world, 45, 0.51), again = steps(world, 50, 1.0), none = steps(world, 45, 1.51);
  EXPECT_GT(returns(clear), 10000);
  EXPECT_GT(blocked.size(), 300u);
  EXPECT_EQ(returns({blocked.begin() + 1, blocked.end()}), 0);
  EXPECT_GT(returns(again), 10000);
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace berm::plant
