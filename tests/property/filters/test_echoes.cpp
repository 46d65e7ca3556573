// The last echo ranges: what lets a part of the beam pass is not seen.
#include <gtest/gtest.h>

#include <cmath>

#include "draw.hpp"
#include "mini_machine.hpp"

namespace berm::kernel::test {
namespace {

class Echoes : public ::testing::Test {
 protected:
  berm_parameters parameters = berm::test::demo_parameters();

  // A scanner that stands and looks at the thing, as well as it can.
  static void look(Sweep& sweep, double pan) {
    sweep.pan(0, pan - degrees(8), pan + degrees(8), degrees(30), 0.0);
    sweep.stare(0, pan, 0.1, 0.0);
  }
};

// verifies: SK-FI-8
TEST_F(Echoes, AWireNarrowerThanTheBeamIsHiddenHoweverItIsLookedAt) {
  for (const double distance : kDistances) {
    const double pan = degrees(60), width = 0.9 * kBeamWidth * distance, height = 1.8;
    EXPECT_GE(width, 0.7 * beam_width(parameters, distance));
    Sweep sweep(parameters, kSwing);
    sweep.scene.thing = {box(sweep.at(0, pan, distance), sweep.bearing(pan), 0.005, width, 0.0, height)};
    sweep.beam_rad = kBeamWidth;
    look(sweep, pan);
    EXPECT_TRUE(all_low(sweep.map(), sweep.scene.thing[0].footprint, 1, kGroundMm)) << distance << " m";
    sweep.beam_rad = 0.0;
    look(sweep, pan);
    EXPECT_GE(highest_top(sweep.map(), sweep.scene.thing[0].footprint), (height - row_height(parameters, distance, 1)) * 1e3)
        << "by a beam without width, to show that the echoes hid it; " << distance << " m";
  }
}

// Mesh, foliage, lattice: no size of the whole is enough while every part lets light pass.
// verifies: SK-FI-8
TEST_F(Echoes, AFenceOfWiresIsHidden) {
  for (const double distance : kDistances) {
    const double pan = degrees(60), pitch = 1.5 * kBeamWidth * distance;
    Sweep sweep(parameters, kSwing);
    const Spot middle = sweep.at(0, pan, distance);
    const double across = sweep.bearing(pan) + degrees(90);
    for (int wire = -5; wire <= 5; ++wire)
      sweep.scene.thing.push_back(box({middle.x + wire * pitch * std::cos(across), middle.y + wire * pitch * std::sin(across)}, sweep.bearing(pan), 0.005,
                                      0.4 * kBeamWidth * distance, 0.0, 1.8));
    sweep.beam_rad = kBeamWidth;
    look(sweep, pan);
    for (const Prism& wire : sweep.scene.thing) EXPECT_TRUE(all_low(sweep.map(), wire.footprint, 1, kGroundMm)) << distance << " m";
  }
}

}  // namespace
}  // namespace berm::kernel::test
