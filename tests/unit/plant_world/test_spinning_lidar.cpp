#include "plant/world/spinning_lidar.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

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
  ImplementShape s = bench::heads_only();
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
  const auto clear = steps(world, 48);
  const auto edge = steps(world, 3, 0.48), blocked = steps(world, 45, 0.51), again = steps(world, 50, 1.0), none = steps(world, 45, 1.51);
  EXPECT_GT(returns(clear), 10000);
  EXPECT_GT(blocked.size(), 300u);
  EXPECT_EQ(returns({blocked.begin() + 1, blocked.end()}), 0);
  EXPECT_GT(returns(again), 10000);
  EXPECT_TRUE(none.empty());
}

// A level lidar 1.2 m over level ground: from bearing to bearing it sees the same rings.
ImplementShape level_lidar(double sector_deg, bool dual, bool outliers) {
  ImplementShape s = one_lidar();
  s.lidar = {{{0.0, 0.0, 1.2}, 0.0, 0.0, 0.0, sector_deg, dual, outliers}};
  return s;
}

// Ranges of laser 0, which meets level ground at 4.64 m, in the blocks that begin at `first` and are `step` apart.
std::vector<double> lowest(const std::vector<LidarPacket>& packets, std::size_t first, std::size_t step) {
  std::vector<double> all;
  for (const LidarPacket& p : packets)
    for (std::size_t block = first; block < 12; block += step)
      for (const std::size_t firing : {4u, 52u}) all.push_back(u16(&p.bytes[100 * block + firing]) * 0.002);
  return all;
}

TEST(SpinningLidar, AHeadThatStallsGoesOnSendingWhatItSeesThere) {
  WorldConfig config = level_site();
  config.lidar_faults = {{0, false, 0.5, 0.5}};
  config.lidar_faults[0].stalled = true;
  World world(config, level_lidar(180, false, false), 1, 0);
  const auto sectors = [](const std::vector<LidarPacket>& packets) {
    std::set<unsigned> seen;
    for (std::size_t p = 1; p < packets.size(); ++p)  // the first began before
      for (std::size_t block = 0; block < 12; ++block) seen.insert(u16(&packets[p].bytes[100 * block + 2]) / 1000);
    return seen.size();
  };
  const auto turning = steps(world, 49), stalled = steps(world, 50, 0.49), again = steps(world, 50, 1.0);
  EXPECT_EQ(sectors(turning), 36u);
  EXPECT_EQ(sectors(stalled), 1u);
  EXPECT_NEAR(static_cast<double>(stalled.size()), static_cast<double>(again.size()), 2.0);
  EXPECT_EQ(sectors(again), 36u);
  for (std::size_t p = 1; p < stalled.size(); ++p) {
    EXPECT_EQ(u16(&stalled[p].bytes[2]), u16(&stalled[1].bytes[2]));
    EXPECT_NEAR(u16(&stalled[p].bytes[4]) * 0.002, 4.64, 0.02) << "laser 0 sees the ground";
  }
}

TEST(SpinningLidar, APartOfItsWindowIsCoveredOrTheAirIsDusty) {
  WorldConfig config = level_site();
  config.lidar_faults = {{0, false, 0.0, 5.0, {std::numbers::pi / 2, std::numbers::pi}}};
  World covered(config, level_lidar(180, true, false), 1, 0);
  for (const LidarPacket& p : steps(covered, 20))
    for (std::size_t block = 0; block < 12; ++block) {
      const double azimuth = u16(&p.bytes[100 * block + 2]) / 100.0;
      if (azimuth > 90.5 && azimuth < 179.5) { EXPECT_EQ(u16(&p.bytes[100 * block + 4]), 0u) << azimuth; }
      if (azimuth < 89.5 || azimuth > 180.5) { EXPECT_NEAR(u16(&p.bytes[100 * block + 4]) * 0.002, 4.64, 0.02) << azimuth; }
    }
  config.lidar_faults.clear();
  config.dust = {{0.0, 5.0, 0.3, 0.1}};
  World dusty(config, level_lidar(180, true, false), 1, 0);
  const auto packets = steps(dusty, 30);
  const auto last = lowest(packets, 0, 2), other = lowest(packets, 1, 2);
  double two = 0, alone = 0;
  for (std::size_t i = 0; i < last.size(); ++i) {
    alone += last[i] < 4.6 ? 1 : 0;
    two += last[i] > 4.6 && other[i] < last[i] ? 1 : 0;
  }
  const double count = static_cast<double>(last.size());
  EXPECT_NEAR(two / count, 0.3, 0.03);
  EXPECT_NEAR(alone / count, 0.1, 0.02);
}

TEST(SpinningLidar, WhatIsDrawnOfNoiseIsTheSameInDust) {
  WorldConfig clear = level_site(), dusty = level_site();
  clear.scanner.range_stddev = dusty.scanner.range_stddev = 0.05;
  dusty.dust = {{0.0, 5.0, 0.5, 0.0}};
  World a(clear, level_lidar(180, true, false), 1, 0), b(dusty, level_lidar(180, true, false), 1, 0);
  EXPECT_EQ(lowest(steps(a, 20), 0, 2), lowest(steps(b, 20), 0, 2)) << "the last returns";
}

TEST(SpinningLidar, TheSectorIsTheProfiles) {
  World narrow(level_site(), level_lidar(30, false, false), 1, 0), all_round(level_site(), level_lidar(180, false, false), 1, 0);
  std::set<int> seen_narrow, seen_round;
  const auto note = [](const std::vector<LidarPacket>& packets, std::set<int>& seen) {
    for (const LidarPacket& p : packets)
      for (std::size_t block = 0; block < 12; ++block)
        if (u16(&p.bytes[100 * block + 4]) != 0) seen.insert(static_cast<int>(u16(&p.bytes[100 * block + 2]) / 100));
  };
  note(steps(narrow, 30), seen_narrow);
  note(steps(all_round, 30), seen_round);
  EXPECT_EQ(seen_round.size(), 360u);
  EXPECT_EQ(seen_narrow.size(), 60u) << "0 to 29 and 330 to 359 degrees";
  EXPECT_EQ(seen_narrow.count(100), 0u);
}

TEST(SpinningLidar, DualReturnHoldsTheLastInEvenBlocksAndDustBeforeItInOddOnes) {
  WorldConfig config = level_site();
  config.scanner.dust_probability = 0.2;
  World world(config, level_lidar(180, true, false), 1, 0);
  const auto packets = steps(world, 50);
  EXPECT_NEAR(static_cast<double>(packets.size()), 753.0, 1.0) << "twice as many";
  for (const LidarPacket& p : packets) {
    ASSERT_EQ(p.bytes[1204], 0x39);
    for (std::size_t pair = 0; pair < 6; ++pair) ASSERT_EQ(u16(&p.bytes[200 * pair + 2]), u16(&p.bytes[200 * pair + 102]));
  }
  const auto last = lowest(packets, 0, 2), other = lowest(packets, 1, 2);
  long nearer = 0;
  for (std::size_t i = 0; i < last.size(); ++i) {
    ASSERT_NEAR(last[i], 1.2 / std::sin(15 * std::numbers::pi / 180), 0.006) << "dust hides nothing";
    ASSERT_LE(other[i], last[i]);
    ASSERT_GE(other[i], 0.498);
    nearer += other[i] < last[i] ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(nearer) / static_cast<double>(last.size()), 0.2, 0.02);
}

TEST(SpinningLidar, OutliersAreBetweenItAndWhatItWouldHaveHitInEitherMode) {
  for (const bool dual : {false, true}) {
    WorldConfig config = level_site();
    config.scanner.outlier_probability = 0.1;
    World world(config, level_lidar(180, dual, true), 1, 0), without(config, level_lidar(180, dual, false), 1, 0);
    const auto packets = steps(world, 30);
    const auto last = lowest(packets, 0, dual ? 2 : 1);
    long wrong = 0;
    for (const double range : last) {
      ASSERT_LE(range, 4.643);
      ASSERT_GE(range, 0.498);
      wrong += range < 4.62 ? 1 : 0;
    }
    EXPECT_NEAR(static_cast<double>(wrong) / static_cast<double>(last.size()), 0.1, 0.02) << dual;
    if (dual) {
      EXPECT_EQ(lowest(packets, 1, 2), last) << "nothing is behind it";
    }
    for (const double range : lowest(steps(without, 30), 0, dual ? 2 : 1)) ASSERT_NEAR(range, 4.636, 0.006) << "only where the profile asks for them";
  }
}

// Noise of later shots must not change with what is hit: a campaign compares runs that differ in one thing.
TEST(SpinningLidar, WhatIsDrawnDoesNotDependOnWhatIsHit) {
  WorldConfig config = level_site();
  config.scanner.range_stddev = 0.03;
  config.scanner.outlier_probability = config.scanner.dust_probability = 0.05;
  WorldConfig with_box = config;
  with_box.boxes.push_back({"box", 6.0, 0.0, 0.0, 2.0, 1.0, 4.0, 0.0});
  World one(config, level_lidar(180, true, true), 1, 0), other(with_box, level_lidar(180, true, true), 1, 0);
  const auto a = steps(one, 20), b = steps(other, 20);
  ASSERT_EQ(a.size(), b.size());
  long same = 0, different = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t block = 0; block < 12; ++block) {
      const double azimuth = u16(&a[i].bytes[100 * block + 2]) / 100.0, off = std::min(azimuth, 360 - azimuth);
      const bool equal = std::equal(&a[i].bytes[100 * block], &a[i].bytes[100 * block] + 100, &b[i].bytes[100 * block]);
      if (off > 40) {  // the box is seen up to 37 degrees off: 20 to either side of the base frame's x, the upper body swung by 17
        ASSERT_TRUE(equal) << azimuth;
      }
      (equal ? same : different) += 1;
    }
  EXPECT_GT(same, 1000);
  EXPECT_GT(different, 50);
}

}  // namespace
}  // namespace berm::plant
