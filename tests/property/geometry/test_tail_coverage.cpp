// The slices cover what the upper body's tail sweeps, grown by its clearance.
#include <gtest/gtest.h>

#include <iostream>
#include <memory>
#include <vector>

#include "exact_hull.hpp"
#include "geometry/swept_slices.hpp"
#include "machine_profile.hpp"
#include "reach_boxes.hpp"
#include "tail_sampler.hpp"

namespace berm::kernel::test {
namespace {

constexpr uint64_t seed = 20261122;
constexpr int samples_per_box = 4000;

std::vector<ExactHull> tail_hulls(const berm_parameters& parameters, const sk_reach_box& box, SliceSet& set) {
  std::vector<ExactHull> hulls;
  EXPECT_TRUE(build_slices(parameters, box, set));
  for (int i = 0; i < set.count; ++i)
    if (set.slice[i].link == 0) hulls.emplace_back(set.slice[i]);
  EXPECT_EQ(static_cast<int>(hulls.size()), set.intervals);
  return hulls;
}

long outside(const berm_parameters& parameters, const sk_reach_box& box, const std::vector<ExactHull>& hulls, int samples, std::mt19937_64& random) {
  long missed = 0;
  for (int i = 0; i < samples; ++i) {
    const auto p = berm::test::draw_tail_point(parameters, box, random);
    bool inside = false;
    for (const ExactHull& hull : hulls) inside = inside || hull.contains(p.x, p.y, p.z);
    missed += inside ? 0 : 1;
  }
  return missed;
}

// The machines' own tail, and tails of any size that the parameter check lets pass.
berm_parameters tail_of(berm_parameters p, bool drawn, std::mt19937_64& random) {
  p.tail_watched = 1;
  if (!drawn) return p;
  const auto length = [&](double low, double high) { return static_cast<int32_t>(uniform(random, low, high)); };
  p.own_body_radius_mm = length(500, 6000);
  p.tail_radius_mm = length(500, p.own_body_radius_mm);
  p.tail_half_width_mm = random() % 4 == 0 ? p.tail_radius_mm : length(100, p.tail_radius_mm);
  p.tail_clearance_mm = length(500, 3000);
  p.tail_low_mm = length(0, 2000);
  p.tail_high_mm = p.tail_low_mm + length(1, 3000);
  return p;
}

} // namespace

// verifies: SK-TS-2
TEST(TailSlices, CoverTheGrownTailAtEverySwingOfTheBox) {
  const long wanted = sample_count(2000000);
  std::mt19937_64 random(seed);
  const auto set = std::make_unique<SliceSet>();
  for (const CompiledMachine& machine : compiled_machines()) {
    long points = 0, boxes = 0, missed = 0;
    double widest_degrees = 0;
    while (points < wanted && missed == 0) {
      const berm_parameters parameters = tail_of(machine.parameters, boxes % 2 == 1, random);
      const sk_reach_box box = random() % 4 != 0 ? box_at_speed(machine.parameters, uniform(random, 0.0, 1.0), random).box : box_of_any_width(machine.parameters, random);
      const auto hulls = tail_hulls(parameters, box, *set);
      missed += outside(parameters, box, hulls, samples_per_box, random);
      points += samples_per_box;
      ++boxes;
      widest_degrees = std::max(widest_degrees, (box.high_urad[0] - box.low_urad[0]) * 1e-6 * 180.0 / 3.141592653589793);
    }
    std::cout << machine.name << ": seed " << seed << ", " << boxes << " boxes, the widest of " << widest_degrees << " degrees, " << points << " points of the tail, " << missed
              << " outside\n";
    EXPECT_EQ(missed, 0);
  }
}

// The same samples find slices that end two degrees short, or a clearance that is a centimetre too small; or the test above would say nothing.
TEST(TailSlices, SamplesFindSlicesThatAreTooSmall) {
  std::mt19937_64 random(seed + 1);
  const auto set = std::make_unique<SliceSet>();
  const berm_parameters right = tail_of(compiled_machines().front().parameters, false, random);
  long of_short = 0, of_small = 0;
  for (int i = 0; i < 20; ++i) {
    const sk_reach_box box = box_at_speed(right, 1.0, random).box;
    sk_reach_box shorter = box;
    shorter.high_urad[0] = std::max(box.low_urad[0], box.high_urad[0] - 34907);
    of_short += outside(right, box, tail_hulls(right, shorter, *set), samples_per_box, random);
    berm_parameters small = right;
    small.tail_clearance_mm -= 10;
    of_small += outside(right, box, tail_hulls(small, box, *set), samples_per_box, random);
  }
  EXPECT_GT(of_short, 0) << "seed " << seed + 1;
  EXPECT_GT(of_small, 0) << "seed " << seed + 1;
}

// No more is asked for than that needs: a corner reaches at most 3 % beyond the grown tail's radius, and so no farther than 12 cm.
// verifies: SK-TS-2
TEST(TailSlices, ReachLittleBeyondTheGrownTail) {
  std::mt19937_64 random(seed + 2);
  const auto set = std::make_unique<SliceSet>();
  const berm_parameters p = tail_of(compiled_machines().front().parameters, false, random);
  const double radius = p.own_body_radius_mm + p.tail_clearance_mm;
  double farthest = 0;
  for (int i = 0; i < 200; ++i) {
    const sk_reach_box box = box_at_speed(p, 1.0, random).box;
    ASSERT_TRUE(build_slices(p, box, *set));
    for (int k = 0; k < set->count; ++k) {
      const sk_slice& s = set->slice[k];
      if (s.link != 0) continue;
      for (int v = 0; v < s.vertices; ++v) farthest = std::max(farthest, std::hypot(s.xyz_mm[0][v], s.xyz_mm[1][v]));
    }
  }
  std::cout << "farthest corner " << farthest << " mm, grown tail " << radius << " mm\n";
  EXPECT_GE(farthest, radius);
  EXPECT_LE(farthest, 1.03 * radius);
}

} // namespace berm::kernel::test
