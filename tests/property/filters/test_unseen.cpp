// Places that no return comes from: shadows, surfaces without return, packets that did not arrive.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "draw.hpp"
#include "mini_machine.hpp"

namespace berm::kernel::test {
namespace {

constexpr std::uint64_t kSeed = 90814;

class Unseen : public ::testing::Test {
 protected:
  berm_parameters parameters = berm::test::demo_parameters();
  PanRates rates = pan_rates(parameters);

  bool any_current(Sweep& sweep, const std::vector<Spot>& footprint) const {
    const CellRange range = cells_of(footprint);
    for (int iy = range.y_low; iy <= range.y_high; ++iy)
      for (int ix = range.x_low; ix <= range.x_high; ++ix)
        if (sweep.map().seen_us[iy][ix] >= sweep.now_us() - parameters.fresh_us) return true;
    return false;
  }
};

// A hand-wide thing nearer to the head than range_min; a person comes to stand behind it.
// verifies: SK-FI-6, SK-FI-11
TEST_F(Unseen, AShadowHidesAPersonUntilTheGroundIsStale) {
  for (std::size_t d = 0; d < kDistances.size(); ++d) {
    const double distance = kDistances[d], pan = degrees(60), near_range = 0.9 * parameters.range_min_mm * 1e-3;
    for (const bool shadowed : {true, false}) {
      Sweep sweep(parameters, kSwing);
      sweep.pan(0, degrees(48), degrees(72), degrees(10), 0.0);
      const std::int64_t left_us = sweep.now_us();
      const Prism person = box(sweep.at(0, pan, distance), sweep.bearing(pan), 0.3, 0.5, 0.0, 1.8);
      // wide enough to keep lines that lie a line's distance beside the person's cells from them
      if (shadowed) sweep.scene.thing.push_back(box(sweep.at(0, pan, near_range), sweep.bearing(pan), 0.02, 0.25, 2.0, 4.0));
      sweep.scene.thing.push_back(person);
      for (int pass = 0; pass < 3; ++pass) {
        sweep.pan(0, degrees(50), degrees(70), rates.app, 50.0 * pass);
        sweep.wait(5.0);
      }
      if (!shadowed) {
        EXPECT_GE(highest_top(sweep.map(), person.footprint), 1500) << distance << " m";
        continue;
      }
      EXPECT_TRUE(all_low(sweep.map(), person.footprint, sweep.now_us() - parameters.fresh_us, kGroundMm)) << distance << " m";
      const double hidden = stated("shadow, range limits", d).seconds;
      sweep.wait(hidden + 0.1 - static_cast<double>(sweep.now_us() - left_us) * 1e-6);
      EXPECT_FALSE(any_current(sweep, person.footprint)) << distance << " m: stale is blocked";
    }
  }
}

// verifies: SK-FI-7
TEST_F(Unseen, WhatReturnsNothingAndCoversACellIsNeverTakenForGround) {
  constexpr int kTrials = 20;
  std::mt19937_64 random(kSeed);
  for (std::size_t d = 0; d < kDistances.size(); ++d)
    for (int i = 0; i < kTrials; ++i) {
      const Placed placed = draw_thing(parameters, kDistances[d], stated("no return", d).width, 0.0, uniform(random, stated("samples of a line", d).height, 3.0), random);
      placed.sweep->scene.thing[0].returns = false;
      for (int pass = 0; pass < 4; ++pass) placed.pass(uniform(random, 0.5, 1.0) * rates.app, random);
      const Spot axis = placed.sweep->at(placed.scanner, placed.pan, kDistances[d]);
      const CellRange cell = cells_of({axis});
      ASSERT_EQ(placed.sweep->map().seen_us[cell.y_low][cell.x_low], -1) << kDistances[d] << " m, seed " << kSeed << ", thing " << i;
    }
}

// Broader than a person, and no cell of it is ever missed: each is seen anew beside it.
// verifies: SK-FI-7
TEST_F(Unseen, WhatReturnsNothingAndIsHalfAMetreWideStandsOnFreshGround) {
  for (std::size_t d = 0; d < kDistances.size(); ++d) {
    const double width = 0.54;
    EXPECT_GE(width, 0.6 * stated("no return", d).width);
    // The head looks along the grid's x; the thing's middle lies on a border between two cells, and its depth within a cell.
    Sweep sweep(parameters, degrees(-120));
    const double pan = degrees(120), bearing_y = sweep.head(0).y;
    const double border = std::round(bearing_y / kCell) * kCell, x = std::floor((sweep.head(0).x + kDistances[d]) / kCell) * kCell;
    sweep.scene.thing = {box({x + 0.5 * kCell, border}, 0.0, 0.1, width, 0.0, 1.8)};
    sweep.scene.thing[0].returns = false;
    std::mt19937_64 random(kSeed);
    const std::int64_t begin = sweep.now_us();
    while (sweep.now_us() < begin + parameters.fresh_us) sweep.pan(0, pan - degrees(9), pan + degrees(9), rates.app, uniform(random, 0, kSamplesPerTurn));
    EXPECT_TRUE(all_low(sweep.map(), sweep.scene.thing[0].footprint, sweep.now_us() - parameters.fresh_us, kGroundMm)) << kDistances[d] << " m";
  }
}

// The most that may be missing before the scanner counts as silent.
// verifies: SK-FI-10
TEST_F(Unseen, LostPacketsHideUpToTheStatedWidth) {
  constexpr int kTrials = 40;
  std::mt19937_64 random(kSeed + 1);
  const double rate = rates.full_swing;
  for (std::size_t d = 0; d < kDistances.size(); ++d) {
    for (int i = 0; i < kTrials; ++i) {
      const double row = stated("samples of a line", d).height, height = uniform(random, row, 3.0);
      const Placed placed = draw_thing(parameters, kDistances[d], stated("packets refused or lost", d).width, 0.0, height, random);
      const std::int64_t begin = placed.sweep->now_us(), at = begin + static_cast<std::int64_t>(uniform(random, 0, 2 * placed.half_angle / rate) * 1e6);
      placed.sweep->lost_from_us = at;
      placed.sweep->lost_to_us = at + parameters.scanner_silent_us;
      placed.pass(rate, random);
      ASSERT_GE(highest_top(placed.sweep->map(), placed.thing().footprint), (height - row) * 1e3 - kGroundMm) << kDistances[d] << " m, seed " << kSeed + 1 << ", thing " << i;
    }
    // And one that is hidden, midway in the gap, on ground seen before.
    const double width = 0.9 * silent_gap(parameters, kDistances[d], rate), gap = rate * (parameters.scanner_silent_us * 1e-6 + kPacketTime + kLinePeriod);
    Sweep sweep(parameters, kSwing);
    sweep.pan(0, degrees(35), degrees(85), degrees(20), 0.0);
    double hidden = 0.0;
    for (double phase = 0.0; phase < kSamplesPerTurn && hidden == 0.0; phase += 40.0) {
      const double begin_s = static_cast<double>(sweep.now_us()) * 1e-6;
      const double middle = degrees(60), at_s = begin_s + (middle - degrees(45)) / rate;
      const Prism thing = cylinder_around(sweep.at(0, middle, kDistances[d]), 0.98 * width, 1.0);
      sweep.scene.thing = {thing};
      sweep.lost_from_us = static_cast<std::int64_t>((at_s - 0.5 * gap / rate + 0.5 * kLinePeriod) * 1e6);
      sweep.lost_to_us = sweep.lost_from_us + parameters.scanner_silent_us;
      sweep.pan(0, degrees(45), degrees(75), rate, phase);
      if (highest_top(sweep.map(), thing.footprint) <= kGroundMm) hidden = width;
      if (hidden == 0.0) {  // forget it
        sweep.scene.thing.clear();
        for (int k = 0; k < 3; ++k) sweep.wait(1.1), sweep.pan(0, degrees(35), degrees(85), degrees(20), 13.0 * k);
      }
    }
    EXPECT_GT(hidden, 0.0) << kDistances[d] << " m";
  }
}

}  // namespace
}  // namespace berm::kernel::test
