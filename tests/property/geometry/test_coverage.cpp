// The claim on which the safety argument rests: the slices cover the swept volume.
#include <gtest/gtest.h>

#include <memory>

#include "exact_hull.hpp"
#include "geometry/reach.hpp"
#include "geometry/swept_slices.hpp"
#include "implement_sampler.hpp"

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
