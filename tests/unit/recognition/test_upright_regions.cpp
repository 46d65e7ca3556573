// Walls from scanlines.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "recognition/upright_regions.hpp"

namespace berm::app {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = 0.017453292519943295;

// 40 fans over a wall 2.4 m high whose plane is given.
FanSweep sweep_over(const Vector3d& normal, const Vector3d& at) {
  FanSweep sweep;
  const Vector3d head(0.0, 0.0, 3.0);
  for (int fan = 0; fan < 40; ++fan) {
    sweep.heads.push_back(head);
    sweep.begin.push_back(sweep.returns.size());
    const double pan = (fan - 20) * kDegree;
    for (int k = 0; k < 90; ++k) {
      const double down = -0.9 * k * kDegree;
      const Vector3d d(std::cos(down) * std::cos(pan), std::cos(down) * std::sin(pan), std::sin(down));
      const double range = normal.dot(at - head) / normal.dot(d) + (k % 2 == 0 ? 0.01 : -0.01);
      const Vector3d hit = head + range * d;
      if (hit.z() < 0.0 || hit.z() > 2.4) continue;
      sweep.returns.push_back({hit.cast<float>()});
    }
  }
  sweep.begin.push_back(sweep.returns.size());
  return sweep;
}

TEST(UprightRegions, AWallIsOneThatLooksAtTheSensorAndGoesAsFarAsItIsSeen) {
  for (const double turned : {-25.0, 0.0, 30.0}) {
    const Vector3d normal = Eigen::AngleAxisd(turned * kDegree, Vector3d::UnitZ()) * Vector3d(-1.0, 0.0, 0.0), at(7.0, 0.0, 1.2);
    FanSweep sweep = sweep_over(normal, at);
    const auto regions = upright_regions(sweep, upright_segments(sweep));
    ASSERT_FALSE(regions.empty());
    const UprightRegion& wall = regions.front();
    EXPECT_GT(wall.normal.dot(normal.head<2>()), std::cos(0.5 * kDegree)) << turned;
    const Eigen::Vector2d middle = 0.5 * (wall.first + wall.last);
    EXPECT_NEAR(normal.head<2>().dot(middle - at.head<2>()), 0.0, 0.03);
    // The outermost fans are 20 degrees to either side.
    const auto seen_at = [&](double pan) {
      const Eigen::Vector2d d(std::cos(pan), std::sin(pan));
      return Eigen::Vector2d(normal.dot(at) / normal.head<2>().dot(d) * d);
    };
    EXPECT_NEAR((wall.last - wall.first).norm(), (seen_at(19 * kDegree) - seen_at(-20 * kDegree)).norm(), 0.15) << turned;
    EXPECT_GT(wall.low, -0.01);
    EXPECT_LT(wall.high, 2.41);
    EXPECT_GT(wall.high - wall.low, 1.0);
  }
}

TEST(UprightRegions, ReturnsOfSegmentsAreMarkedAndThoseOfTheGroundAreNot) {
  FanSweep wall = sweep_over({-1.0, 0.0, 0.0}, {7.0, 0.0, 1.2}), ground;
  EXPECT_FALSE(upright_segments(wall).empty());
  const auto marked = std::count_if(wall.returns.begin(), wall.returns.end(), [](const FanReturn& r) { return r.upright; });
  EXPECT_GT(static_cast<double>(marked), 0.9 * static_cast<double>(wall.returns.size()));
  ground.heads = {Vector3d(0.0, 0.0, 3.0)};
  for (int k = 20; k < 80; ++k) ground.returns.push_back({Vector3d(3.0 / std::tan(0.9 * k * kDegree), 0.0, 0.0).cast<float>()});
  ground.begin = {0, ground.returns.size()};
  EXPECT_TRUE(upright_segments(ground).empty());
}

}  // namespace
}  // namespace berm::app
