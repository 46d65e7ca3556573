// Random sequences of points, updates and forgotten cells against the reference model, cell by cell. A failure prints its seed; BERM_SEED repeats it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <random>

#include "monitor_scene.hpp"
#include "reference_monitor.hpp"

namespace berm::core_test {
namespace {

int flag_of(Held held) {
  switch (held) {
    case Held::kEmpty: return SK_FLAG_EMPTY;
    case Held::kSet: return SK_FLAG_SET;
    case Held::kInterpolated: return SK_FLAG_INTERPOLATED;
    case Held::kChanged: return SK_FLAG_CHANGED;
    case Held::kObstacle: break;
  }
  return SK_FLAG_OBSTACLE;
}

int flag_of(Fresh fresh) {
  switch (fresh) {
    case Fresh::kEmpty: return SK_FLAG_EMPTY;
    case Fresh::kSet: return SK_FLAG_SET;
    case Fresh::kInterpolated: return SK_FLAG_INTERPOLATED;
    case Fresh::kNotVisited: return SK_FLAG_NOT_VISITED;
    case Fresh::kInterpolatedNotVisited: break;
  }
  return SK_FLAG_INTERPOLATED_NOT_VISITED;
}

struct Tally {
  long obstacles = 0, changes = 0, cleared = 0, overflows = 0, forgotten = 0;
};

void expect_alike(const MonitorScene& scene, ReferenceMonitor& reference, int y0, int x0, int side) {
  for (int y = y0; y < y0 + side; ++y)
    for (int x = x0; x < x0 + side; ++x) {
      const ReferenceCell& c = reference.at(y, x);
      ASSERT_EQ(flag_name(scene.temporary_flag(y, x)), flag_name(flag_of(c.fresh))) << y << " " << x;
      ASSERT_EQ(flag_name(scene.accumulated(y, x).flag), flag_name(flag_of(c.held))) << y << " " << x;
      if (c.held != Held::kEmpty) {
        ASSERT_EQ(scene.accumulated(y, x).height_mm, c.height) << y << " " << x;
      }
      if (c.held == Held::kObstacle) {
        ASSERT_EQ(scene.accumulated(y, x).obstacle_height_mm, c.obstacle_height) << y << " " << x;
      }
    }
}

void run(std::mt19937& random, bool continuous, bool overflowing, Tally& tally) {
  const auto draw = [&random](int low, int high) { return std::uniform_int_distribution<>(low, high)(random); };
  MonitorScene scene(continuous);
  scene.rules->wait_us = draw(0, 5) * kPeriod;
  ReferenceMonitor reference({kHeightThreshold, kNeighbourThreshold, kSlopeThreshold, scene.rules->wait_us, continuous}, SK_MAP_CELLS);
  const int side = 6, y0 = draw(0, 1) * (SK_MAP_CELLS - side), x0 = draw(0, 2) * 49;
  const auto point = [&](int y, int x, int z, bool interpolated) {
    sk_monitor_insert(scene.monitor.get(), y, x, z, interpolated, scene.now_us);
    reference.point(y, x, z, interpolated, scene.now_us);
  };
  constexpr int kHeights[] = {-300, 0, 0, 0, 240, 260, 490, 510, 800, 1100, 1700, 2300};
  for (int update = 0; update < 60; ++update) {
    if (overflowing && update % 7 == 3)
      for (int y = 0; y < SK_MAP_CELLS; ++y)
        for (int x = 0; x < SK_MAP_CELLS; ++x) point(y, x, draw(0, 20) == 0 ? 1700 : 0, false);
    for (int i = draw(0, 40); i > 0; --i) {
      const int y = draw(y0 - 1, y0 + side), x = draw(x0 - 1, x0 + side), z = kHeights[draw(0, 11)];
      const bool interpolated = draw(0, 3) == 0;
      for (int points = draw(1, 3); points > 0; --points) point(y, x, z + draw(-10, 10), interpolated);
    }
    if (draw(0, 4) == 0) {
      const int y = draw(y0, y0 + side - 1), x = draw(x0, x0 + side - 1);
      sk_monitor_forget(scene.monitor.get(), y, x);
      reference.at(y, x) = {};
      ++tally.forgotten;
    }
    long before = 0, after = 0;
    for (int y = y0; y < y0 + side; ++y)
      for (int x = x0; x < x0 + side; ++x) before += scene.accumulated(y, x).flag == SK_FLAG_OBSTACLE;
    tally.overflows += scene.monitor->overflowed;
    scene.step();
    reference.update(scene.now_us);
    for (int y = y0; y < y0 + side; ++y)
      for (int x = x0; x < x0 + side; ++x) {
        after += scene.accumulated(y, x).flag == SK_FLAG_OBSTACLE;
        tally.changes += scene.accumulated(y, x).flag == SK_FLAG_CHANGED;
      }
    tally.obstacles += after;
    tally.cleared += after < before;
    expect_alike(scene, reference, y0, x0, side);
    if (testing::Test::HasFatalFailure()) return;
  }
}

void run_many(bool overflowing, int runs) {
  const char* given = std::getenv("BERM_SEED");
  const unsigned seed = given != nullptr ? static_cast<unsigned>(std::strtoul(given, nullptr, 10)) : std::random_device{}();
  std::cout << "BERM_SEED=" << seed << "\n";
  std::mt19937 random(seed);
  Tally tally;
  for (int i = 0; i < runs; ++i) {
    run(random, i % 2 == 0, overflowing, tally);
    if (testing::Test::HasFatalFailure()) FAIL() << "BERM_SEED=" << seed << ", run " << i;
  }
  std::cout << "cells after updates: " << tally.obstacles << " OBSTACLE, " << tally.changes << " CHANGED; " << tally.cleared << " updates with fewer obstacles, "
            << tally.overflows << " with a full list; " << tally.forgotten << " cells forgotten\n";
  EXPECT_GT(tally.obstacles, 100);
  EXPECT_GT(tally.changes, 100);
  EXPECT_GT(tally.cleared, 10);
  EXPECT_GT(tally.forgotten, 10);
  EXPECT_EQ(tally.overflows > 0, overflowing);
}

// verifies: SK-WM-4, SK-WM-5, SK-WM-6, SK-WM-10, SK-WM-11, SK-WM-12, SK-WM-13, SK-WM-15, SK-WM-20, SK-WM-21, SK-WM-22, SK-WM-23, SK-WM-24, SK-WM-25
// verifies: SK-WM-8, SK-WM-26, SK-WM-27, SK-WM-28, SK-WM-29, SK-WM-30
TEST(MonitorSequences, DoAsTheReferenceModelDoes) { run_many(false, 600); }

// verifies: SK-WM-7
TEST(MonitorSequences, DoSoWithAFullList) { run_many(true, 8); }

}  // namespace
}  // namespace berm::core_test
