#include "recognition/bed_refinement.hpp"

#include <gtest/gtest.h>

#include "drawn_bed.hpp"
#include "recognition/rays_of_sweep.hpp"

namespace berm::app {
namespace {

// A struck load that lies level with the tops looks as they do, so that a lower and narrower bed, whose near wall's edge is where the same rays pass, agrees
// with the rays almost as well. Without moves along these rays the last two stay where they begin.
TEST(BedRefinement, FollowsTheRaysThatPassTheNearWallUnderALevelLoad) {
  DrawnBed drawn;
  drawn.load = drawn.top - 0.03;
  const FanSweep sweep = make_fans(sweep_of(drawn), drawn_viewpoint);
  BedPose bed;
  bed.middle = {drawn.x, drawn.y, drawn.top};
  bed.yaw = drawn.yaw, bed.length = drawn.length, bed.width = drawn.width, bed.thickness = drawn.thickness;
  const Eigen::Vector3d sensor = bed.rotation().transpose() * (sweep.heads[sweep.heads.size() / 2] - bed.middle);
  for (const double low : {0.03, 0.07, 0.08}) {
    BedPose start = bed;
    const double in = low * sensor.y() / sensor.z();
    start.middle += Eigen::Vector3d(std::sin(bed.yaw) * in / 2, -std::cos(bed.yaw) * in / 2, -low);
    start.width -= std::abs(in);
    const BedPose found = refined(start, PackedRays(rays_near(sweep, start)), {2.2, 2.6}, 0.06, 3);
    EXPECT_NEAR(found.width, bed.width, 0.05) << low;
    EXPECT_NEAR(found.middle.z(), bed.middle.z(), 0.025) << low;
  }
}

}  // namespace
}  // namespace berm::app
