// What single rays meet of a bed.
#include <gtest/gtest.h>

#include "recognition/bed_model.hpp"

namespace berm::app {
namespace {

BedPose bed() {
  BedPose pose;
  pose.length = 5.0;
  pose.width = 2.4;
  pose.thickness = 0.1;
  return pose;
}

// From 6 m aside and 2 m up towards a place, ending there or beyond it by some metres.
RayMeeting towards(const BedPose& pose, const Eigen::Vector3d& place, double beyond = 0.0) {
  const Eigen::Vector3d head(0.0, 6.0, 2.0);
  const Eigen::Vector3d at = place + beyond * (place - head).normalized();
  return meet(pose, pose.rotation(), {head.cast<float>(), at.cast<float>()});
}

TEST(BedModel, NearWallIsMetOutside) {
  EXPECT_EQ(towards(bed(), {0.0, 1.3, -0.3}).what, Meeting::outer_face);
  EXPECT_EQ(towards(bed(), {0.0, 1.3, -0.3}, 0.5).what, Meeting::through_face);
  EXPECT_EQ(towards(bed(), {0.0, 1.3, -0.3}, -0.5).what, Meeting::before);
  EXPECT_EQ(towards(bed(), {0.0, 1.3, -0.9}).what, Meeting::none);
}

TEST(BedModel, FarWallIsMetInside) {
  EXPECT_EQ(towards(bed(), {0.0, -1.2, -0.4}).what, Meeting::inner_face);
  EXPECT_EQ(towards(bed(), {0.0, -1.2, -0.4}, 0.5).what, Meeting::through_inner);
  EXPECT_EQ(towards(bed(), {0.0, 0.0, -0.2}).what, Meeting::inside);
  EXPECT_EQ(towards(bed(), {0.0, -1.25, 0.0}).what, Meeting::wall_top);
  EXPECT_EQ(towards(bed(), {0.0, -1.3, 0.3}, 3.0).what, Meeting::over);
  EXPECT_EQ(towards(bed(), {9.0, 0.0, 0.0}).what, Meeting::none);
}

TEST(BedModel, OpenEndStopsNothing) {
  BedPose pose = bed();
  const Ray out{{6.0F, 0.0F, 2.0F}, {-4.5F, 0.0F, -1.0F}};
  EXPECT_EQ(meet(pose, pose.rotation(), out).what, Meeting::through_inner);
  pose.open_end = -1;
  EXPECT_EQ(meet(pose, pose.rotation(), out).what, Meeting::over);
  EXPECT_DOUBLE_EQ(pose.face(0, -1, true), 2.5);
  EXPECT_DOUBLE_EQ(pose.face(0, 1, true), 2.6);
}

// From behind, where no wall stands at -u: below the tops a ray goes on within, and the sides' ends are faces.
TEST(BedModel, OpenEndLetsIn) {
  BedPose pose = bed();
  pose.open_end = -1;
  const auto from_behind = [&](const Eigen::Vector3d& at) { return meet(pose, pose.rotation(), {{-7.0F, 0.0F, 1.2F}, at.cast<float>()}); };
  const RayMeeting within = from_behind({-1.0, 0.2, -0.9});
  EXPECT_EQ(within.what, Meeting::inside);
  EXPECT_TRUE(within.by_open_end);
  EXPECT_EQ(from_behind({-1.0, 1.2, -0.5}).what, Meeting::inner_face);
  EXPECT_EQ(from_behind({0.5, 1.5, -0.7}).what, Meeting::through_inner);
  EXPECT_EQ(from_behind({-2.5, 1.25, -0.3}).what, Meeting::outer_face) << "the thickness of the side, at its end";
  EXPECT_EQ(from_behind({-2.5, 1.2, -0.9}).what, Meeting::none) << "below what every class has walls of";
  pose.open_end = 0;
  EXPECT_EQ(from_behind({-1.0, 0.2, -0.9}).what, Meeting::through_face);
}

// Outer half width 1.3. Below 0.08 m under the top the side may draw in along a circle of that radius.
TEST(BedModel, BelowAPipesSideARayMayPass) {
  const auto below = [](const Eigen::Vector3d& from, const Eigen::Vector3d& to) { return below_pipe(from, to - from, 1.3, 0.12 / (to - from).norm()); };
  EXPECT_FALSE(below({0.0, 5.0, 1.0}, {0.0, 0.0, -0.3})) << "through the upright side";
  EXPECT_TRUE(below({0.0, 5.0, 3.0}, {0.0, 1.19, -0.55})) << "ends where the pipe may be";
  EXPECT_TRUE(below({6.0, 3.0, 2.0}, {-2.0, 0.9, -2.5})) << "along the side and below it";
  EXPECT_FALSE(below({0.0, 5.0, 3.0}, {0.0, 0.2, -1.0})) << "well within the pipe";
}

}  // namespace
}  // namespace berm::app
