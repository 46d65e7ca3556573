#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plant/world/echo_receiver.hpp"
#include "plant/world/random.hpp"

namespace berm::plant {
namespace {

constexpr double gate = 0.3;

struct Trial { int all = 0, none = 0, dust = 0, met = 0, front = 0, wrong_unflagged = 0; double sum2 = 0, farthest = -1e9; };

// Many pulses at targets about one range; front: of a cloud.
struct Bench {
  Bench() : last_pulse(PulseLidar{}, Ranging::last_pulse, gate), trailing_edge(PulseLidar{}, Ranging::trailing_edge, gate) {}

  Trial pulses(const EchoReceiver& receiver, PulsePath path, int n, double front = 0.0) {
    Trial t;
    const double range = path.target ? path.target->range : 0.0;
    for (int i = 0; i < n; ++i) {
      if (path.target) path.target->range = range + 0.2 * random.uniform();
      wave.sample(path, seed++);
      const Echoes e = receiver.receive(wave);
      ++t.all;
      t.dust += e.dust ? 1 : 0;
      if (e.count == 0) {
        ++t.none;
        continue;
      }
      for (int k = 1; k < e.count; ++k) EXPECT_LE(e.range[static_cast<size_t>(k - 1)], e.range[static_cast<size_t>(k)]);
      const double found = e.range[static_cast<size_t>(e.count - 1)], error = path.target ? found - path.target->range : found;
      const bool met = std::abs(error) < 0.15;
      t.met += met ? 1 : 0;
      t.front += std::abs(found - front) < 0.5 ? 1 : 0;
      t.wrong_unflagged += !met && !e.dust ? 1 : 0;
      t.sum2 += error * error;
      t.farthest = std::max(t.farthest, error);
    }
    return t;
  }
  static double rms(const Trial& t) { return std::sqrt(t.sum2 / std::max(1, t.all - t.none)); }

  EchoReceiver last_pulse, trailing_edge;
  ReturnWaveform wave;
  Random random{11};
  std::uint64_t seed = 1000;
};

PulsePath at(double range, double reflectivity, double incidence_deg = 0.0, double window = 98.0) {
  return {window, {}, HardTarget{range, reflectivity, std::cos(incidence_deg * std::numbers::pi / 180)}};
}

PulsePath behind(const CloudSpan& cloud, double range, double reflectivity = 0.3) {
  PulsePath p = at(range, reflectivity);
  p.clouds = {cloud};
  return p;
}

// What ECHOES.md states: root mean square error in clear air.
TEST(EchoReceiver, RangesHardTargetsWithinItsStatedAccuracy) {
  Bench b;
  for (const double range : {1.0, 2.0, 4.0, 8.0, 15.0, 30.0, 50.0})
    for (const double reflectivity : {0.1, 0.3, 0.9})
      for (const double incidence : {0.0, 30.0, 60.0}) {
        const Trial lead = b.pulses(b.last_pulse, at(range, reflectivity, incidence), 200), trail = b.pulses(b.trailing_edge, at(range, reflectivity, incidence), 200);
        const std::string where = std::to_string(range) + " m, " + std::to_string(reflectivity) + ", " + std::to_string(incidence) + " degrees";
        EXPECT_LT(Bench::rms(lead), range <= 30.0 ? 0.020 : 0.060) << where;
        EXPECT_LT(Bench::rms(trail), range <= 30.0 ? 0.025 : 0.070) << where;
        EXPECT_EQ(lead.dust + trail.dust, 0) << where << ": no dust there";
        const bool dimmest = range == 50.0 && reflectivity == 0.1 && incidence == 60.0;  // 8 times the noise: now and then below the threshold
        EXPECT_LE(lead.none + trail.none, dimmest ? 40 : 0) << where;
      }
}

TEST(EchoReceiver, TheTrailingEdgeIsTheLessAccurateInClearAir) {
  Bench b;
  double lead = 0, trail = 0;
  for (const double range : {25.0, 30.0, 35.0, 40.0, 45.0}) {
    lead += b.pulses(b.last_pulse, at(range, 0.1), 2000).sum2;
    trail += b.pulses(b.trailing_edge, at(range, 0.1), 2000).sum2;
  }
  const double ratio = std::sqrt(trail / lead);
  RecordProperty("trailing_over_leading", std::to_string(ratio));
  EXPECT_GT(ratio, 1.05);
  EXPECT_LT(ratio, 1.5);
}

TEST(EchoReceiver, NeverRangesTheWindow) {
  Bench b;
  for (const double percent : {100.0, 98.0, 80.0, 50.0, 20.0, 0.0}) {
    for (const EchoReceiver* r : {&b.last_pulse, &b.trailing_edge}) {
      PulsePath nothing{percent, {}, std::nullopt};
      const Trial open = b.pulses(*r, nothing, 500);
      EXPECT_EQ(open.none, open.all) << percent;
      if (percent < 50.0) continue;
      const Trial wall = b.pulses(*r, at(6.0, 0.3, 0.0, percent), 200);
      EXPECT_EQ(wall.met, wall.all) << percent;
      EXPECT_EQ(wall.dust, 0) << percent << ": the window's echo counts as none";
    }
  }
}

TEST(EchoReceiver, ACloudWellBeforeTheTargetIsSeenThroughAndFlagged) {
  Bench b;
  for (const double extinction : {0.1, 0.3, 0.75}) {
    for (const EchoReceiver* r : {&b.last_pulse, &b.trailing_edge}) {
      const Trial t = b.pulses(*r, behind({3.0, 5.0, extinction}, 9.0), 300);
      EXPECT_EQ(t.met, t.all) << extinction;
      EXPECT_EQ(t.dust, t.all) << extinction;
    }
  }
}

TEST(EchoReceiver, WithinACloudTheLastPulseIsItsFrontAndTheTrailingEdgeTheTarget) {
  Bench b;
  for (const double extinction : {0.1, 0.3, 0.5, 0.75}) {
    const PulsePath p = behind({5.5, 12.0, extinction}, 8.0);
    const Trial lead = b.pulses(b.last_pulse, p, 300, 5.5), trail = b.pulses(b.trailing_edge, p, 300, 5.5);
    EXPECT_EQ(lead.front, lead.all) << extinction;
    EXPECT_EQ(lead.met, 0) << extinction;
    EXPECT_EQ(trail.met, trail.all) << extinction;
    EXPECT_LT(Bench::rms(trail), 0.03) << extinction;
    EXPECT_EQ(lead.dust, lead.all) << extinction;
    EXPECT_EQ(trail.dust, trail.all) << extinction;
  }
}

TEST(EchoReceiver, ACloudThatTouchesTheTargetMovesTheTrailingEdgeLittle) {
  Bench b;
  const PulsePath p = behind({7.0, 8.0, 1.0}, 8.0);
  const Trial lead = b.pulses(b.last_pulse, p, 300, 7.0), trail = b.pulses(b.trailing_edge, p, 300);
  EXPECT_EQ(lead.met, 0);
  EXPECT_EQ(trail.met, trail.all);
  EXPECT_LT(Bench::rms(trail), 0.03);
}

// Beyond what light gets through, both tell the cloud: flagged up to 1.5 /m, as a hard wall from 3 /m. Never farther than what stands there.
TEST(EchoReceiver, VeryHeavyDustIsRangedAsAnObstacleAndNeverAsFreeWay) {
  Bench b;
  for (const double extinction : {1.5, 2.0, 3.0, 5.0, 10.0}) {
    for (const EchoReceiver* r : {&b.last_pulse, &b.trailing_edge}) {
      const Trial t = b.pulses(*r, behind({5.5, 12.0, extinction}, 8.5), 300, 5.5);
      EXPECT_EQ(t.none, 0) << extinction;
      EXPECT_EQ(t.met, 0) << extinction;
      EXPECT_LT(t.farthest, 0.0) << extinction;
      EXPECT_EQ(t.front, t.all) << extinction;
      if (extinction == 1.5) { EXPECT_EQ(t.wrong_unflagged, 0); }
      if (extinction >= 3.0) { EXPECT_EQ(t.wrong_unflagged, t.all) << extinction << ": a wall of dust returns as a hard target does"; }
    }
  }
}

TEST(EchoReceiver, WhatIsTooDimReturnsNothing) {
  Bench b;
  for (const EchoReceiver* r : {&b.last_pulse, &b.trailing_edge}) {
    const Trial black = b.pulses(*r, at(58.0, 0.02), 300);
    EXPECT_EQ(black.none, black.all);
    // Dust too thin to be seen itself, far away, takes what is left.
    const Trial hazy = b.pulses(*r, behind({25.0, 50.0, 0.05}, 50.0, 0.1), 300);
    EXPECT_EQ(hazy.none, hazy.all);
    const Trial clear = b.pulses(*r, at(50.0, 0.1), 300);
    EXPECT_EQ(clear.none, 0);
  }
}

TEST(EchoReceiver, ThreeEchoesAtMostAndTheLastOnesOfThem) {
  Bench b;
  PulsePath p = at(20.0, 0.3);
  p.clouds = {{4.0, 4.4, 0.2}, {8.0, 8.4, 0.3}, {12.0, 12.4, 0.5}, {16.0, 16.4, 1.0}};
  b.wave.sample(p, 3);
  EXPECT_EQ(b.last_pulse.pulses(b.wave).size(), 5u);
  const Echoes e = b.last_pulse.receive(b.wave);
  ASSERT_EQ(e.count, 3);
  EXPECT_NEAR(e.range[0], 12.2, 0.3);
  EXPECT_NEAR(e.range[1], 16.2, 0.3);
  EXPECT_NEAR(e.range[2], 20.0, 0.05);
  EXPECT_TRUE(e.dust);
}

}  // namespace
}  // namespace berm::plant
