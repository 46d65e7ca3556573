#include "geometry/part_sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "geometry/reach.hpp"
#include "machine_profile.hpp"

namespace berm::kernel::test {
namespace {

constexpr double pi = 3.141592653589793;
constexpr uint64_t seed = 5;

double best_of_samples(double radius, double low, double high, double psi) {
  double best = -1e300;
  for (int i = 0; i <= 2000; ++i) best = std::max(best, radius * std::cos(low + (high - low) * i / 2000 - psi));
  return best;
}

} // namespace

// verifies: SK-GE-3
TEST(Arc, SupportIsTheMaximumOverTheArc) {
  std::mt19937_64 random(seed);
  for (int i = 0; i < 3000; ++i) {
    const double radius = uniform(random, 0, 6000), low = uniform(random, -12, 12), width = uniform(random, 0, i % 3 == 0 ? 8.0 : 0.5), psi = uniform(random, -12, 12);
    const double support = Arc(radius, low, low + width).support(direction_of(psi));
    const double sampled = best_of_samples(radius, low, low + width, psi);
    const double step = width / 2000;
    ASSERT_GE(support, sampled - 1e-9) << "seed " << seed << " case " << i;
    ASSERT_LE(support, sampled + radius * step * step + 1e-9) << "seed " << seed << " case " << i; // no more than the samples can have missed
  }
}

// verifies: SK-GE-3
TEST(Arc, ReachesItsRadiusExactlyWhereTheDirectionLiesInside) {
  EXPECT_DOUBLE_EQ(Arc(1000, -0.2, 0.1).support(direction_of(0.0)), 1000.0);
  EXPECT_DOUBLE_EQ(Arc(1000, -0.2, 0.1).support(direction_of(2 * pi)), 1000.0);
  EXPECT_DOUBLE_EQ(Arc(1000, 0.0, 7.0).support(direction_of(2.5)), 1000.0); // more than a turn
  EXPECT_NEAR(Arc(1000, 0.1, 0.2).support(direction_of(0.0)), 1000 * std::cos(0.1), 1e-9);
  EXPECT_NEAR(Arc(1000, 0.1, 0.1).support(direction_of(pi)), -1000 * std::cos(0.1), 1e-9);
}

// With single angles the sweep is the part itself: the support must be attained by one of its corners, in every direction.
// verifies: SK-GE-3
TEST(PartSweep, IsExactForAStandingPart) {
  std::mt19937_64 random(seed + 1);
  const Machine first = machine_profiles().front();
  for (int i = 0; i < 300; ++i) {
    const Machine machine = i % 2 == 0 ? first : random_machine(random);
    const berm_parameters& p = machine.parameters;
    sk_reach_box box = random_box(p, random);
    for (int j = 0; j < 4; ++j) box.high_urad[j] = box.low_urad[j];
    const int part = static_cast<int>(random() % static_cast<uint64_t>(p.parts));
    PartSweep sweep;
    ASSERT_TRUE(sweep.set(p, box, part));
    const double psi = uniform(random, -pi, pi);
    double r = p.boom_pin_x_mm, z = p.boom_pin_z_mm, a = 0.0, best = -1e300;
    const double lengths[2] = {static_cast<double>(p.boom_length_mm), static_cast<double>(p.stick_length_mm)};
    for (int link = 1; link <= p.part[part].link; ++link) {
      a += box.low_urad[link] * 1e-6;
      if (link == p.part[part].link) break;
      r += lengths[link - 1] * std::cos(a);
      z += lengths[link - 1] * std::sin(a);
    }
    for (int v = 0; v < p.part[part].vertices; ++v) {
      const double x = p.part[part].vertex_mm[v][0], up = p.part[part].vertex_mm[v][1];
      best = std::max(best, (r + x * std::cos(a) - up * std::sin(a)) * std::cos(psi) + (z + x * std::sin(a) + up * std::cos(a)) * std::sin(psi));
    }
    ASSERT_NEAR(sweep.support(direction_of(psi)), best, 1e-6) << "seed " << seed + 1 << " case " << i;
  }
}

// verifies: SK-GE-6
TEST(PartSweep, RefusesWhatIsMalformed) {
  const berm_parameters good = machine_profiles().front().parameters;
  sk_reach_box box{};
  PartSweep sweep;
  ASSERT_TRUE(sweep.set(good, box, 0));
  EXPECT_FALSE(sweep.set(good, box, -1));
  EXPECT_FALSE(sweep.set(good, box, BERM_PARTS));
  for (int link : {0, 4, -1}) {
    berm_parameters bad = good;
    bad.part[0].link = link;
    EXPECT_FALSE(sweep.set(bad, box, 0));
  }
  for (int vertices : {0, BERM_PART_VERTICES + 1, -3}) {
    berm_parameters bad = good;
    bad.part[0].vertices = vertices;
    EXPECT_FALSE(sweep.set(bad, box, 0));
  }
  berm_parameters narrow = good;
  narrow.part[0].half_width_mm = -1;
  EXPECT_FALSE(sweep.set(narrow, box, 0));
  box.low_urad[1] = 1;
  EXPECT_FALSE(sweep.set(good, box, 0));
  box.low_urad[1] = 0;
  box.high_urad[1] = INT32_MAX;
  EXPECT_FALSE(sweep.set(good, box, 0));
  box.high_urad[1] = 0;
  box.low_urad[1] = INT32_MIN;
  EXPECT_FALSE(sweep.set(good, box, 0));
}

// verifies: SK-GE-8
TEST(MaxReach, IsTheFarthestCornerOfAStraightMachine) {
  for (const Machine& machine : machine_profiles()) {
    const berm_parameters& p = machine.parameters;
    sk_reach_box box{}; // all links level and straight
    double farthest = 0.0;
    for (int i = 0; i < p.parts; ++i)
      for (int v = 0; v < p.part[i].vertices; ++v) {
        const int before = (p.part[i].link >= 2 ? p.boom_length_mm : 0) + (p.part[i].link >= 3 ? p.stick_length_mm : 0);
        farthest = std::max(farthest, std::hypot(p.boom_pin_x_mm + before + p.part[i].vertex_mm[v][0], p.part[i].half_width_mm));
      }
    EXPECT_GE(max_reach_mm(p, box), farthest);
    EXPECT_LE(max_reach_mm(p, box), farthest + 2.0);
    box.low_urad[0] = 5; // the swing interval is not read
    box.high_urad[0] = -5;
    EXPECT_GE(max_reach_mm(p, box), farthest);
    box.low_urad[1] = 1;
    EXPECT_EQ(max_reach_mm(p, box), -1);
  }
}

// verifies: SK-GE-6
TEST(MaxReach, RefusesAMachineWithoutPartsOrBeyondTheGrid) {
  berm_parameters p = machine_profiles().front().parameters;
  const sk_reach_box box{};
  p.parts = 0;
  EXPECT_EQ(max_reach_mm(p, box), -1);
  p.parts = BERM_PARTS + 1;
  EXPECT_EQ(max_reach_mm(p, box), -1);
  p.parts = 1;
  p.part[0].vertex_mm[0][0] = 2 * SK_COORD_MAX_MM;
  EXPECT_EQ(max_reach_mm(p, box), -1);
}

} // namespace berm::kernel::test
