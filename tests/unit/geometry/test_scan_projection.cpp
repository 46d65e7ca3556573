#include "geometry/scan_projection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "machine_profile.hpp"

namespace berm::kernel::test {
namespace {

constexpr double pi = 3.141592653589793;
constexpr uint64_t seed = 12;

berm_scan_packet packet() {
  berm_scan_packet p{};
  p.scanner = 0;
  p.time_us = 1000000;
  p.sample_period_ns = 83333;
  p.first_index = 200;
  p.samples_per_revolution = 400;
  p.count = 101;
  p.echoes_per_sample = 3;
  p.window_percent = 100;
  return p;
}

} // namespace

// verifies: SK-GE-24, IF-SC-9
TEST(ScanProjection, TheLastEchoRanges) {
  berm_scan_packet p = packet();
  p.range[0][0] = 100;
  p.range[1][0] = 100, p.range[1][1] = 200;
  p.range[2][0] = 100, p.range[2][1] = 200, p.range[2][2] = 65535;
  uint32_t range[BERM_SCAN_PACKET_SAMPLES];
  uint8_t echoes[BERM_SCAN_PACKET_SAMPLES];
  last_echoes(p, range, echoes);
  EXPECT_EQ(range[0], 400u);
  EXPECT_EQ(range[1], 800u);
  EXPECT_EQ(range[2], 262140u);
  EXPECT_EQ(echoes[0], 1);
  EXPECT_EQ(echoes[1], 2);
  EXPECT_EQ(echoes[2], 3);
  for (int i = 3; i < BERM_SCAN_PACKET_SAMPLES; ++i) EXPECT_EQ(range[i] + echoes[i], 0u);
  p.echoes_per_sample = 1; // the other places do not count
  p.count = 2;
  last_echoes(p, range, echoes);
  EXPECT_EQ(range[1], 400u);
  EXPECT_EQ(range[2], 0u);
}

// verifies: SK-GE-25, IF-SC-7 (the pan), IF-SC-8
TEST(ScanProjection, TimeAndPanRunOverThePacket) {
  berm_scan_packet p = packet();
  p.pan_start_urad = -500000;
  p.pan_end_urad = 500000;
  EXPECT_EQ(sample_time_us(p, 0), 1000000);
  EXPECT_EQ(sample_time_us(p, 12), 1000999);
  EXPECT_NEAR(sample_pan_rad(p, 0), -0.5, 1e-12);
  EXPECT_NEAR(sample_pan_rad(p, 50), 0.0, 1e-12);
  EXPECT_NEAR(sample_pan_rad(p, 100), 0.5, 1e-12);
  p.count = 1;
  EXPECT_NEAR(sample_pan_rad(p, 0), -0.5, 1e-12);
}

// verifies: SK-GE-22, IF-SC-7 (the direction)
TEST(ScanProjection, DirectionsAreThoseOfThePacketsDefinition) {
  const berm_parameters parameters = machine_profiles().front().parameters;
  const ScanProjection projection(parameters);
  berm_scan_packet p = packet();
  const struct {
    uint16_t index;
    int32_t pan_urad;
    double x, y, z;
  } cases[] = {{0, 0, 1, 0, 0}, {100, 0, 0, 0, 1}, {200, 0, -1, 0, 0}, {300, 0, 0, 0, -1}, {0, 1570796, 0, 1, 0}, {350, -1570796, 0, -std::sqrt(0.5), -std::sqrt(0.5)}};
  for (int scanner = 0; scanner < BERM_SCANNER_MOUNTS; ++scanner)
    for (const auto& c : cases) {
      p.scanner = static_cast<uint8_t>(scanner);
      p.first_index = c.index;
      p.pan_start_urad = p.pan_end_urad = c.pan_urad;
      Eigen::Vector3d at;
      ASSERT_TRUE(projection.in_upper_body(p, 0, 10000, at));
      const berm_scanner_mount& m = parameters.scanner[scanner];
      EXPECT_LT((at - Eigen::Vector3d(m.x_mm * 1e-3 + 10 * c.x, m.y_mm * 1e-3 + 10 * c.y, m.z_mm * 1e-3 + 10 * c.z)).norm(), 1e-5) << c.index;
    }
}

// verifies: SK-GE-22
TEST(ScanProjection, RefusesRangesAndSamplesThatDoNotExist) {
  const berm_parameters parameters = machine_profiles().front().parameters;
  const ScanProjection projection(parameters);
  berm_scan_packet p = packet();
  const Eigen::Vector3d untouched(7, 8, 9);
  Eigen::Vector3d at = untouched;
  const uint32_t low = static_cast<uint32_t>(parameters.range_min_mm), high = static_cast<uint32_t>(parameters.range_max_mm);
  EXPECT_FALSE(projection.in_upper_body(p, 0, 0, at));
  EXPECT_FALSE(projection.in_upper_body(p, 0, low - 1, at));
  EXPECT_FALSE(projection.in_upper_body(p, 0, high + 1, at));
  EXPECT_FALSE(projection.in_upper_body(p, -1, low, at));
  EXPECT_FALSE(projection.in_upper_body(p, p.count, low, at));
  p.scanner = BERM_SCANNER_MOUNTS;
  EXPECT_FALSE(projection.in_upper_body(p, 0, low, at));
  p.scanner = 0;
  p.samples_per_revolution = 0;
  EXPECT_FALSE(projection.in_upper_body(p, 0, low, at));
  EXPECT_EQ(at, untouched);
  p.samples_per_revolution = 400;
  EXPECT_TRUE(projection.in_upper_body(p, 0, low, at));
  EXPECT_TRUE(projection.in_upper_body(p, 100, high, at));
}

// verifies: SK-GE-26
TEST(ScanProjection, TurnsIntoTheBaseFrameAndRoundsUp) {
  sk_point at{};
  ASSERT_TRUE(ScanProjection::in_base({5.0, 0.0, -1.0004}, 0.5 * pi, at));
  EXPECT_EQ(at.x_mm, 0);
  EXPECT_EQ(at.y_mm, 5000);
  EXPECT_EQ(at.z_mm, -1000);
  std::mt19937_64 random(seed);
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d v(uniform(random, -20, 20), uniform(random, -20, 20), uniform(random, -19, 19));
    const double swing = uniform(random, -7, 7);
    ASSERT_TRUE(ScanProjection::in_base(v, swing, at));
    const double azimuth = std::atan2(v.y(), v.x()) + swing, r = std::hypot(v.x(), v.y()) * 1e3;
    ASSERT_NEAR(at.x_mm, r * std::cos(azimuth), 0.5001);
    ASSERT_NEAR(at.y_mm, r * std::sin(azimuth), 0.5001);
    ASSERT_GE(at.z_mm, v.z() * 1e3);
    ASSERT_LT(at.z_mm, v.z() * 1e3 + 1.0);
  }
}

// verifies: SK-GE-26
TEST(ScanProjection, RefusesPointsOffTheGridAndClampsHeights) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const double limit = SK_COORD_MAX_MM * 1e-3, high = SK_HEIGHT_MAX_MM * 1e-3;
  sk_point at{1, 2, 3};
  for (const Eigen::Vector3d& bad : {Eigen::Vector3d(limit + 0.001, 0, 0), Eigen::Vector3d(0, -limit - 0.001, 0), Eigen::Vector3d(nan, 0, 0), Eigen::Vector3d(0, inf, 0), Eigen::Vector3d(0, 0, nan)})
    EXPECT_FALSE(ScanProjection::in_base(bad, 0.0, at));
  EXPECT_EQ(at.x_mm, 1);
  EXPECT_EQ(at.y_mm, 2);
  EXPECT_EQ(at.z_mm, 3);
  ASSERT_TRUE(ScanProjection::in_base({limit, -limit, high + 1}, 0.0, at));
  EXPECT_EQ(at.x_mm, SK_COORD_MAX_MM);
  EXPECT_EQ(at.y_mm, -SK_COORD_MAX_MM);
  EXPECT_EQ(at.z_mm, SK_HEIGHT_MAX_MM);
  ASSERT_TRUE(ScanProjection::in_base({0, 0, -high - 1}, 0.0, at));
  EXPECT_EQ(at.z_mm, -SK_HEIGHT_MAX_MM);
}

} // namespace berm::kernel::test
