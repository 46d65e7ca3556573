#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench.hpp"

namespace berm::plant {
namespace {

const JointState tucked = {{0, 0.6, -2.2, -1.5}, {}};

std::vector<berm_scan_packet> scanned(const WorldConfig& c, const ImplementShape& s, int steps, double pan, double pan_rate = 0.0, uint64_t seed = 5) {
  World w(c, s, seed, static_cast<int>(c.trucks.size()));
  std::vector<berm_scan_packet> out;
  for (int i = 1; i <= steps; ++i) {
    const double t = 0.01 * i, before = pan + pan_rate * (t - 0.01), now = pan + pan_rate * t;
    w.step(t, 0.01, tucked, tucked);
    w.scan(t, 0.01, tucked, tucked, {{before, -before}, {}}, {{now, -now}, {}}, out);
  }
  return out;
}

WorldConfig noisy_site() {
  WorldConfig c = bench::site();
  c.scanner.range_stddev = 0.03;
  c.scanner.outlier_probability = 0.01;
  c.scanner.dropout_probability = 0.02;
  c.scanner.dust_probability = 0.03;
  c.scanner.window_percent = 90;
  c.dust = {{0.2, 0.4, 0.3, 0.1}};
  return c;
}

// Level ground, and a wall across the way whose near face is y = 8: 6.65 m from the left head, 9.35 m from the right.
WorldConfig walled_site(double share, Ranging ranging) {
  WorldConfig c;
  c.terrain.crest_x = c.terrain.crest_y = 1000;
  c.terrain.toe_x = c.terrain.toe_y = 1001;
  c.boxes = {{"wall", 0, 8.5, -1, 6, 200, 1, 0}};
  c.scanner.window_percent = 98;
  c.scanner.waveform_share = share;
  c.scanner.ranging = ranging;
  return c;
}

double last_range(const berm_scan_packet& p, int i) {
  const uint16_t* e = p.range[i];
  return (e[2] != 0 ? e[2] : e[1] != 0 ? e[1] : e[0]) * BERM_SCAN_RANGE_LSB_MM * 1e-3;
}

// The bytes that these settings gave before there were waveforms.
TEST(ScannerWaveform, WithoutAShareThePacketsAreWhatTheyWere) {
  uint32_t crc = 0;
  size_t total = 0;
  for (const berm_scan_packet& p : scanned(noisy_site(), bench::machine(), 100, 0.3, 0.5)) {
    uint8_t bytes[BERM_SCAN_PACKET_MAX_BYTES];
    const size_t n = berm_scan_encode(&p, bytes);
    total += n;
    crc = berm_crc32_continue(crc, bytes, n);
  }
  EXPECT_EQ(total, 104000u);
  EXPECT_EQ(crc, 0xD179CFFCu);
}

TEST(ScannerWaveform, AShareLeavesAllOtherSamplesAsTheyWere) {
  WorldConfig c = noisy_site();
  const auto plain = scanned(c, bench::machine(), 60, 0.3, 0.5);
  c.scanner.waveform_share = 0.3;
  const auto mixed = scanned(c, bench::machine(), 60, 0.3, 0.5);
  ASSERT_EQ(plain.size(), mixed.size());
  int same = 0, met = 0;
  for (size_t k = 0; k < plain.size(); ++k)
    for (int i = 0; i < plain[k].count; ++i) {
      if (plain[k].range[i][0] == 0) continue;
      ++met;
      same += plain[k].range[i][0] == mixed[k].range[i][0] && plain[k].range[i][1] == mixed[k].range[i][1] ? 1 : 0;
    }
  EXPECT_GT(met, 5000);
  EXPECT_GT(same, 0.68 * met);
  EXPECT_LT(same, 0.95 * met) << "and a share of them is computed";
}

TEST(ScannerWaveform, InClearAirTheNoiseIsTheConfiguredOne) {
  for (const Ranging ranging : {Ranging::last_pulse, Ranging::trailing_edge}) {
    WorldConfig exact = walled_site(0.0, ranging), c = walled_site(1.0, ranging);
    c.scanner.range_stddev = 0.03;
    exact.scanner.window_percent = 100;
    const auto truth = scanned(exact, bench::heads_only(), 300, 1.2), found = scanned(c, bench::heads_only(), 300, 1.2);
    ASSERT_EQ(truth.size(), found.size());
    int n = 0, none = 0, several = 0;
    double sum = 0, sum2 = 0;
    for (size_t k = 0; k < truth.size(); ++k) {
      if (truth[k].scanner != 0) continue;  // the right one looks away from the wall
      for (int i = 0; i < truth[k].count; ++i) {
        const double range = last_range(truth[k], i);
        if (range < 1.0 || range > 20.0) continue;
        ++n;
        if (found[k].range[i][0] == 0) {
          ++none;
          continue;
        }
        several += found[k].range[i][1] != 0 ? 1 : 0;
        const double error = last_range(found[k], i) - range;
        sum += error;
        sum2 += error * error;
      }
    }
    ASSERT_GT(n, 10000);
    EXPECT_EQ(none, 0);
    EXPECT_LT(several, n / 1000) << "no dust there";
    EXPECT_NEAR(sum / n, 0.0, 0.002);
    EXPECT_NEAR(std::sqrt(sum2 / n), 0.03, 0.0015);
  }
}

struct AtWall { int all = 0, wall = 0, front = 0, none = 0, several = 0; };

// Of what the left head sent at the wall within 20 degrees up and down; front: of a cloud that begins at y = 5.5.
AtWall at_wall(const std::vector<berm_scan_packet>& packets, double from_s, double to_s) {
  AtWall a;
  for (const berm_scan_packet& p : packets) {
    if (p.scanner != 0 || static_cast<double>(p.time_us) < from_s * 1e6 || static_cast<double>(p.time_us) >= to_s * 1e6) continue;
    for (int i = 0; i < p.count; ++i) {
      const double e = 2 * std::numbers::pi * (p.first_index + i) / 400;
      if (std::cos(e) < std::cos(20 * bench::degree)) continue;
      ++a.all;
      const double ahead = last_range(p, i) * std::cos(e);  // the pan looks straight at it
      a.none += p.range[i][0] == 0 ? 1 : 0;
      a.several += p.range[i][1] != 0 ? 1 : 0;
      a.wall += std::abs(ahead - 6.65) < 0.15 ? 1 : 0;
      a.front += std::abs(ahead - 4.15) < 0.5 ? 1 : 0;
    }
  }
  return a;
}

TEST(ScannerWaveform, ACloudAboutTheWallIsRangedByTheChosenEdgeForItsTime) {
  for (const Ranging ranging : {Ranging::last_pulse, Ranging::trailing_edge}) {
    WorldConfig c = walled_site(1.0, ranging);
    CloudConfig cloud;
    cloud.x = 1.3, cloud.y = 8.0, cloud.z_low = -1, cloud.z_high = 8, cloud.length = 40, cloud.width = 5.0;
    cloud.extinction = 0.5, cloud.at_s = 0.5, cloud.for_s = 0.5;
    c.clouds = {cloud};
    const auto packets = scanned(c, bench::heads_only(), 150, std::numbers::pi / 2);
    const AtWall clear = at_wall(packets, 0.0, 0.48), dusty = at_wall(packets, 0.52, 0.97), after = at_wall(packets, 1.02, 1.5);
    EXPECT_GT(clear.all, 500);
    EXPECT_EQ(clear.wall, clear.all);
    EXPECT_EQ(clear.several, 0);
    EXPECT_EQ(after.wall, after.all);
    EXPECT_GT(dusty.all, 500);
    EXPECT_EQ(ranging == Ranging::last_pulse ? dusty.front : dusty.wall, dusty.all);
    EXPECT_EQ(dusty.several, dusty.all) << "dust is told by a second echo, whichever edge is ranged by";
  }
}

TEST(ScannerWaveform, ACoveredWindowSendsItsOwnEchoAlone) {
  WorldConfig c = walled_site(1.0, Ranging::last_pulse);
  c.scanner_faults = {{0, false, 0.0, 5.0, {0.0, 2 * std::numbers::pi}}};
  for (const berm_scan_packet& p : scanned(c, bench::heads_only(), 30, std::numbers::pi / 2)) {
    if (p.scanner != 0) continue;
    for (int i = 0; i < p.count; ++i) ASSERT_EQ(p.range[i][0], 75) << "the least range";
  }
}

TEST(ScannerWaveform, TheWorldKnowsWhatPeopleSentBack) {
  WorldConfig c = walled_site(1.0, Ranging::trailing_edge);
  c.boxes.clear();
  MoverConfig m;
  m.name = "person";
  m.height = 1.8, m.radius = 0.25;
  m.waypoints = {{6.0, 0.0, 0.0}};
  c.movers = {m};
  World w(c, bench::heads_only(), 3, 0);
  std::vector<berm_scan_packet> out;
  int returns = 0;
  for (int i = 1; i <= 100; ++i) {
    const double t = 0.01 * i, before = -0.6 + 0.8 * (t - 0.01), now = -0.6 + 0.8 * t;
    w.step(t, 0.01, tucked, tucked);
    w.scan(t, 0.01, tucked, tucked, {{before, -before}, {}}, {{now, -now}, {}}, out);
    returns += static_cast<int>(w.mover_returns().size());
    for (const MoverReturn& r : w.mover_returns()) EXPECT_LT(std::hypot(r.x - 6.0, r.y), 0.26);
  }
  EXPECT_GT(returns, 20);
}

}  // namespace
}  // namespace berm::plant
