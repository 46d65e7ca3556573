// From packets to what the sensors can see: which rays count, how soon a covered strip is found, what is told of dust.
#include "io/sight_watch.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <memory>
#include <random>

#include "mini_machine.hpp"
#include "sight_packets.hpp"

namespace berm::kernel::test {
namespace {

constexpr double kHeadMm = 3300.0;

Shot ground(double sine) { return {{sine < -0.05 ? kHeadMm / -sine : 0.0, 0.0}}; }

double degrees(double rad) { return rad * 360.0 / kTurn; }

class SightWatchTest : public testing::Test {
 protected:
  SightWatchTest() : parameters(berm::test::demo_parameters()) { renew(); }
  void renew() { watch = std::make_unique<SightWatch>(parameters); }
  void ring() {
    parameters.lidars = 2;
    parameters.lidar[0] = {-2650, 1400, 1050, 0, 0, 0};
    parameters.lidar[1] = {1300, -1400, 1100, 0, 0, 0};
    renew();
  }
  // One turn of a scanner; false ends at the first packet after which it is blocked.
  void scan(double pan, const std::function<Shot(double, double)>& shot, std::uint8_t scanner = 0) {
    turn_of(scanner, pan, 0, shot, [&](const berm_scan_packet& p) {
      watch->take(p, 0.0, now_us);
      watch->step(now_us);
    });
    now_us += 33'333;
  }
  // One turn of a lidar, in 75 packets (of dual return 150).
  void turn(int lidar, bool dual, double swing, const std::function<Shot(double, int)>& shot) {
    const double packet_deg = dual ? 2.4 : 4.8;
    for (double from = 0.0; from < 359.9; from += packet_deg) {
      watch->take(lidar, vlp16_packet(static_cast<std::uint32_t>(now_us), from, dual, shot).data(), swing, now_us);
      now_us += dual ? 667 : 1333;
    }
    watch->step(now_us);
  }

  berm_parameters parameters;
  std::unique_ptr<SightWatch> watch;
  std::int64_t now_us = 1'000'000;
};

// verifies: SK-SI-1, SK-SI-3
TEST_F(SightWatchTest, AStripOfAScannerThatIsCoveredIsFoundWithinASecond) {
  for (int turn = 0; turn < 30; ++turn) scan(0.6, [](double, double sine) { return ground(sine); });
  EXPECT_FALSE(watch->blocked());
  for (const auto& [low, high] : {std::pair{300.0, 330.0}, std::pair{270.0, 300.0}, std::pair{330.0, 360.0}}) {
    renew();
    const std::int64_t covered_us = now_us;
    while (!watch->blocked() && now_us < covered_us + 1'000'000)
      scan(0.6, [&](double mirror, double sine) { return degrees(mirror) >= low && degrees(mirror) < high ? Shot{{300.0, 0.0}} : ground(sine); });
    EXPECT_TRUE(watch->blocked()) << low;
    EXPECT_EQ(watch->blocked_eyes(), 1U) << low;
    EXPECT_LT(now_us, covered_us + 250'000) << low;
    const auto strip = static_cast<int>(low / 30);
    EXPECT_EQ(watch->eye(0).strip[strip].blocked, 1);
    for (int k = 0; k < SK_SIGHT_STRIPS; ++k)
      if (k != strip) { EXPECT_EQ(watch->eye(0).strip[k].blocked, 0) << k; }
  }
}

// verifies: SK-SI-1
TEST_F(SightWatchTest, WhatNeedNotComeBackBlocksNothing) {
  // The sky; and less than ten degrees down, where the ground may end.
  for (int turn = 0; turn < 60; ++turn) scan(0.6, [](double, double sine) { return sine > -0.17 ? Shot{} : ground(sine); });
  EXPECT_FALSE(watch->blocked());
  for (int k = 0; k < 6; ++k) EXPECT_EQ(watch->eye(0).strip[k].expected, 0) << k;
}

// The head is 5 cm from the upper body's corner: turned to the left, the scanner looks down its own side behind.
// verifies: SK-SI-1
TEST_F(SightWatchTest, TheOwnUpperBodyCloseBeforeAScannerBlocksNothing) {
  for (double pan = -0.75; pan < 2.25; pan += 0.02)
    scan(pan, [&](double mirror, double sine) {
      const double level = std::cos(mirror), x = level * std::cos(pan), y = level * std::sin(pan);
      if (x >= 0.0 || y >= 0.0 || sine >= 0.0) return ground(sine);
      // Through the top (2.95 m) or the side (y = 1.30 m), where the plant's machine has them.
      const double to_top = 0.35 / -sine, to_side = 0.05 / -y, meets = std::max(to_top, to_side), at_x = 1.30 + meets * x;
      return at_x < 1.20 && at_x > -2.6 ? Shot{{std::min(kHeadMm / -sine, meets * 1000.0), 0.0}} : ground(sine);
    });
  EXPECT_FALSE(watch->blocked()) << watch->blocked_eyes();
}

// verifies: SK-SI-3, SK-SI-5
TEST_F(SightWatchTest, ACoveredLidarIsFoundWithinAQuarterOfASecondAlsoInPart) {
  ring();
  const LidarMount mount = lidar_mount(parameters.lidar[0]);
  const auto clear = [&](double azimuth, int channel) {
    const double z = beam_z(mount, azimuth, channel);
    return Shot{{z < -0.03 ? 1050.0 / -z : 0.0, 0.0}};
  };
  for (int k = 0; k < 5; ++k) turn(0, false, 0.0, clear);
  EXPECT_FALSE(watch->blocked());
  // Backwards and to the left, 15 degrees; azimuth grows clockwise. Swung so that it stands beside the tracks.
  for (const double low : {0.0, 150.0, 195.0, 225.0}) {
    renew();
    const std::int64_t covered_us = now_us;
    while (!watch->blocked() && now_us < covered_us + 200'000)
      turn(0, false, 1.2, [&](double azimuth, int channel) { return azimuth >= low && azimuth < low + 15.0 ? Shot{} : clear(azimuth, channel); });
    // Ahead (0 degrees) it looks along the upper body's side: no ray of that strip is expected.
    EXPECT_EQ(watch->blocked(), low > 0.0) << low;
    if (low > 0.0) { EXPECT_EQ(watch->blocked_eyes(), 1U << 2) << low; }
  }
}

// All its lasers look down: what counts is the share of the strip, not the newest degree of it.
// verifies: SK-SI-5
TEST_F(SightWatchTest, ALidarThatSendsASectorIsJudgedByWholeStrips) {
  parameters.lidars = 1;
  parameters.lidar[0] = {-2650, 1400, 3400, 0, berm::test::urad(80), berm::test::urad(145)};
  renew();
  const LidarMount mount = lidar_mount(parameters.lidar[0]);
  const auto sector = [&](double low, double high) {
    return [&mount, low, high](double azimuth, int channel) {
      const double z = beam_z(mount, azimuth, channel), from_middle = std::min(azimuth, 360.0 - azimuth);
      return from_middle > 80.0 || (azimuth >= low && azimuth < high) || z > -0.03 ? Shot{} : Shot{{3400.0 / -z, 0.0}};
    };
  };
  for (int k = 0; k < 20; ++k) turn(0, false, 0.0, sector(0.0, 0.0));
  EXPECT_FALSE(watch->blocked()) << "beyond its sector nothing is sent";
  for (int k = 0; k < 20; ++k) turn(0, false, 0.0, sector(33.0, 36.0));
  EXPECT_FALSE(watch->blocked()) << "three degrees of a strip";
  turn(0, false, 0.0, sector(30.0, 45.0));
  turn(0, false, 0.0, sector(30.0, 45.0));
  EXPECT_TRUE(watch->blocked());
}

// verifies: SK-SI-5
TEST_F(SightWatchTest, ALidarLowOverTheTracksIsJudgedOnlyBesideThem) {
  ring();
  const auto nothing = [](double, int) { return Shot{}; };
  for (int k = 0; k < 10; ++k) turn(1, false, 0.822, nothing);
  EXPECT_FALSE(watch->blocked()) << "in front of the axis: what is nothing may be the tracks";
  for (int k = 0; k < 3; ++k) turn(1, false, -0.75, nothing);
  EXPECT_TRUE(watch->blocked()) << "swung to where it is beside the tracks";
  EXPECT_EQ(watch->blocked_eyes(), 1U << 3);
}

// The measured swing is some milliseconds old. Judged by it a ray that the track's edge ends may have passed it, and half of a strip are such.
// verifies: SK-SI-1, SK-SI-15
TEST_F(SightWatchTest, TheTracksBlockNothingWhileTheMachineSwings) {
  ring();
  const LidarMount mount = lidar_mount(parameters.lidar[1]);
  constexpr double fastest = 0.873, oldest = 0.025;  // rad/s, s
  for (const double way : {-1.0, 0.0, 1.0}) {
    renew();
    for (double swing = -1.6; swing < 1.6; swing += 0.01) {
      const double then = swing - way * fastest * oldest;
      const Eigen::Matrix3d turned = Eigen::AngleAxisd(then, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      turn(1, false, swing, [&](double azimuth, int channel) {
        const double e = (-15.0 + 2.0 * channel) * kTurn / 360.0, a = azimuth * kTurn / 360.0;
        const Eigen::Vector3d direction = turned * (mount.turn * Eigen::Vector3d(std::cos(e) * std::cos(a), -std::cos(e) * std::sin(a), std::sin(e)));
        if (direction.z() > -0.03) return Shot{};
        const Eigen::Vector3d on_track = turned * mount.place + (mount.place.z() - 1.0) / -direction.z() * direction;
        const bool hits = std::abs(on_track.x()) < 2.1 && std::abs(on_track.y()) > 0.8 && std::abs(on_track.y()) < 1.4;
        return hits ? Shot{} : Shot{{1000.0 * mount.place.z() / -direction.z(), 0.0}};
      });
      ASSERT_FALSE(watch->blocked()) << "swung to " << swing << ", " << way;
    }
  }
}

// verifies: SK-SI-6, SK-SI-7, SK-SI-8, SK-SI-10
TEST_F(SightWatchTest, TheDustiestSensorCounts) {
  std::mt19937_64 random(3);
  const auto dusty = [&](double share) {
    return [&random, share](double, double sine) {
      const Shot clear = ground(sine);
      return clear.echo_mm[0] > 2000.0 && static_cast<double>(random() % 1000) < 1000 * share ? Shot{{1200.0, clear.echo_mm[0]}} : clear;
    };
  };
  for (int k = 0; k < 10; ++k) scan(0.6, dusty(0.0));
  EXPECT_EQ(watch->dust_permille(), 0);
  EXPECT_EQ(watch->dust(), SK_DUST_NONE);
  for (int k = 0; k < 20; ++k) {
    scan(0.6, dusty(0.2), 1);
    scan(0.6, dusty(0.0), 0);
  }
  EXPECT_NEAR(watch->dust_permille(), 200, 40);
  EXPECT_EQ(watch->dust(), SK_DUST_SLOW);
  for (int k = 0; k < 20; ++k) scan(0.6, dusty(0.5), 1);
  EXPECT_EQ(watch->dust(), SK_DUST_STOP);
  EXPECT_FALSE(watch->blocked());
}

// verifies: SK-SI-6
TEST_F(SightWatchTest, AFilmOnTheWindowIsNoDust) {
  for (int k = 0; k < 30; ++k) scan(0.6, [](double, double sine) { return Shot{{300.0, ground(sine).echo_mm[0]}}; });
  EXPECT_EQ(watch->dust_permille(), 0);
}

// verifies: SK-SI-6
TEST_F(SightWatchTest, DualReturnTellsOfDustSingleDoesNot) {
  ring();
  int n = 0;
  const auto haze = [&](double azimuth, int channel) {
    const double z = beam_z(lidar_mount(parameters.lidar[0]), azimuth, channel);
    const double clear = z < -0.03 ? 1050.0 / -z : 0.0;
    return ++n % 5 == 0 && clear > 0.0 ? Shot{{1500.0, clear}} : Shot{{clear, 0.0}};
  };
  for (int k = 0; k < 3; ++k) turn(0, false, 0.0, haze);
  EXPECT_EQ(watch->dust_permille(), 0);
  for (int k = 0; k < 3; ++k) turn(0, true, 0.0, haze);
  EXPECT_NEAR(watch->dust_permille(), 200, 40);
  EXPECT_EQ(watch->dust(), SK_DUST_SLOW);
}

// A lone return may stand in either block of a dual pair: it is no blind ray and no dust.
// verifies: SK-SI-2, SK-SI-6
TEST(Vlp16Firing, ReportsEveryRayOfAPacketAlsoThoseWithoutReturn) {
  for (const bool dual : {false, true}) {
    Vlp16Bytes bytes = vlp16_packet(1000, 359.8, dual, [](double azimuth, int channel) {
      return channel == 4 ? Shot{} : Shot{{2000.0 + 100.0 * channel, azimuth > 180.0 ? 0.0 : 9000.0}};
    });
    ASSERT_EQ(vlp16_is_dual(bytes.data()), dual);
    ASSERT_EQ(vlp16_firings(bytes.data()), dual ? 12 : 24);
    for (int f = 0; f < vlp16_firings(bytes.data()); ++f) {
      const Vlp16Firing firing = vlp16_firing(bytes.data(), f);
      EXPECT_NEAR(std::fmod(firing.azimuth_mdeg / 1000.0 + 180.0, 360.0), 179.8 + 0.2 * f, 0.011);
      for (int channel = 0; channel < kVlp16Channels; ++channel) {
        const double nearer = channel == 4 ? 0.0 : 2000.0 + 100.0 * channel, last = channel == 4 ? 0.0 : f < 2 ? nearer : 9000.0;
        EXPECT_EQ(firing.last_mm[channel], last) << f << " channel " << channel;
        EXPECT_EQ(firing.other_mm[channel], dual ? nearer : last) << f << " channel " << channel;
      }
    }
    if (!dual) continue;
    bytes[4] = bytes[5] = 0;  // the first block's first record: laser 0
    EXPECT_EQ(vlp16_firing(bytes.data(), 0).last_mm[0], 2000);
    EXPECT_EQ(vlp16_firing(bytes.data(), 0).other_mm[0], 0);
  }
}

}  // namespace
}  // namespace berm::kernel::test
