// How long the map keeps what it saw, and when it forgets what is still there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "draw.hpp"
#include "mini_machine.hpp"

namespace berm::kernel::test {
namespace {

constexpr std::uint64_t kSeed = 90815;

// How long a thing that was seen is not as high in the map as it is. Counts from begin(), and only what is found again.
class Blind {
 public:
  Blind(Sweep& sweep, const std::vector<Spot>& footprint, std::int32_t high_mm) : sweep_(sweep), footprint_(footprint), high_mm_(high_mm) {
    sweep.watch = [this] { look(); };
  }
  Blind(const Blind&) = delete;
  Blind& operator=(const Blind&) = delete;

  bool high() const { return highest_top(sweep_.map(), footprint_) >= high_mm_; }
  void begin() { high_us_ = sweep_.now_us(); }
  double longest() const { return longest_; }
  int times() const { return times_; }

 private:
  void look() {
    if (high_us_ < 0) return;
    if (!high()) {
      forgotten_ = true;
      return;
    }
    if (forgotten_) {
      ++times_;
      longest_ = std::max(longest_, static_cast<double>(sweep_.now_us() - high_us_) * 1e-6);
    }
    forgotten_ = false;
    high_us_ = sweep_.now_us();
  }

  Sweep& sweep_;
  std::vector<Spot> footprint_;
  std::int32_t high_mm_;
  std::int64_t high_us_ = -1;
  bool forgotten_ = false;
  double longest_ = 0.0;
  int times_ = 0;
};

class MapMemory : public ::testing::Test {
 protected:
  berm_parameters parameters = berm::test::demo_parameters();
  PanRates rates = pan_rates(parameters);
};

// verifies: SK-FI-11
TEST_F(MapMemory, WhatWasSeenOnceIsKeptForAGenerationAndGoneAfterTwoSweepsMore) {
  for (std::size_t d = 0; d < kDistances.size(); ++d) {
    Sweep sweep(parameters, kSwing);
    const double pan = degrees(60), height = 1.2;
    const Prism thing = cylinder_around(sweep.at(0, pan, kDistances[d]), stated("lines of a sweep: app", d).width, height);
    const auto top = [&] { return highest_top(sweep.map(), thing.footprint); };
    const auto pass = [&](double phase) { sweep.pan(0, degrees(55), degrees(65), rates.app, phase); };
    sweep.scene.thing = {thing};
    pass(0);
    const std::int32_t seen = top();
    ASSERT_GE(seen, (height - row_height(parameters, kDistances[d], 1)) * 1e3 - kGroundMm);
    sweep.scene.thing.clear();
    const std::int64_t gone_us = sweep.now_us();
    sweep.watch = [&] {
      if (sweep.now_us() - gone_us < parameters.generation_us) { EXPECT_EQ(top(), seen) << kDistances[d]; }
    };
    while (sweep.now_us() - gone_us < parameters.generation_us) pass(100);
    while (sweep.now_us() - gone_us < 3 * parameters.generation_us) pass(200);
    EXPECT_LE(top(), kGroundMm) << kDistances[d];
  }
}

// A scanner that stands, or turns back within the cell: one line keeps the cell fresh, and what stands beside the line is forgotten.
// verifies: SK-FI-12
TEST_F(MapMemory, AStandingScannerForgetsAPostBesideItsLine) {
  for (const double distance : kDistances) {
    // The head looks along the grid's x; the post fills four fifths of a cell's width, the line passes beside it.
    Sweep sweep(parameters, degrees(-120));
    const Spot head = sweep.head(0);
    const int iy = static_cast<int>(std::floor((head.y + 0.02) / kCell)), ix = static_cast<int>(std::floor((head.x + distance) / kCell));
    const Spot low = {ix * kCell, iy * kCell};
    const Prism post = box({low.x + 0.5 * kCell, low.y + 0.14}, 0.0, 0.24, 0.24, 0.0, 1.8);
    sweep.scene.thing = {post};
    const auto pan_to = [&](double y) { return std::atan2(y - head.y, distance) + degrees(120); };
    sweep.pan(0, pan_to(low.y) - degrees(3), pan_to(low.y) + degrees(3), degrees(10), 0.0);
    ASSERT_GE(highest_top(sweep.map(), post.footprint), 1500) << distance;
    sweep.stare(0, pan_to(low.y + 0.28), 2.5, 0.0);
    EXPECT_TRUE(all_low(sweep.map(), post.footprint, sweep.now_us() - 200000, kGroundMm)) << distance << " m: fresh, low, and the post still stands";
  }
}

// verifies: SK-FI-12
TEST_F(MapMemory, AStandingScannerDoesNotForgetWhatCoversACell) {
  constexpr int kTrials = 8;
  std::mt19937_64 random(kSeed);
  int seen = 0;
  for (std::size_t d = 0; d < kDistances.size(); ++d)
    for (int i = 0; i < kTrials; ++i) {
      const double row = stated("samples of a line", d).height, height = uniform(random, row, 2.0);
      const Placed placed = draw_thing(parameters, kDistances[d], stated("sweeps that end in a cell", d).width, 0.0, height, random);
      placed.pass(degrees(10), random);
      const Spot axis = placed.sweep->at(placed.scanner, placed.pan, kDistances[d]);
      const CellRange cell = cells_of({axis});
      for (int k = 0; k < 3; ++k) placed.sweep->stare(placed.scanner, placed.pan + uniform(random, -1.2, 1.2) * placed.half_angle, 2.5, uniform(random, 0, kSamplesPerTurn));
      const auto& map = placed.sweep->map();
      // The cell in the middle may lie in the thing's own shadow, then it was never seen; else it is high.
      if (map.seen_us[cell.y_low][cell.x_low] < 0) continue;
      ++seen;
      ASSERT_GE(sk_map_top(&map, cell.y_low, cell.x_low), (height - row_height(parameters, kDistances[d] + 0.5, 1)) * 1e3 - kGroundMm)
          << kDistances[d] << " m, seed " << kSeed << ", thing " << i;
    }
  EXPECT_GT(seen, kTrials);
}

// A generation that begins while a sweep crosses the cell parts that sweep in two; two sweeps later the thing is forgotten until the line comes to it.
// verifies: SK-FI-13
TEST_F(MapMemory, AGenerationThatPartsASweepHidesNoLongerThanStated) {
  constexpr int kTrials = 120;
  std::mt19937_64 random(kSeed + 2);
  for (std::size_t d = 0; d < kDistances.size(); ++d) {
    double longest = 0.0;
    int times = 0;
    for (int i = 0; i < kTrials; ++i) {
      const double height = uniform(random, 0.5, 1.8);
      Placed placed = draw_thing(parameters, kDistances[d], stated("lines of a sweep: app", d).width, 0.0, height, random);
      Sweep& sweep = *placed.sweep;
      Blind blind(sweep, placed.thing().footprint, static_cast<std::int32_t>((height - row_height(parameters, kDistances[d], 1)) * 1e3) - kGroundMm);
      // There, back just before a generation is over, and there again after one more.
      const double reach = placed.half_angle + kCell * 1.5 / kDistances[d], span = 2.0 * reach / rates.app;
      double side = 1.0;
      for (const double period : {uniform(random, 0.8, 1.0), 1.3, 0.0}) {
        sweep.pan(placed.scanner, placed.pan - side * reach, placed.pan + side * reach, rates.app, uniform(random, 0, kSamplesPerTurn));
        ASSERT_TRUE(blind.high()) << "after a whole pass; " << kDistances[d] << " m, seed " << kSeed + 2 << ", thing " << i;
        side = -side;
        sweep.wait(std::max(0.0, period - span - 0.05));
        blind.begin();
      }
      longest = std::max(longest, blind.longest());
      times += blind.times();
    }
    std::cout << kDistances[d] << " m, seed " << kSeed + 2 << ": forgotten " << times << " times in " << kTrials << " things, " << longest << " s at the longest (stated "
              << stated("generations that part a sweep", d).seconds << " s)\n";
    EXPECT_LE(longest, stated("generations that part a sweep", d).seconds);
  }
}

// Where the lines lie closer than a cell is wide: out to 13 m along the grid.
// verifies: SK-FI-13
TEST_F(MapMemory, AGenerationThatPartsASweepDoesHide) {
  for (const double distance : {5.0, 10.0}) {
    Sweep sweep(parameters, degrees(-120));  // the head looks along the grid's x; a post at the left edge of a cell
    const Spot head = sweep.head(0);
    const Spot low = {std::floor((head.x + distance) / kCell) * kCell, std::floor((head.y + 0.02) / kCell) * kCell};
    const Spot middle = {low.x + 0.15, low.y + 0.25};
    const Prism post = box(middle, 0.0, 0.06, 0.06, 0.0, 1.0);
    sweep.scene.thing = {post};
    Blind blind(sweep, post.footprint, 800);
    const double post_pan = std::atan2(middle.y - head.y, middle.x - head.x) + degrees(120);
    // Each pass's line 4 meets the post halfway up; the lines before it, or behind it on the way back, pass through the cell beside it.
    const double index = kSamplesPerTurn - std::atan2(parameters.scanner[0].z_mm * 1e-3 - 0.5, distance) / degrees(360.0 / kSamplesPerTurn);
    const double until = (4 * kSamplesPerTurn + index) * kSamplePeriod, whole = until + 2.5 * kLinePeriod;
    const auto pass = [&](double way) { sweep.pan(0, post_pan - way * rates.app * until, post_pan + way * rates.app * (whole - until), rates.app, 0.0); };
    const auto seconds = [&] { return static_cast<double>(sweep.now_us()) * 1e-6; };
    const int lines_before = static_cast<int>(0.25 / (distance * rates.app * kLinePeriod));
    const double generation = seconds() + until - lines_before * kLinePeriod;  // when it begins in the cell
    pass(1.0);
    ASSERT_TRUE(blind.high()) << distance;
    sweep.wait(generation + parameters.generation_us * 1e-6 - 0.015 - until - seconds());  // back to the post at its very end
    pass(-1.0);
    ASSERT_TRUE(blind.high()) << distance;
    sweep.wait(parameters.generation_us * 1e-6 + 0.2);
    blind.begin();
    pass(1.0);
    std::cout << distance << " m: a post that three passes met is forgotten for " << blind.longest() << " s\n";
    EXPECT_EQ(blind.times(), 1) << distance;
    EXPECT_GE(blind.longest(), 0.3 * cell_crossing(distance, rates.app)) << distance;
  }
}

// verifies: SK-FI-14
TEST_F(MapMemory, NoHeightThatCanBeReachedIsClampedAndNoBorderIsFree) {
  Sweep sweep(parameters, kSwing);
  sk_point tower{9000, 9000, SK_HEIGHT_MAX_MM};
  ASSERT_GT(sk_raster_segment(&sweep.map(), &tower, &tower, sweep.now_us(), parameters.generation_us), 0);
  EXPECT_EQ(highest_top(sweep.map(), {{9.0, 9.0}}), SK_HEIGHT_MAX_MM);
  EXPECT_GT(SK_HEIGHT_MAX_MM, (parameters.boom_pin_z_mm + 1e3 * implement_reach(parameters)) + parameters.margin_mm);
  EXPECT_EQ(sk_map_top(&sweep.map(), -1, 5), SK_HEIGHT_MAX_MM);
  EXPECT_EQ(sk_map_top(&sweep.map(), 5, SK_MAP_CELLS), SK_HEIGHT_MAX_MM);
}

}  // namespace
}  // namespace berm::kernel::test
