#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "bench.hpp"

namespace berm::plant {
namespace {

using bench::degree;

WorldConfig open_site() {
  WorldConfig c;
  c.terrain.crest_x = c.terrain.crest_y = 1000;
  c.terrain.toe_x = c.terrain.toe_y = 1001;
  return c;
}

double range_of(const berm_scan_packet& p, int i, int echo = 0) { return p.range[i][echo] * BERM_SCAN_RANGE_LSB_MM * 1e-3; }

// A world that only scans: one step at a time, with the pans and the swing as functions of time.
struct ScanRun {
  ScanRun(const WorldConfig& c, const ImplementShape& s, uint64_t seed = 1) : world(c, s, seed, static_cast<int>(c.trucks.size())) {}
  void steps(int n, const JointState& j, double swing_rate = 0, double pan = 0, double pan_rate = 0) {
    for (int i = 0; i < n; ++i) {
      JointState before = j, now = j;
      before.angle[0] += swing_rate * t;
      now.angle[0] += swing_rate * (t + 0.01);
      PanState pan_before{{pan + pan_rate * t, pan + pan_rate * t}, {}}, pan_now{{pan + pan_rate * (t + 0.01), pan + pan_rate * (t + 0.01)}, {}};
      t = std::round((t + 0.01) * 100) / 100;
      world.step(t, 0.01, now, before);
      world.scan(t, 0.01, before, now, pan_before, pan_now, out);
    }
  }
  World world;
  double t = 0;
  std::vector<berm_scan_packet> out;
};

const JointState tucked = {{0, 0.6, -2.2, -1.5}, {}};

TEST(Scanner, TwelveThousandSamplesASecondInOrder) {
  ScanRun run(open_site(), bench::heads_only());
  run.steps(1000, tucked);
  std::map<int, int64_t> samples;
  std::map<int, uint32_t> sequence;
  std::map<int, int> next_index, scanline;
  for (const berm_scan_packet& p : run.out) {
    const int s = p.scanner;
    // A whole number of samples since the start, at exactly n / 12000 s.
    const int64_t n = samples[s];
    EXPECT_EQ(p.time_us, static_cast<uint64_t>((n + 1) * 1'000'000 / 12'000));
    EXPECT_EQ(p.sequence, sequence[s]++);
    EXPECT_EQ(p.first_index, next_index[s]);
    EXPECT_EQ(p.scanline, static_cast<uint32_t>(scanline[s]));
    EXPECT_EQ((p.flags & BERM_SCAN_FLAG_FIRST) != 0, p.first_index == 0);
    EXPECT_LE(p.first_index + p.count, 400);
    EXPECT_EQ((p.flags & BERM_SCAN_FLAG_LAST) != 0, p.first_index + p.count == 400);
    EXPECT_EQ(p.samples_per_revolution, 400);
    EXPECT_EQ(p.sample_period_ns, 83333u);
    samples[s] += p.count;
    next_index[s] += p.count;
    if (next_index[s] == 400) {
      next_index[s] = 0;
      ++scanline[s];
    }
  }
  EXPECT_EQ(samples[0], 120000);
  EXPECT_EQ(samples[1], 120000);
  EXPECT_EQ(scanline[0], 300);
}

TEST(Scanner, PacketsSurviveTheWire) {
  WorldConfig c = bench::site();
  c.scanner.range_stddev = 0.03;
  c.scanner.dust_probability = 0.05;
  c.scanner.outlier_probability = 0.01;
  ScanRun run(c, bench::machine());
  run.steps(50, tucked, 0, 0.3, 0.5);
  bool several = false;
  for (const berm_scan_packet& p : run.out) {
    uint8_t bytes[BERM_SCAN_PACKET_MAX_BYTES];
    const size_t n = berm_scan_encode(&p, bytes);
    ASSERT_GT(n, 0u);
    berm_scan_packet back{};
    ASSERT_EQ(berm_scan_decode(bytes, n, &back), BERM_SCAN_OK);
    for (int i = 0; i < p.count; ++i) {
      for (int k = 0; k < BERM_SCAN_ECHOES; ++k) ASSERT_EQ(back.range[i][k], p.range[i][k]);
      for (int k = 1; k < BERM_SCAN_ECHOES; ++k) ASSERT_TRUE(p.range[i][k] == 0 || p.range[i][k] >= p.range[i][k - 1]) << "nearest first";
      several = several || p.range[i][1] != 0;
    }
  }
  EXPECT_TRUE(several);
}

// Ground z = 0 and a wall at y = 8: every sample has one right answer, also while pan and swing move.
void expect_wall_and_ground(double swing_rate, double pan_rate) {
  WorldConfig c = open_site();
  c.boxes = {{"wall", 0, 8.5, -1, 6, 200, 1, 0}};  // its near face is y = 8
  ScanRun run(c, bench::heads_only());
  run.steps(200, tucked, swing_rate, 1.2, pan_rate);
  int wall = 0, ground = 0, sky = 0;
  for (const berm_scan_packet& p : run.out) {
    int64_t first = static_cast<int64_t>(p.scanline) * 400 + p.first_index;
    for (int i = 0; i < p.count; ++i, ++first) {
      const double t = static_cast<double>(first + 1) / 12000, pan = 1.2 + pan_rate * t, swing = swing_rate * t;
      const double e = 2 * std::numbers::pi * (p.first_index + i) / 400;
      const double hx = 1.30, hy = p.scanner == 0 ? 1.35 : -1.35;
      const double head_y = hx * std::sin(swing) + hy * std::cos(swing);
      const double dy = std::cos(e) * std::sin(pan + swing), dz = std::sin(e);
      const double to_wall = dy > 1e-9 ? (8 - head_y) / dy : 1e9, to_ground = dz < -1e-9 ? 3.3 / -dz : 1e9;
      const double wall_z = 3.3 + to_wall * dz;
      double expected = std::min(to_ground, wall_z < 6 && wall_z > -1 ? to_wall : 1e9);
      if (expected > 59.9 && expected < 60.1) continue;
      if (std::abs(wall_z - 6) < 0.02) continue;  // grazes the wall's top
      if (expected > 60) expected = 0;
      ASSERT_NEAR(range_of(p, i), expected, 0.004 + 1e-6 * expected * expected) << "sample " << first << " index " << p.first_index + i;
      (expected == 0 ? sky : expected == to_ground ? ground : wall)++;
    }
  }
  EXPECT_GT(wall, 1000);
  EXPECT_GT(ground, 1000);
  EXPECT_GT(sky, 1000);
}

TEST(Scanner, WallAndGroundStandingStill) { expect_wall_and_ground(0, 0); }
TEST(Scanner, WallAndGroundWhilePanning) { expect_wall_and_ground(0, 0.4); }
TEST(Scanner, WallAndGroundWhileSwinging) { expect_wall_and_ground(0.3, -0.4); }

// Samples that looked down at the open site by more than 20 degrees, by what came back.
struct Downwards { int all = 0, whole = 0, window = 0, two = 0, alone = 0; };

Downwards downwards(const ScanRun& run, int scanner, double from_deg = 200, double to_deg = 340) {
  Downwards d;
  for (const berm_scan_packet& p : run.out) {
    if (p.scanner != scanner) continue;
    for (int i = 0; i < p.count; ++i) {
      const double mirror = 360.0 * (p.first_index + i) / 400;
      if (mirror < from_deg || mirror >= to_deg) continue;
      const double ground = 3.3 / -std::sin(mirror * degree);
      const int last = p.range[i][1] != 0 ? 1 : 0;
      const bool met = std::abs(range_of(p, i, last) - ground) < 0.05;
      ++d.all;
      d.window += p.range[i][0] == 75 && last == 0 ? 1 : 0;
      d.two += met && last == 1 ? 1 : 0;
      d.whole += met && last == 0 ? 1 : 0;
      d.alone += !met && last == 0 && p.range[i][0] > 75 ? 1 : 0;
    }
  }
  return d;
}

TEST(Scanner, AWindowThatIsCoveredSendsBackItsOwnEchoAlone) {
  WorldConfig c = open_site();
  c.terrain.roughness = 0;
  c.scanner_faults = {{0, false, 0.0, 5.0, {300 * degree, 330 * degree}}, {1, false, 1.0, 1.0}, {0, false, 1.0, 1.0}};
  ScanRun run(c, bench::heads_only());
  run.steps(90, tucked);
  const Downwards covered = downwards(run, 0, 300, 330), left = downwards(run, 0, 200, 300), right = downwards(run, 1);
  EXPECT_GT(covered.all, 800);
  EXPECT_EQ(covered.window, covered.all);
  EXPECT_EQ(left.whole, left.all);
  EXPECT_EQ(right.whole, right.all) << "not yet";
  run.out.clear();
  run.t = 1.0;
  run.steps(90, tucked);
  const Downwards all = downwards(run, 1);
  EXPECT_GT(all.all, 3000);
  EXPECT_EQ(all.window, all.all);
  const Downwards last = downwards(run, 0, 200, 300);
  EXPECT_GT(last.all, 1000);
  EXPECT_EQ(last.window, last.all) << "of those at the same time the last counts";
}

TEST(Scanner, ASilentScannerSendsNothingForItsTime) {
  WorldConfig c = open_site();
  c.scanner_faults = {{1, true, 0.5, 0.5}};
  ScanRun run(c, bench::heads_only());
  run.steps(200, tucked);
  for (const berm_scan_packet& p : run.out)
    if (p.scanner == 1) { EXPECT_FALSE(p.time_us > 500'000 && p.time_us < 980'000) << p.time_us; }
  EXPECT_GT(downwards(run, 1).all, 6500);
}

TEST(Scanner, DustOfTheAirAddsEchoesAndLosesTargetsForItsTime) {
  WorldConfig c = open_site();
  c.terrain.roughness = 0;
  c.dust = {{0.0, 1.0, 0.3, 0.1}};
  ScanRun run(c, bench::heads_only());
  run.steps(98, tucked);
  const Downwards dusty = downwards(run, 0);
  EXPECT_NEAR(1.0 * dusty.two / dusty.all, 0.3, 0.02);
  EXPECT_NEAR(1.0 * dusty.alone / dusty.all, 0.1, 0.02);
  run.steps(4, tucked);
  run.out.clear();
  run.steps(50, tucked);
  const Downwards clear = downwards(run, 0);
  EXPECT_EQ(clear.whole, clear.all);
}

TEST(Scanner, WhatIsDrawnOfNoiseIsTheSameInDust) {
  WorldConfig clear = open_site(), dusty = open_site();
  clear.scanner.range_stddev = dusty.scanner.range_stddev = 0.03;
  clear.scanner.dropout_probability = dusty.scanner.dropout_probability = 0.01;
  dusty.dust = {{0.0, 5.0, 0.4, 0.0}};
  ScanRun a(clear, bench::heads_only()), b(dusty, bench::heads_only());
  a.steps(50, tucked);
  b.steps(50, tucked);
  ASSERT_EQ(a.out.size(), b.out.size());
  for (std::size_t k = 0; k < a.out.size(); ++k)
    for (int i = 0; i < a.out[k].count; ++i) {
      const auto* e = b.out[k].range[i];
      ASSERT_EQ(a.out[k].range[i][0], e[1] != 0 ? e[1] : e[0]) << "the last echo";
    }
}

TEST(Scanner, PanIsReportedForTheFirstAndLastSample) {
  ScanRun run(open_site(), bench::heads_only());
  run.steps(30, tucked, 0, 0.5, 1.0);
  for (const berm_scan_packet& p : run.out) {
    const int64_t first = static_cast<int64_t>(p.scanline) * 400 + p.first_index;
    EXPECT_NEAR(p.pan_start_urad, 1e6 * (0.5 + static_cast<double>(first + 1) / 12000), 1.0);
    EXPECT_NEAR(p.pan_end_urad, 1e6 * (0.5 + static_cast<double>(first + p.count) / 12000), 1.0);
  }
}

// Which parts of the machine shorten the left scanner's ranges.
struct SelfReturns { int boom = 0, bucket = 0, body = 0, tracks = 0, elsewhere = 0; };

SelfReturns self_returns(double pan, double pan_rate) {
  ScanRun bare(open_site(), bench::heads_only()), whole(open_site(), bench::machine());
  const JointState j = bench::reach(bench::machine(), 0, 6.5, 1.5, -170 * degree);
  bare.steps(300, j, 0, pan, pan_rate);
  whole.steps(300, j, 0, pan, pan_rate);
  SelfReturns seen;
  for (size_t k = 0; k < whole.out.size(); ++k) {
    const berm_scan_packet& p = whole.out[k];
    if (p.scanner != 0) continue;
    for (int i = 0; i < p.count; ++i) {
      const double r = range_of(p, i);
      if (r == 0 || std::abs(r - range_of(bare.out[k], i)) < 0.02) continue;
      const double f = p.count > 1 ? i / (p.count - 1.0) : 0, at = 1e-6 * (p.pan_start_urad + f * (p.pan_end_urad - p.pan_start_urad));
      const double e = 2 * std::numbers::pi * (p.first_index + i) / 400;
      const double x = 1.30 + r * std::cos(e) * std::cos(at), y = 1.35 + r * std::cos(e) * std::sin(at), z = 3.3 + r * std::sin(e);
      if (x < 1.21 && std::abs(y) < 1.31 && z > 0.99 && z < 2.96) ++seen.body;
      else if (x > 1.2 && std::abs(y) < 0.26 && z > 1.5) ++seen.boom;
      else if (x > 5 && std::abs(y) < 0.57) ++seen.bucket;
      else if (std::abs(x) < 2.11 && z < 1.01) ++seen.tracks;
      else ++seen.elsewhere;
    }
  }
  return seen;
}

TEST(Scanner, SeesItsOwnImplements) {
  const SelfReturns seen = self_returns(-0.1, -0.08);
  EXPECT_GT(seen.boom, 50);
  EXPECT_GT(seen.bucket, 10);
  EXPECT_EQ(seen.elsewhere, 0);
}

TEST(Scanner, SeesItsOwnBodyAndTracks) {
  const SelfReturns seen = self_returns(0.3, 0.1);
  EXPECT_GT(seen.body, 50);
  EXPECT_GT(seen.tracks, 50);
  EXPECT_EQ(seen.elsewhere, 0);
}

TEST(Scanner, SeesPeopleAndTrucks) {
  WorldConfig c = open_site();
  MoverConfig m;
  m.name = "person";
  m.height = 1.8;
  m.radius = 0.25;
  m.waypoints = {{1.30, 9.35, 0}};
  c.movers = {m};
  ScanRun run(c, bench::heads_only());
  run.steps(20, tucked, 0, std::numbers::pi / 2);
  int hits = 0;
  for (const berm_scan_packet& p : run.out) {
    if (p.scanner != 0) continue;
    for (int i = 0; i < p.count; ++i) {
      const double e = 2 * std::numbers::pi * (p.first_index + i) / 400, z = 3.3 + range_of(p, i) * std::sin(e);
      if (std::cos(e) > 0 && z > 0.05 && z < 1.75 && range_of(p, i) > 0) {
        EXPECT_NEAR(range_of(p, i) * std::cos(e), 7.75, 0.01);
        ++hits;
      }
    }
  }
  EXPECT_GT(hits, 50);
}

TEST(Scanner, TheWorldKnowsWhatPeopleSentBackAndWhoIsNotThereSendsNothing) {
  WorldConfig c = open_site();
  MoverConfig p;
  p.name = "first";
  p.height = 1.8, p.radius = 0.25;
  p.waypoints = {{6.0, 0.0, 0.0}};
  c.movers = {p, p};
  c.movers[1].name = "second";
  c.movers[1].waypoints = {{0.0, 6.0, 0.0}};
  c.movers[1].appears_s = 1e9;
  c.boxes.push_back({"box", -6.0, 0.0, 0.0, 2.0, 1.0, 1.0, 0.0});
  ScanRun run(c, bench::heads_only());
  std::array<int, 2> returns{};
  const auto look = [&](double pan, double rate) {
    run.steps(1, tucked, 0, pan, rate);
    for (const MoverReturn& r : run.world.mover_returns()) {
      const double x = r.mover == 0 ? 6.0 : 0.0, y = r.mover == 0 ? 0.0 : 6.0;
      EXPECT_NEAR(std::hypot(r.x - x, r.y - y), 0.25, r.z > 1.79 ? 0.25 : 1e-6) << "not on it";
      EXPECT_TRUE(r.z > -0.01 && r.z < 1.81) << r.z;
      ++returns[r.mover];
    }
  };
  for (int i = 0; i < 300; ++i) look(0.0, 0.8);
  EXPECT_GT(returns[0], 20);
  EXPECT_EQ(returns[1], 0);
  EXPECT_FALSE(run.world.mover_present(1));
  run.world.send_mover(1, c.movers[1], run.t);
  for (int i = 0; i < 300; ++i) look(4.8, -0.8);
  EXPECT_GT(returns[1], 20);
  EXPECT_TRUE(run.world.mover_present(1));
}

TEST(Scanner, NoiseOutliersDropoutsAndDustHaveTheirShares) {
  WorldConfig c = open_site();
  c.scanner.range_stddev = 0.03;
  c.scanner.outlier_probability = 0.01;
  c.scanner.dropout_probability = 0.02;
  c.scanner.dust_probability = 0.03;
  ScanRun run(c, bench::heads_only()), exact(open_site(), bench::heads_only());
  run.steps(500, tucked, 0, 1.2);
  exact.steps(500, tucked, 0, 1.2);
  int n = 0, dropped = 0, outliers = 0, dust = 0;
  double sum = 0, sum2 = 0;
  for (size_t k = 0; k < run.out.size(); ++k) {
    for (int i = 0; i < run.out[k].count; ++i) {
      const double truth = range_of(exact.out[k], i);
      if (truth == 0 || truth < 1) continue;
      ++n;
      const uint16_t* echo = run.out[k].range[i];
      const int last = echo[1] != 0 ? 1 : 0;
      const double error = range_of(run.out[k], i, last) - truth;
      if (echo[0] == 0) ++dropped;
      else if (error < -0.3) ++outliers;
      else {
        dust += last;
        sum += error;
        sum2 += error * error;
      }
    }
  }
  ASSERT_GT(n, 30000);
  EXPECT_NEAR(dropped / static_cast<double>(n), 0.02, 0.004);
  EXPECT_NEAR(outliers / static_cast<double>(n), 0.01, 0.003);
  EXPECT_NEAR(dust / static_cast<double>(n), 0.03, 0.005);
  EXPECT_NEAR(sum / n, 0, 0.003);
  EXPECT_NEAR(std::sqrt(sum2 / n), 0.03, 0.003);
}

TEST(Scanner, DirtyWindowIsReportedAndLeavesTheLastEchoRight) {
  WorldConfig c = open_site();
  c.scanner.window_percent = 50;
  ScanRun run(c, bench::heads_only()), exact(open_site(), bench::heads_only());
  run.steps(100, tucked, 0, 1.2);
  exact.steps(100, tucked, 0, 1.2);
  int doubled = 0;
  for (size_t k = 0; k < run.out.size(); ++k) {
    EXPECT_TRUE(run.out[k].flags & BERM_SCAN_FLAG_WINDOW_DIRTY);
    EXPECT_EQ(run.out[k].window_percent, 50);
    for (int i = 0; i < run.out[k].count; ++i) {
      if (exact.out[k].range[i][0] == 0 || run.out[k].range[i][1] == 0) continue;
      ++doubled;
      ASSERT_EQ(run.out[k].range[i][1], exact.out[k].range[i][0]);
    }
  }
  EXPECT_GT(doubled, 500);
}

}  // namespace
}  // namespace berm::plant
