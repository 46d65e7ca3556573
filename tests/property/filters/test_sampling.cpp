// The floor that all filters stand on: a scanner's samples lie apart.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "draw.hpp"
#include "mini_machine.hpp"

namespace berm::kernel::test {
namespace {

constexpr std::uint64_t kSeed = 90811;

class Sampling : public ::testing::Test {
 protected:
  berm_parameters parameters = berm::test::demo_parameters();
  PanRates rates = pan_rates(parameters);
  struct Case {
    const char* row;
    double rate;
  };
  std::vector<Case> cases = {{"lines of a sweep: app", rates.app},
                             {"lines of a sweep: validation", rates.commander},
                             {"lines of a sweep: full swing", rates.full_swing},
                             {"lines of a sweep: fastest", rates.limit}};

  // Every cell in which the thing is seen wider than the lines lie apart is as high as the thing, less a row.
  int check_cells(const Placed& placed, double rate, double beam) const {
    const Prism& thing = placed.thing();
    const Spot head = placed.sweep->head(placed.scanner);
    const CellRange range = cells_of(thing.footprint);
    int checked = 0;
    for (int iy = range.y_low; iy <= range.y_high; ++iy)
      for (int ix = range.x_low; ix <= range.x_high; ++ix) {
        const Spot low = cell_low(ix, iy);
        constexpr double kSkin = 0.003;
        const std::vector<Spot> part = clipped(thing.footprint, {low.x + kSkin, low.y + kSkin}, {low.x + kCell - kSkin, low.y + kCell - kSkin});
        if (seen_under(part, head) < 1.03 * rate * kLinePeriod + 1.5 * beam) continue;
        double farthest = 0.0;
        for (const Spot& corner : part) farthest = std::max(farthest, std::hypot(corner.x - head.x, corner.y - head.y));
        const double left = row_height(parameters, farthest, 1) + beam * farthest * 1.5 + kRounding;
        ++checked;
        EXPECT_GE(placed.sweep->map().seen_us[iy][ix], 0);
        EXPECT_GE(sk_map_top(&placed.sweep->map(), iy, ix), (thing.z_high - left) * 1e3) << "cell " << ix << ' ' << iy << ", farthest " << farthest;
      }
    return checked;
  }
};

// verifies: SK-FI-1, SK-FI-2, SK-FI-8
TEST_F(Sampling, AThingOfTheStatedSizeIsFoundInOneSweep) {
  constexpr int kTrials = 50;
  std::mt19937_64 random(kSeed);
  int things = 0, cells = 0;
  for (std::size_t d = 0; d < kDistances.size(); ++d)
    for (const Case& c : cases)
      for (int i = 0; i < kTrials; ++i) {
        const double beam = i % 2 == 0 ? 0.0 : kBeamWidth;
        const double echo = beam > 0.0 ? stated("last echo", d).width : 0.0, row = stated("samples of a line", d).height;
        const double height = i % 3 == 0 ? row + echo : uniform(random, row + echo, 3.0);
        const Placed placed = draw_thing(parameters, kDistances[d], stated(c.row, d).width + echo, 0.0, height, random);
        placed.sweep->beam_rad = beam;
        placed.pass(c.rate, random);
        ++things;
        EXPECT_GE(highest_top(placed.sweep->map(), placed.thing().footprint), (height - row - echo - kRounding) * 1e3)
            << c.row << ", " << kDistances[d] << " m, height " << height << ", beam " << beam;
        // Where two more rows still meet the ground, the cells behind the front are bridged to.
        if (height <= parameters.scanner[0].z_mm * 1e-3 - 0.1 * (kDistances[d] + 2.0)) cells += check_cells(placed, c.rate, beam);
        if (HasFailure()) FAIL() << "seed " << kSeed << ", thing " << things;
      }
  std::cout << "seed " << kSeed << ": " << things << " things found, " << cells << " of their cells as high as they\n";
  EXPECT_GT(cells, 500);
}

// A post as high as a person, midway between two lines.
// verifies: SK-FI-1
TEST_F(Sampling, APostBetweenTwoLinesIsHidden) {
  constexpr double kHeight = 1.8;
  for (std::size_t d = 0; d < kDistances.size(); ++d)
    for (const Case& c : cases) {
      const double head = parameters.scanner[0].z_mm * 1e-3, foot = std::atan2(head, kDistances[d]), top = std::atan2(head - kHeight, kDistances[d]);
      const double row = 2 * 3.14159265358979323846 / kSamplesPerTurn;
      const double lean = (foot - top) / row / kSamplesPerTurn;  // of a line over the post, in line distances
      const double width = 0.97 * (1.0 - lean) * line_gap(kDistances[d], c.rate);
      EXPECT_GE(width, 0.9 * line_gap(kDistances[d], c.rate));
      Sweep sweep(parameters, kSwing);
      sweep.pan(0, degrees(45), degrees(75), degrees(20), 0.0);  // before it came
      const std::int64_t before = sweep.now_us();
      const double index = kSamplesPerTurn - 0.5 * (foot + top) / row;  // of the sample halfway up
      const double pan = degrees(50) + c.rate * kSamplePeriod * (kSamplesPerTurn * 1.5 + index);
      const Spot place = sweep.at(0, pan, kDistances[d]);
      sweep.scene.thing = {cylinder_around(place, width * 0.99, kHeight)};
      sweep.pan(0, degrees(50), degrees(50) + c.rate * kLinePeriod * 5, c.rate, 0.0);
      EXPECT_TRUE(all_low(sweep.map(), sweep.scene.thing[0].footprint, sweep.now_us() - parameters.fresh_us, kGroundMm)) << c.row << ", " << kDistances[d] << " m";
      if (width < 0.2) {  // then its cell was seen anew, beside it
        const CellRange cell = cells_of({place});
        EXPECT_GT(sweep.map().seen_us[cell.y_low][cell.x_low], before) << c.row << ", " << kDistances[d] << " m";
      }
    }
}

// verifies: SK-FI-2
TEST_F(Sampling, AKerbBetweenTwoRowsIsHidden) {
  const double head = parameters.scanner[0].z_mm * 1e-3, row = 2 * 3.14159265358979323846 / kSamplesPerTurn;
  for (const double distance : kDistances) {
    const double depression = std::round(std::atan2(head, distance) / row) * row;
    const double foot = head / std::tan(depression) + 0.003;  // just behind a sample on the ground
    const double height = 0.93 * row_height(parameters, foot, 1);
    EXPECT_GE(height, 0.85 * row_height(parameters, distance, 1));
    Sweep sweep(parameters, kSwing);
    const double pan = degrees(60);
    sweep.scene.thing = {box(sweep.at(0, pan, foot), sweep.bearing(pan), 0.004, 0.2, 0.0, height)};
    for (int pass = 0; pass < 3; ++pass) sweep.pan(0, degrees(54), degrees(66), rates.app, 130.0 * pass);
    EXPECT_TRUE(all_low(sweep.map(), sweep.scene.thing[0].footprint, 1, kGroundMm)) << distance << " m";
  }
}

}  // namespace
}  // namespace berm::kernel::test
