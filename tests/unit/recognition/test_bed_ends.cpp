// The table of all pairs of ends says what the rays say of each.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "drawn_bed.hpp"
#include "recognition/bed_ends.hpp"
#include "recognition/bed_evidence.hpp"
#include "recognition/evidence_weights.hpp"
#include "recognition/bed_search.hpp"
#include "recognition/rays_of_sweep.hpp"

namespace berm::app {
namespace {

constexpr SizeRange kLengths{4.0, 6.5};

BedPose true_pose(const DrawnBed& bed) {
  BedPose p;
  p.middle = {bed.x, bed.y, bed.top};
  p.yaw = bed.yaw, p.length = bed.length, p.width = bed.width, p.thickness = bed.thickness;
  p.open_end = bed.rear_wall ? 0 : -1;
  return p;
}

FanSweep fans_of(const DrawnBed& bed) {
  FanSweep sweep = make_fans(sweep_of(bed), drawn_viewpoint);
  upright_segments(sweep);
  return sweep;
}

// Of a strip that begins anywhere along the bed.
BedStrip strip_of(const DrawnBed& bed, double along) {
  BedStrip s;
  s.middle = {bed.x + along * std::cos(bed.yaw), bed.y + along * std::sin(bed.yaw), bed.top};
  s.yaw = bed.yaw, s.width = bed.width, s.thickness = bed.thickness;
  return s;
}

TEST(BedEnds, AreWhereTheWallsStand) {
  for (const bool rear_wall : {true, false})
    for (const double along : {-1.83, 0.02, 1.47}) {
      DrawnBed bed;
      bed.rear_wall = rear_wall;
      const FanSweep sweep = fans_of(bed);
      const auto ends = best_ends(strip_of(bed, along), PackedRays(rays_near(sweep, true_pose(bed), 2.4)), kLengths, 1.0, 3);
      ASSERT_FALSE(ends.empty());
      const BedEnds& best = ends.front();
      EXPECT_NE(best.pose.open_end, 1);
      EXPECT_TRUE(!rear_wall || best.pose.open_end == 0);
      EXPECT_EQ(best.cab_end, 1);
      EXPECT_NEAR(best.pose.length, bed.length, rear_wall ? 0.16 : 0.3);
      EXPECT_LT((best.pose.middle - true_pose(bed).middle).norm(), 0.16);
      for (std::size_t i = 1; i < ends.size(); ++i) {
        const Eigen::Vector3d u(std::cos(bed.yaw), std::sin(bed.yaw), 0.0);
        const double shift = u.dot(ends[i].pose.middle - best.pose.middle), half = 0.5 * (ends[i].pose.length - best.pose.length);
        EXPECT_GT(std::max(std::abs(shift - half), std::abs(shift + half)), 0.199) << "another pair, not a neighbour";
      }
    }
}

// Few enough rays that no face is saturated: then the table and the rays followed one by one agree but for the steps of the table at the ends.
TEST(BedEnds, WeighAsTheRaysOneByOne) {
  const DrawnBed bed;
  const FanSweep sweep = fans_of(bed);
  const std::vector<Ray> rays = every(rays_near(sweep, true_pose(bed), 2.4), 8);
  int compared = 0;
  for (const double along : {-0.6, -0.2, 0.0, 0.3, 0.7})
    for (const double aside : {-0.3, 0.0, 0.25})
      for (const double up : {-0.3, 0.0, 0.2})
        for (const double turn : {-0.1, 0.0, 0.15}) {
          BedStrip strip = strip_of(bed, along);
          strip.middle += Eigen::Vector3d(-aside * std::sin(bed.yaw), aside * std::cos(bed.yaw), up);
          strip.yaw += turn;
          for (const BedEnds& e : best_ends(strip, PackedRays(rays), kLengths, 1.0, 6)) {
            BedEvidence one_by_one = weigh(e.pose, rays);
            one_by_one.score += kAbove * one_by_one.above_inner;  // what lies above an inner face the table leaves out
            EXPECT_NEAR(e.bed, one_by_one.score, 12.0 + 0.15 * std::abs(one_by_one.score)) << along << " " << aside << " " << up << " " << turn;
            ++compared;
          }
        }
  EXPECT_GT(compared, 150);
}

TEST(BedEnds, OfNothingAreNone) {
  EXPECT_TRUE(best_ends(strip_of(DrawnBed{}, 0.0), PackedRays(), kLengths, 1.0, 3).empty());
}

TEST(LongerLength, TellsAContainerFromABed) {
  DrawnBed bed, container;
  container.length = 7.3;
  container.cab = false;
  const TruckRangeSet ranges = read_truck_ranges(BERM_TRUCK_RANGES);
  EXPECT_EQ(longer_length(fans_of(bed), true_pose(bed), ranges, 0.0), 0.0);
  EXPECT_NEAR(longer_length(fans_of(container), true_pose(container), ranges, 0.0), 7.3, 0.25);
  // What beyond the bed's end agrees with a cab as well is no reason to take it for more of the bed.
  EXPECT_EQ(longer_length(fans_of(container), true_pose(container), ranges, 300.0), 0.0);
}

}  // namespace
}  // namespace berm::app
