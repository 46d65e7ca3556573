// Walls from scanlines, and the planes that lean with the truck.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "recognition/upright_regions.hpp"

namespace berm::app {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = 0.017453292519943295;

// 40 fans over a wall 2.4 m high whose plane is given; a hundredth of the returns comes from 0.25 m before it.
FanSweep sweep_over(const Vector3d& normal, const Vector3d& at) {
  FanSweep sweep;
  const Vector3d head(0.0, 0.0, 3.0);
  int number = 0;
  for (int fan = 0; fan < 40; ++fan) {
    sweep.heads.push_back(head);
    sweep.begin.push_back(sweep.returns.size());
    const double pan = (fan - 20) * kDegree;
    for (int k = 0; k < 90; ++k) {
      const double down = -0.9 * k * kDegree;
      const Vector3d d(std::cos(down) * std::cos(pan), std::cos(down) * std::sin(pan), std::sin(down));
      const double range = normal.dot(at - head) / normal.dot(d) + (k % 2 == 0 ? 0.01 : -0.01) - (++number % 97 == 0 ? 0.25 : 0.0);
      const Vector3d hit = head + range * d;
      if (hit.z() < 0.0 || hit.z() > 2.4) continue;
      sweep.returns.push_back({hit, static_cast<std::uint32_t>(fan)});
    }
  }
  sweep.begin.push_back(sweep.returns.size());
  return sweep;
}

TEST(UprightRegions, AWallsPlaneLeansAsItDoesAndLooksAtTheSensor) {
  for (const double lean : {-3.0, 0.0, 3.0})
    for (const double turned : {-25.0, 0.0, 30.0}) {
      const Vector3d normal = Eigen::AngleAxisd(turned * kDegree, Vector3d::UnitZ()) * Eigen::AngleAxisd(lean * kDegree, Vector3d::UnitY()) * Vector3d(-1.0, 0.0, 0.0);
      const Vector3d at(7.0, 0.0, 1.2);
      FanSweep sweep = sweep_over(normal, at);
      const auto regions = upright_regions(sweep, upright_segments(sweep));
      ASSERT_FALSE(regions.empty());
      const UprightRegion& wall = regions.front();
      EXPECT_GT(wall.face_normal.dot(normal), std::cos(0.3 * kDegree)) << lean << " " << turned << ": " << wall.face_normal.transpose();
      EXPECT_NEAR(normal.dot(wall.face_at - at), 0.0, 0.005) << "returns before it are left out";
      EXPECT_NEAR(wall.face_normal.norm(), 1.0, 1e-12);
    }
}

TEST(UprightRegions, SegmentsNameTheirReturns) {
  FanSweep sweep = sweep_over({-1.0, 0.0, 0.0}, {7.0, 0.0, 1.2});
  const auto segments = upright_segments(sweep);
  ASSERT_FALSE(segments.empty());
  for (const UprightSegment& s : segments) {
    ASSERT_LE(s.begin + static_cast<std::size_t>(s.count), sweep.begin[s.fan + 1]);
    ASSERT_GE(s.begin, sweep.begin[s.fan]);
    for (std::size_t k = s.begin; k < s.begin + static_cast<std::size_t>(s.count); ++k) {
      EXPECT_TRUE(sweep.returns[k].upright);
      EXPECT_GE(sweep.returns[k].at.z(), s.low);
      EXPECT_LE(sweep.returns[k].at.z(), s.high);
    }
  }
}

}  // namespace
}  // namespace berm::app
