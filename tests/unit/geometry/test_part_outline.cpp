#include "geometry/part_outline.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/part_sweep.hpp"
#include "geometry/turns.hpp"
#include "machine_profile.hpp"

namespace berm::kernel::test {
namespace {

constexpr uint64_t seed = 55;

} // namespace

// verifies: SK-GE-29
TEST(Turns, AreCosineAndSine) {
  std::mt19937_64 random(seed);
  for (int i = 0; i < 100000; ++i) {
    alignas(32) double angle[8];
    float c[8], s[8];
    for (double& a : angle) a = i % 10 == 0 ? std::floor(uniform(random, -80, 80)) * 0.78539816339744831 : uniform(random, -70, 70);
    turns(angle, 8, c, s);
    for (int k = 0; k < 8; ++k) {
      ASSERT_NEAR(c[k], std::cos(angle[k]), 2e-7) << "seed " << seed << " angle " << angle[k];
      ASSERT_NEAR(s[k], std::sin(angle[k]), 2e-7) << "seed " << seed << " angle " << angle[k];
    }
  }
}

// Held against the exact support function, in double, over random machines and boxes, wide ones too.
// verifies: SK-GE-29
TEST(PartOutline, CoversTheExactSupportAndNotMuchMore) {
  constexpr double slack_mm = 3.0, rounding_mm = 0.05;
  std::mt19937_64 random(seed + 1);
  int asked = 0;
  for (int n = 0; n < 2000; ++n) {
    const Machine machine = n % 2 == 0 ? machine_profiles().front() : random_machine(random);
    const berm_parameters& p = machine.parameters;
    sk_reach_box box = random_box(p, random);
    if (n % 5 == 0)
      for (int j = 1; j < 4; ++j) box.high_urad[j] = box.low_urad[j] + static_cast<int32_t>(uniform(random, 0, 4e6)); // up to half a turn and more
    const double half = uniform(random, 0, 0.0786);
    const ImplementShape shape(p);
    BoxSweep sweep;
    ASSERT_TRUE(sweep.set(box, half));
    for (int part = 0; part < p.parts; ++part) {
      PartSweep exact;
      ASSERT_TRUE(exact.set(p, box, part));
      PartOutline outline;
      if (!sweep.outline(shape, part, outline)) continue;
      ++asked;
      const double grow = shape.part[part].reach_mm * (1.0 - std::cos(half)) + p.part[part].half_width_mm * std::sin(half);
      for (int i = 0; i < sweep_directions; ++i) {
        const double psi = std::atan2(outline.normal_z[i], outline.normal_r[i]);
        const double support = exact.support(direction_of(psi)), growth = grow * std::fabs(std::cos(psi));
        ASSERT_GE(outline.offset_mm[i], support + growth + slack_mm - rounding_mm) << "seed " << seed + 1 << " case " << n << " part " << part << " edge " << i;
        ASSERT_LE(outline.offset_mm[i], support + growth + slack_mm + rounding_mm) << "seed " << seed + 1 << " case " << n << " part " << part << " edge " << i;
      }
      // what the growth must be at least: the deepest and the farthest point of the part, as the derivation has them
      ASSERT_GE(shape.part[part].reach_mm + rounding_mm, std::max(exact.support(direction_of(0.0)), exact.support(direction_of(3.141592653589793))));
    }
  }
  EXPECT_GT(asked, 5000);
}

// verifies: SK-GE-6
TEST(ImplementShape, HasNoPartsWhereTheirNumberIsMalformed) {
  berm_parameters p = machine_profiles().front().parameters;
  for (const int32_t parts : {0, -1, BERM_PARTS + 1}) {
    p.parts = parts;
    EXPECT_EQ(ImplementShape(p).parts, 0);
  }
}

} // namespace berm::kernel::test
