// The claim on which the safety argument rests: the slices cover the swept volume.
#include <gtest/gtest.h>

#include <memory>

#include "exact_hull.hpp"
#include "geometry/reach.hpp"
#include "geometry/swept_slices.hpp"
#include "implement_sampler.hpp"
#include "reach_boxes.hpp"

namespace berm::kernel::test {
namespace {

constexpr uint64_t seed = 20240611;
constexpr long samples_per_box = 4000;

struct Tally {
  long points = 0, boxes = 0, missed = 0, refused = 0;
};

// Tries the slice where the point's swing angle lies first, then all of the set: coverage is by the union.
bool covered(const std::vector<ExactHull>& hulls, size_t guess, const ImplementPoint& p) {
  if (hulls[guess].contains(p.x, p.y, p.z)) return true;
  for (const ExactHull& hull : hulls)
    if (hull.contains(p.x, p.y, p.z)) return true;
  return false;
}

void check_box(const berm_parameters& parameters, const sk_reach_box& box, SliceSet& set, std::mt19937_64& random, Tally& tally) {
  if (!build_slices(parameters, box, set)) {
    ++tally.refused;
    return;
  }
  ++tally.boxes;
  std::vector<ExactHull> hulls;
  for (int i = 0; i < set.count; ++i) {
    hulls.emplace_back(set.slice[i]);
    ASSERT_TRUE(hulls.back().solid());
  }
  const ImplementSampler sampler(parameters, box);
  const size_t per_part = hulls.size() / static_cast<size_t>(parameters.parts);
  const double span = (box.high_urad[0] - box.low_urad[0]) * 1e-6;
  for (long i = 0; i < samples_per_box; ++i) {
    const ImplementPoint p = sampler.draw(random);
    const double fraction = span > 0.0 ? (p.angle[0] - box.low_urad[0] * 1e-6) / span : 0.0;
    const size_t guess = static_cast<size_t>(p.part) * per_part + std::min(per_part - 1, static_cast<size_t>(fraction * static_cast<double>(per_part)));
    ++tally.points;
    ASSERT_LE(std::hypot(p.x, p.y), set.max_reach_mm);
    if (covered(hulls, guess, p)) continue;
    ++tally.missed;
    if (tally.missed <= 5)
      ADD_FAILURE() << "part " << p.part << " point (" << p.x << ", " << p.y << ", " << p.z << ") at angles " << p.angle[0] << ", " << p.angle[1] << ", "
                    << p.angle[2] << ", " << p.angle[3] << " lies outside every slice";
  }
}

} // namespace

// verifies: SK-GE-4
// verifies: SK-GE-8
TEST(SweptSlices, CoverTheSweepOfEveryMachineProfile) {
  const long wanted = sample_count(2000000);
  std::mt19937_64 random(seed);
  const auto set = std::make_unique<SliceSet>();
  const auto machines = machine_profiles();
  ASSERT_FALSE(machines.empty());
  for (const Machine& machine : machines) {
    Tally tally;
    while (tally.points < wanted && !HasFatalFailure() && tally.missed == 0) check_box(machine.parameters, random_box(machine.parameters, random), *set, random, tally);
    std::cout << machine.name << ": seed " << seed << ", " << tally.boxes << " reach boxes, " << tally.points << " points, " << tally.missed << " outside\n";
    EXPECT_EQ(tally.missed, 0);
    EXPECT_EQ(tally.refused, 0);
  }
}

// Every position of the joints, every speed and command, and every width up to the joints' whole ranges; the payload's heap is part of the bucket's outline. A short
// run by default; the whole is BERM_SAMPLES=100000000 ./berm test -R SlicesSoundness
// verifies: SK-GE-4
// verifies: SK-GE-8
TEST(SlicesSoundness, NoPointOfTheImplementsLiesOutsideAtAnySpeedAndWidth) {
  const auto machines = compiled_machines();
  ASSERT_FALSE(machines.empty());
  const long wanted = sample_count(5000000) / static_cast<long>(machines.size());
  std::mt19937_64 random(seed + 3);
  const auto set = std::make_unique<SliceSet>();
  for (const CompiledMachine& machine : machines) {
    Tally at_speed, any_width;
    double widest_degrees[4] = {};
    while (at_speed.points + any_width.points < wanted && !HasFatalFailure() && at_speed.missed + any_width.missed == 0) {
      const bool moving = random() % 4 != 0;
      const sk_reach_box box = moving ? box_at_speed(machine.parameters, uniform(random, 0.0, 1.0), random).box : box_of_any_width(machine.parameters, random);
      for (int j = 0; j < 4; ++j) widest_degrees[j] = std::max(widest_degrees[j], (box.high_urad[j] - box.low_urad[j]) * 1e-6 * 180.0 / 3.141592653589793);
      check_box(machine.parameters, box, *set, random, moving ? at_speed : any_width);
    }
    std::cout << machine.name << ": seed " << seed + 3 << ", " << at_speed.points + any_width.points << " points outside " << at_speed.missed + any_width.missed << "; " << at_speed.boxes
              << " boxes of speeds and commands, " << any_width.boxes << " of any width; widest " << widest_degrees[0] << ", " << widest_degrees[1] << ", " << widest_degrees[2] << ", "
              << widest_degrees[3] << " degrees\n";
    EXPECT_EQ(at_speed.missed + any_width.missed, 0);
    EXPECT_EQ(at_speed.refused + any_width.refused, 0);
    EXPECT_GT(at_speed.boxes, 10);
    EXPECT_GT(any_width.boxes, 10);
  }
}

// The same samples, against slices of a box that ends two degrees short: they are found outside, or the tests above would say nothing.
TEST(SlicesSoundness, SamplesFindSlicesThatEndTwoDegreesShort) {
  std::mt19937_64 random(seed + 4);
  const auto set = std::make_unique<SliceSet>();
  for (const CompiledMachine& machine : compiled_machines())
    for (int joint = 0; joint < 4; ++joint) {
      long outside = 0;
      for (int i = 0; i < 80; ++i) {
        const sk_reach_box whole = box_at_speed(machine.parameters, 1.0, random).box;
        sk_reach_box shorter = whole;
        shorter.high_urad[joint] = std::max(whole.low_urad[joint], whole.high_urad[joint] - 34907);
        ASSERT_TRUE(build_slices(machine.parameters, shorter, *set));
        std::vector<ExactHull> hulls;
        for (int k = 0; k < set->count; ++k) hulls.emplace_back(set->slice[k]);
        const ImplementSampler sampler(machine.parameters, whole);
        for (int k = 0; k < 2000; ++k) outside += covered(hulls, 0, sampler.draw(random)) ? 0 : 1;
      }
      EXPECT_GT(outside, 0) << machine.name << ", joint " << joint << ", seed " << seed + 4;
    }
}

// Parts behind the axis, links of no length, wide parts, any angle: where the formulas change their sign.
// verifies: SK-GE-4
// verifies: SK-GE-8
TEST(SweptSlices, CoverTheSweepOfMachinesNoOneWouldBuild) {
  const long wanted = sample_count(2000000) / 4;
  std::mt19937_64 random(seed + 1);
  const auto set = std::make_unique<SliceSet>();
  Tally tally;
  while (tally.points < wanted && !HasFatalFailure() && tally.missed == 0) {
    const Machine machine = random_machine(random);
    check_box(machine.parameters, random_box(machine.parameters, random), *set, random, tally);
  }
  std::cout << "random machines: seed " << seed + 1 << ", " << tally.boxes << " reach boxes, " << tally.points << " points, " << tally.missed << " outside\n";
  EXPECT_EQ(tally.missed, 0);
  EXPECT_EQ(tally.refused, 0);
}

// verifies: SK-GE-4
// verifies: SK-GE-5
TEST(SweptSlices, CoverSwingIntervalsOfAWholeTurnAndMore) {
  std::mt19937_64 random(seed + 2);
  const auto set = std::make_unique<SliceSet>();
  Tally tally;
  const Machine first = machine_profiles().front();
  constexpr int boxes = 60;
  for (int i = 0; i < boxes && tally.missed == 0 && !HasFatalFailure(); ++i) {
    const Machine machine = i % 6 == 0 ? first : random_machine(random);
    sk_reach_box box = random_box(machine.parameters, random);
    box.low_urad[0] = static_cast<int32_t>(uniform(random, -9e6, 0));
    // the widest intervals within a slice, whose two ends no neighbour covers, and whole turns
    box.high_urad[0] = static_cast<int32_t>(box.low_urad[0] + (i % 3 == 0 ? uniform(random, 3e6, 12e6) : uniform(random, 5.4e6, 6.1e6)));
    check_box(machine.parameters, box, *set, random, tally);
  }
  std::cout << "wide swings: seed " << seed + 2 << ", " << tally.points << " points, " << tally.missed << " outside\n";
  EXPECT_EQ(tally.missed, 0);
  EXPECT_EQ(tally.boxes, boxes);
}

} // namespace berm::kernel::test
