// The fit from a start that is off, and its covariance's shape.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "drawn_bed.hpp"
#include "recognition/bed_ceres.hpp"
#include "recognition/bed_constraints.hpp"
#include "recognition/bed_fit.hpp"
#include "recognition/bed_search.hpp"

namespace berm::app {
namespace {

const BedSizes kSizes{{2.25, 2.50}, {0.05, 0.14}};

TEST(BedFit, ComesToTheBedFromNearby) {
  const DrawnBed drawn;
  BedPose start;
  start.middle = {drawn.x + 0.05, drawn.y - 0.04, drawn.top + 0.03};
  start.yaw = drawn.yaw + 0.01;
  start.length = drawn.length + 0.06;
  start.width = drawn.width - 0.05;
  start.thickness = 0.09;
  const FanSweep sweep = make_fans(sweep_of(drawn), drawn_viewpoint);
  const FittedBed fit = fit_bed(start, rays_near(sweep, start), 4, kSizes);
  ASSERT_TRUE(fit.converged);
  EXPECT_NEAR(fit.pose.middle.x(), drawn.x, 0.03);
  EXPECT_NEAR(fit.pose.middle.y(), drawn.y, 0.03);
  EXPECT_NEAR(fit.pose.middle.z(), drawn.top, 0.03);
  EXPECT_NEAR(fit.pose.yaw, drawn.yaw, 0.005);
  EXPECT_NEAR(fit.pose.length, drawn.length, 0.05);
  EXPECT_NEAR(fit.pose.width, drawn.width, 0.05);
  const Eigen::SelfAdjointEigenSolver<Matrix8d> own(fit.covariance);
  EXPECT_GT(own.eigenvalues().minCoeff(), 0.0);
  EXPECT_LT(fit.covariance(6, 6), 0.05 * 0.05);
  const Eigen::SelfAdjointEigenSolver<Matrix12d> corners(corner_covariance(fit));
  EXPECT_GT(corners.eigenvalues().minCoeff(), -1e-9);
}

// The rear half of a bed is cut off the sweep: of its length only what the classes tell is known.
TEST(BedFit, OfAnEndThatNoRayShowsTheLengthIsUnsure) {
  DrawnBed drawn;
  drawn.yaw = 0.0;
  BedPose start;
  start.middle = {drawn.x, drawn.y, drawn.top};
  start.length = drawn.length, start.width = drawn.width, start.thickness = drawn.thickness;
  const std::vector<Ray> all = rays_near(make_fans(sweep_of(drawn), drawn_viewpoint), start);
  std::vector<Ray> seen;
  std::copy_if(all.begin(), all.end(), std::back_inserter(seen), [&](const Ray& ray) { return ray.at.x() > drawn.x - 0.5; });
  const FittedBed whole = fit_bed(start, all, 3, kSizes), half = fit_bed(start, seen, 3, kSizes);
  ASSERT_TRUE(whole.converged && half.converged);
  EXPECT_LT(std::sqrt(whole.covariance(6, 6)), 0.05);
  EXPECT_GT(std::sqrt(half.covariance(6, 6)), 0.6);
  EXPECT_LT(std::sqrt(half.covariance(6, 6)), 0.75);
  EXPECT_LT(std::sqrt(half.covariance(7, 7)), 0.1) << "its width is seen";
}

// Seen from before, over the cab's end: rays from within that pass the far side just beyond its inner face's end bound the open end as well.
TEST(BedFit, AnOpenEndIsNotDrawnOut) {
  for (const double length : {4.9, 4.95, 5.0, 5.05, 5.1}) {
    DrawnBed drawn;
    drawn.x = 5.0, drawn.y = 6.5, drawn.yaw = -2.4, drawn.length = length;
    drawn.rear_wall = drawn.cab = false;
    BedPose start;
    start.middle = {drawn.x, drawn.y, drawn.top};
    start.yaw = drawn.yaw, start.length = length + 0.06, start.width = drawn.width, start.thickness = drawn.thickness, start.open_end = -1;
    const FittedBed fit = fit_bed(start, rays_near(make_fans(sweep_of(drawn), drawn_viewpoint), start), 4, kSizes);
    ASSERT_TRUE(fit.converged);
    EXPECT_NEAR(fit.pose.length, length, 0.08) << "half of what lies between two scanlines";
  }
}

TEST(BedFit, CeresAndTheSumsComeToTheSameBed) {
  for (const double yaw : {0.3, 1.2, -0.7}) {
    DrawnBed drawn;
    drawn.yaw = yaw;
    BedPose start;
    start.middle = {drawn.x + 0.03, drawn.y - 0.02, drawn.top + 0.02};
    start.yaw = drawn.yaw + 0.01, start.length = drawn.length + 0.04, start.width = drawn.width, start.thickness = 0.09;
    const std::vector<Ray> rays = rays_near(make_fans(sweep_of(drawn), drawn_viewpoint), start);
    const FittedBed by_sums = fit_bed(start, rays, 3, kSizes), by_ceres = fit_bed(start, rays, 3, kSizes, BedSolver::ceres);
    ASSERT_TRUE(by_sums.converged && by_ceres.converged);
    EXPECT_LT((by_sums.pose.middle - by_ceres.pose.middle).norm(), 0.002);
    EXPECT_NEAR(by_sums.pose.yaw, by_ceres.pose.yaw, 2e-4);
    EXPECT_NEAR(by_sums.pose.length, by_ceres.pose.length, 0.002);
    EXPECT_NEAR(by_sums.pose.width, by_ceres.pose.width, 0.002);
  }
}

// Each of the two alone, from the same start: the fit above gives Ceres what the sums came to.
TEST(BedFit, CeresComesThereByItself) {
  const DrawnBed drawn;
  BedPose start;
  start.middle = {drawn.x + 0.03, drawn.y - 0.02, drawn.top + 0.02};
  start.yaw = drawn.yaw + 0.01, start.length = drawn.length + 0.04, start.width = drawn.width, start.thickness = 0.09;
  const std::vector<BedConstraint> statements = constraints(start, rays_near(make_fans(sweep_of(drawn), drawn_viewpoint), start));
  const KnownValue known[] = {{kBedThickness, 0.09, 0.03}, {kBedPitch, 0.0, 0.03}, {kBedRoll, 0.0, 0.03}};
  const BedVector from = values_of(start);
  BedVector by_sums = from, by_ceres = from;
  solve_bed(statements, 0, known, 50, 1e-6, by_sums);
  solve_bed_by_ceres(statements, 0, known, 50, 1e-6, by_ceres);
  EXPECT_GT((by_ceres - from).norm(), 0.03) << "it went nowhere";
  EXPECT_LT((by_ceres - by_sums).norm(), 0.003);
  BedPose pose = start;
  set_values(pose, by_ceres);
  EXPECT_NEAR(pose.middle.x(), drawn.x, 0.02);
  EXPECT_NEAR(pose.middle.z(), drawn.top, 0.02);
  EXPECT_NEAR(pose.yaw, drawn.yaw, 0.003);
}

TEST(BedFit, SaysWhenTooFewRaysSpeakOfTheBed) { EXPECT_FALSE(fit_bed({}, {}, 3, kSizes).converged); }

}  // namespace
}  // namespace berm::app
