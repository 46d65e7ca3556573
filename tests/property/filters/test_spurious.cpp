// What the filter of spurious returns hides: what a scanline meets with one sample alone and nothing around it supports.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "draw.hpp"
#include "mini_machine.hpp"

namespace berm::kernel::test {
namespace {

constexpr std::uint64_t kSeed = 90812;
constexpr double kRow = 2 * 3.14159265358979323846 / kSamplesPerTurn;

class SpuriousHides : public ::testing::Test {
 protected:
  berm_parameters parameters = berm::test::demo_parameters();
  PanRates rates = pan_rates(parameters);
};

// In the air, where the ground before it supports nothing.
// verifies: SK-FI-3
TEST_F(SpuriousHides, NothingOfTheStatedHeight) {
  constexpr int kTrials = 120;
  std::mt19937_64 random(kSeed);
  int things = 0;
  for (std::size_t d = 0; d < kDistances.size(); ++d)
    for (int i = 0; i < kTrials; ++i) {
      const double beam = i % 2 == 0 ? 0.0 : kBeamWidth, echo = beam > 0.0 ? stated("last echo", d).width : 0.0;
      const double thick = stated("spurious filter", d).height + echo + (i % 3 == 0 ? 0.0 : uniform(random, 0.0, 0.5));
      const double under = uniform(random, 0.3, 2.0), row = stated("samples of a line", d).height;
      const Placed placed = draw_thing(parameters, kDistances[d], stated("lines of a sweep: app", d).width + echo, under, under + thick, random);
      placed.sweep->beam_rad = beam;
      placed.pass(rates.app, random);
      ++things;
      ASSERT_GE(highest_top(placed.sweep->map(), placed.thing().footprint), (under + thick - row - echo - kRounding) * 1e3)
          << kDistances[d] << " m, from " << under << " to " << under + thick << ", seed " << kSeed << ", thing " << things;
    }
  std::cout << "seed " << kSeed << ": " << things << " things in the air found\n";
}

// A rail across the view, a foot above the ground: no sweep ever finds it.
// verifies: SK-FI-3
TEST_F(SpuriousHides, ARailOfNearlyTheStatedHeight) {
  for (const double distance : kDistances) {
    const double head = parameters.scanner[0].z_mm * 1e-3, depression = std::round(std::atan2(head - 0.4, distance) / kRow) * kRow;
    const auto height_at = [&](double rows) { return head - distance * std::tan(depression - rows * kRow); };
    Sweep sweep(parameters, kSwing);
    const double pan = degrees(60);
    sweep.scene.thing = {box(sweep.at(0, pan, distance), sweep.bearing(pan), 0.01, 0.3, height_at(-0.93), height_at(0.93))};
    EXPECT_GE(sweep.scene.thing[0].z_high - sweep.scene.thing[0].z_low, 0.85 * row_height(parameters, distance, 2));
    for (int pass = 0; pass < 4; ++pass) sweep.pan(0, degrees(52), degrees(68), rates.app, 90.0 * pass);
    EXPECT_TRUE(all_low(sweep.map(), sweep.scene.thing[0].footprint, 1, kGroundMm)) << distance << " m";
    // Half a row thicker at either side, it is found.
    sweep.scene.thing[0].z_low = height_at(-1.5);
    sweep.scene.thing[0].z_high = height_at(1.5);
    sweep.pan(0, degrees(52), degrees(68), rates.app, 17.0);
    EXPECT_GE(highest_top(sweep.map(), sweep.scene.thing[0].footprint), height_at(0.0) * 1e3 - kGroundMm) << distance << " m";
  }
}

// Each row so much behind the one below it that neither supports the other, and farther ground before and behind: two are hidden, of three the last is found.
// verifies: SK-FI-3
TEST_F(SpuriousHides, TheFirstTwoRowsOfWhatRecedes) {
  constexpr double kBehind = 0.6;
  for (const double distance : kDistances)
    for (const int rows : {2, 3}) {
      const double head = parameters.scanner[0].z_mm * 1e-3, lowest = std::floor(std::atan2(head - 0.6, distance) / kRow) * kRow, pan = degrees(60);
      Sweep sweep(parameters, kSwing);
      for (int row = 0; row < rows; ++row) {
        const double at = distance + kBehind * row;
        const auto height_at = [&](double of_row) { return head - at * std::tan(lowest - (row + of_row) * kRow); };
        sweep.scene.thing.push_back(box(sweep.at(0, pan, at), sweep.bearing(pan), 0.01, 0.3, height_at(-0.45), height_at(0.45)));
      }
      for (int pass = 0; pass < 4; ++pass) sweep.pan(0, degrees(52), degrees(68), rates.app, 90.0 * pass);
      for (int row = 0; row < 2; ++row)
        EXPECT_TRUE(all_low(sweep.map(), sweep.scene.thing[static_cast<std::size_t>(row)].footprint, 1, kGroundMm)) << distance << " m, row " << row << " of " << rows;
      if (rows == 3) {
        EXPECT_GE(highest_top(sweep.map(), sweep.scene.thing[2].footprint), sweep.scene.thing[2].z_low * 1e3) << distance << " m";
      }
    }
}

// Rails above one another count one by one, so a fence of them has no size that is found.
// verifies: SK-FI-3
TEST_F(SpuriousHides, AFenceOfRailsAsHighAsAPerson) {
  for (const double distance : kDistances) {
    const double head = parameters.scanner[0].z_mm * 1e-3, lowest = std::floor(std::atan2(head - 0.5, distance) / kRow) * kRow;
    Sweep sweep(parameters, kSwing);
    const double pan = degrees(60);
    double top = 0.0;
    for (int rail = 0; top < 1.5; ++rail) {
      const auto height_at = [&](double rows) { return head - distance * std::tan(lowest - (2 * rail + rows) * kRow); };
      top = height_at(0.45);
      sweep.scene.thing.push_back(box(sweep.at(0, pan, distance), sweep.bearing(pan), 0.01, 0.3, height_at(-0.45), top));
    }
    for (int pass = 0; pass < 4; ++pass) sweep.pan(0, degrees(52), degrees(68), rates.app, 90.0 * pass);
    EXPECT_TRUE(all_low(sweep.map(), sweep.scene.thing[0].footprint, 1, kGroundMm)) << distance << " m, " << sweep.scene.thing.size() << " rails";
  }
}

}  // namespace
}  // namespace berm::kernel::test
