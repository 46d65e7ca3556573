// The points lie where the plant's beams met the ground: also on a base that stands inclined, whose frame they are in.
#include <gtest/gtest.h>

#include <cmath>

#include "perception/scan_intake.hpp"
#include "rig.hpp"

namespace berm::test {
namespace {

using namespace berm::app;

TEST(ScanlineAgainstGround, TheBenchIsLevelInTheWorldHoweverTheBaseStands) {
  constexpr double degree = 0.017453292519943295;
  const plant::BasePose level{}, moved{0.3, -0.2, 0.1, 0.4 * degree, 0.0}, inclined{0.0, 0.0, 0.0, 3.0 * degree, -4.0 * degree};
  for (const plant::BasePose& base : {level, moved, inclined}) {
    ScanRig rig("short", 2, drawn_motion(2, zx200_file()), base);
    ScanlineProcessor processor(rig.machine());
    MachineHistory history;
    const plant::BaseFrame stand(base);
    double sum = 0.0, squares = 0.0, in_base = 0.0;
    std::size_t n = 0;
    while (rig.time_s() < 1.5) {
      rig.advance();
      history.take(rig.segment());
      for (int b = 0; b < rig.blocks().count; ++b)
        for (const ScanlinePart& part : processor.take(rig.blocks().block[b], history))
          for (const ScanReturn& s : part.samples()) {
            if (!s.usable() || s.flagged() || s.range > 12.0) continue;
            const plant::Vec3 world = stand.out(plant::Vec3{s.x, s.y, s.z});
            const double z = world.z;
            if (world.x > 5.0 || world.y > 3.0) continue;  // the bench's faces begin beyond
            sum += z;
            squares += z * z;
            in_base += std::fabs(s.z);
            ++n;
          }
    }
    ASSERT_GT(n, 1000u);
    const double count = static_cast<double>(n);
    EXPECT_NEAR(sum / count, 0.0, 0.02) << "the roughness";
    EXPECT_LT(std::sqrt(squares / count), 0.05) << "of the range's noise";
    if (base.roll > degree) {
      EXPECT_GT(in_base / count, 0.1) << "in the machine's own frame the ground is inclined";
    }
  }
}

}  // namespace
}  // namespace berm::test
