// The search for beds: what was refused is not looked at again, so that what stands beside it is.
#include <gtest/gtest.h>

#include <cmath>

#include "drawn_bed.hpp"
#include "recognition/bed_search.hpp"
#include "recognition/cab_profile.hpp"
#include "recognition/rays_of_sweep.hpp"

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

// A roof before the bed is none of its sides' going on; what stands upright there is.
TEST(BedSearch, ACabsRoofIsNoSideThatGoesOn) {
  DrawnBed bed;
  bed.cab = false;
  FanSweep sweep = make_fans(sweep_of(bed), drawn_viewpoint);
  BedPose pose;
  pose.middle = {bed.x, bed.y, bed.top};
  pose.yaw = bed.yaw, pose.length = bed.length, pose.width = bed.width, pose.thickness = bed.thickness;
  const int before = sides_beyond(sweep, pose, 1);
  // Twenty of the returns lie where the far side would go on before the bed.
  const Eigen::Vector3f there = (pose.middle + pose.rotation() * Eigen::Vector3d(0.5 * bed.length + 0.8, 0.5 * bed.width, -0.3)).cast<float>();
  const auto with = [&](bool upright) {
    FanSweep changed = sweep;
    int moved = 0;
    visit_around(sweep, pose.middle, [&](std::size_t, std::size_t k) {
      if (moved < 20) changed.returns[k].place = there, changed.returns[k].upright = upright, ++moved;
    });
    return sides_beyond(changed, pose, 1);
  };
  EXPECT_EQ(with(false), before);
  EXPECT_EQ(with(true), before + 20);
}

// From before the truck most of its cab's returns are its front's, 2.1 m from the bed.
TEST(BedSearch, ACabIsWeighedToItsFrontWhereItIsAskedFor) {
  DrawnBed bed;
  bed.x = 2.0, bed.yaw = -1.5707963;
  const FanSweep sweep = make_fans(sweep_of(bed), drawn_viewpoint);
  BedInterpretation i;
  i.pose.middle = {bed.x, bed.y, bed.top};
  i.pose.yaw = bed.yaw, i.pose.length = bed.length, i.pose.width = bed.width, i.pose.thickness = bed.thickness;
  weigh_whole(sweep, i);
  EXPECT_EQ(i.cab_to_front, 0.0);
  const double cab = i.cab, seen = i.cab_seen;
  weigh_whole(sweep, i, true);
  EXPECT_GT(i.cab_to_front, cab + 20.0);
  EXPECT_EQ(i.cab, cab);
  EXPECT_EQ(i.cab_seen, seen);
  EXPECT_EQ(i.cab_end, 1);
  CabProfile all(i.pose.width / 2, i.pose.face(1, 1, true));
  all.take(i.pose, PassingRays(sweep, around_cabs(i.pose, 8.0)).packed(1));
  all.finish();
  EXPECT_NEAR(i.cab_to_front, all.to_front(i.pose.face(0, 1, true), 1, 1.0), 1e-6) << "as from all rays, however far its front";
}

}  // namespace
}  // namespace berm::app
