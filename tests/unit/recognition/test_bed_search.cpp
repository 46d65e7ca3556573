// The search for beds: what was refused is not looked at again, so that what stands beside it is.
#include <gtest/gtest.h>

#include <cmath>

#include "drawn_bed.hpp"
#include "recognition/bed_search.hpp"

namespace berm::app {
namespace {

TEST(BedSearch, WhatWasRefusedIsLeftOut) {
  const DrawnBed bed;
  FanSweep sweep = make_fans(sweep_of(bed), drawn_viewpoint);
  const std::vector<UprightRegion> regions = upright_regions(sweep, upright_segments(sweep));
  const TruckRangeSet ranges = read_truck_ranges(BERM_TRUCK_RANGES);
  const std::vector<BedEnds> rough = rough_beds(sweep, regions, ranges);
  const std::vector<BedInterpretation> first = interpret(sweep, rough, ranges, {});
  ASSERT_FALSE(first.empty());
  const BedPose& best = first.front().pose;
  EXPECT_LT((best.middle - Eigen::Vector3d(bed.x, bed.y, bed.top)).norm(), 0.05);
  const std::vector<BedInterpretation> second = interpret(sweep, rough, ranges, {best});
  ASSERT_FALSE(second.empty()) << "nothing else to look at: the test shows nothing";
  // A walk from elsewhere may end beside it, with an end more or less; the same it is not.
  for (const BedInterpretation& i : second)
    EXPECT_TRUE(i.pose.open_end != best.open_end || (i.pose.middle - best.middle).norm() + std::abs(i.pose.length - best.length) > 0.2);
}

}  // namespace
}  // namespace berm::app
