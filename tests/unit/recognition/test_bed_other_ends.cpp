// Other ends of a bed: from one that is half a metre off the true place is among them, and lengths that no truck has are not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drawn_bed.hpp"
#include "recognition/bed_other_ends.hpp"

namespace berm::app {
namespace {

constexpr double kWorth = 0.7;

BedPose pose_of(const DrawnBed& bed) {
  BedPose p;
  p.middle = {bed.x, bed.y, bed.top};
  p.yaw = bed.yaw, p.length = bed.length, p.width = bed.width, p.thickness = bed.thickness;
  return p;
}

// The bed with its front (end 1) or rear (-1) farther out by so much.
BedPose with_end(const DrawnBed& bed, int end, double by) {
  BedPose p = pose_of(bed);
  p.length += end * by;
  p.middle += p.rotation().col(0) * (0.5 * by);
  return p;
}

bool among(const std::vector<BedPose>& all, const BedPose& p) {
  return std::any_of(all.begin(), all.end(), [&](const BedPose& o) { return (o.middle - p.middle).norm() < 0.06 && std::abs(o.length - p.length) < 0.06; });
}

TEST(BedOtherEnds, TheTrueEndIsAmongThem) {
  const DrawnBed bed;
  const FanSweep sweep = make_fans(sweep_of(bed), drawn_viewpoint);
  for (const int end : {1, -1})
    for (const double by : {-0.6, 0.5}) {
      const BedPose off = with_end(bed, end, by);
      EXPECT_TRUE(among(other_ends(sweep, off, {4.0, 6.4}, kWorth), pose_of(bed))) << end << ' ' << by;
    }
}

TEST(BedOtherEnds, NoneIsOfALengthThatTrucksDoNotHave) {
  const DrawnBed bed;
  const FanSweep sweep = make_fans(sweep_of(bed), drawn_viewpoint);
  const BedPose off = with_end(bed, 1, 0.5);
  EXPECT_FALSE(among(other_ends(sweep, off, {5.2, 6.4}, kWorth), pose_of(bed)));
  for (const BedPose& p : other_ends(sweep, off, {5.2, 6.4}, kWorth)) EXPECT_TRUE(p.length >= 5.2 && p.length <= 6.4) << p.length;
}

TEST(BedOtherEnds, NoneIsNearTheGivenOne) {
  const DrawnBed bed;
  const FanSweep sweep = make_fans(sweep_of(bed), drawn_viewpoint);
  for (const BedPose& p : other_ends(sweep, pose_of(bed), {4.0, 6.4}, kWorth)) EXPECT_GT(std::abs(p.length - bed.length), 0.15);
}

// The true bed is worth more than every other, so that none comes to as much.
TEST(BedOtherEnds, NoneIsWorthLessThanWasAskedFor) {
  const DrawnBed bed;
  const FanSweep sweep = make_fans(sweep_of(bed), drawn_viewpoint);
  EXPECT_TRUE(other_ends(sweep, pose_of(bed), {4.0, 6.4}, 1.0).empty());
  const BedPose off = with_end(bed, 1, 0.5);
  EXPECT_TRUE(among(other_ends(sweep, off, {4.0, 6.4}, 1.0), pose_of(bed)));
  EXPECT_TRUE(other_ends(sweep, off, {4.0, 6.4}, 10.0).empty());
}

}  // namespace
}  // namespace berm::app
