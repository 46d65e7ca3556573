// The sweep: its order and timing, and its noise against the noise-free cast.
#include <gtest/gtest.h>

#include <cmath>

#include "truck_scenes.hpp"

namespace berm::truck_world {
namespace {

TEST(TruckWorldSweep, NoiseIsAsAskedAgainstTheNoiseFreeCast) {
  SceneOptions options;
  options.content = Content::truck;
  options.noise = {0.03, 0.005, 0.01};
  const auto classes = shipped_classes();
  double sum = 0.0, squares = 0.0;
  std::int64_t returns = 0, outliers = 0, beyond = 0, expected = 0, samples = 0;
  for (int number = 0; number < 4; ++number) {
    const Scene scene = draw_scene(classes, options, 71, number);
    const BoundingTree tree(scene.mesh);
    samples += scene.sweep.samples;
    for (std::size_t i = 0; i < scene.cloud.size(); ++i) {
      const PointTruth& p = scene.point_truth[i];
      const SampleRay ray = scene.sweep.ray(static_cast<int>(p.sample));
      const auto hit = tree.first(ray.origin, ray.direction, range_max);
      const Vector3d at(scene.cloud[i].x, scene.cloud[i].y, scene.cloud[i].z);
      EXPECT_LT((at - ray.origin).cross(ray.direction).norm(), 1e-4);  // on its ray
      EXPECT_EQ(scene.cloud[i].scanline, ray.scanline);
      EXPECT_EQ(scene.cloud[i].time_s, ray.time_s);
      const double range = (at - ray.origin).dot(ray.direction);
      if (p.outlier) {
        ++outliers;
        beyond += range > (hit ? hit->range : range_max) + 1e-4 ? 1 : 0;
        continue;
      }
      ASSERT_TRUE(hit);
      EXPECT_EQ(scene.mesh[hit->triangle].surface, p.surface);
      // Where noise takes a point over the own machine's radius, what is left of the noise is one-sided.
      if ((ray.origin + hit->range * ray.direction).head<2>().norm() < own_radius + 0.2) continue;
      ++returns;
      sum += range - hit->range;
      squares += (range - hit->range) * (range - hit->range);
    }
    for (int sample = 0; sample < scene.sweep.samples; ++sample) {
      const SampleRay ray = scene.sweep.ray(sample);
      const auto hit = tree.first(ray.origin, ray.direction, range_max);
      expected += hit && hit->range > range_min && scene.mesh[hit->triangle].surface != Surface::own_arm &&
                          (ray.origin + hit->range * ray.direction).head<2>().norm() >= own_radius + 0.2 ? 1 : 0;
    }
  }
  const double n = static_cast<double>(returns), mean = sum / n, deviation = std::sqrt(squares / n - mean * mean);
  EXPECT_GT(n, 20000.0);
  EXPECT_LT(std::abs(mean), 4 * 0.03 / std::sqrt(n));
  EXPECT_NEAR(deviation, 0.03, 4 * 0.03 / std::sqrt(2 * n));
  EXPECT_EQ(beyond, 0);
  const double lost = 1.0 - n / static_cast<double>(expected);
  EXPECT_NEAR(lost, 0.015, 4 * std::sqrt(0.015 / n));
  // Those that fall on the own machine are not published.
  EXPECT_LE(static_cast<double>(outliers), 1.2 * 0.005 * static_cast<double>(samples));
  EXPECT_GE(static_cast<double>(outliers), 0.5 * 0.005 * static_cast<double>(samples));
}

TEST(TruckWorldSweep, ScanlinesAndTimesRunOnAndTheHeadTurnsThroughTheSector) {
  SceneOptions options;
  options.content = Content::truck;
  const auto classes = shipped_classes();
  bool swung = false, stood = false;
  for (int number = 0; number < 12; ++number) {
    const Scene scene = draw_scene(classes, options, 81, number);
    const Sweep& sweep = scene.sweep;
    EXPECT_EQ(sweep.samples, 36000);
    EXPECT_NEAR(sweep.duration(), 3.0, 1e-12);
    for (std::size_t i = 1; i < scene.cloud.size(); ++i) {
      ASSERT_GE(scene.cloud[i].scanline, scene.cloud[i - 1].scanline);
      ASSERT_GE(scene.cloud[i].time_s, scene.cloud[i - 1].time_s);
    }
    EXPECT_LT(scene.cloud.back().scanline, 90U);
    const double turned = std::abs(sweep.swing_rate + sweep.pan_rate) * sweep.duration();
    EXPECT_NEAR(turned, pi / 2, 1e-9);
    const double side = sweep.sensor == Sensor::left_scanner ? 1.0 : -1.0;
    for (const double time : {0.0, sweep.duration()}) {
      const double pan = side * (sweep.pan_begin + sweep.pan_rate * time);
      EXPECT_GE(pan, pan_low - 1e-9);
      EXPECT_LE(pan, pan_high + 1e-9);
    }
    EXPECT_NEAR(sweep.swing_begin + sweep.swing_rate * sweep.duration() / 2, 0.0, 1e-12);
    (sweep.swing_rate == 0.0 ? stood : swung) = true;
    // All four corners are in the sector: a fan comes within half a pan step of each.
    for (const Vector3d& corner : scene.truth.of_truck.corners) {
      double nearest = 10.0;
      for (int line = 0; line < 90; ++line) {
        const SampleRay ray = sweep.ray(line * samples_per_scanline);
        const Vector3d way = corner - ray.origin;
        const double off = std::atan2(way.y(), way.x()) - std::atan2(ray.direction.y(), ray.direction.x());
        nearest = std::min(nearest, std::abs(std::remainder(off, 2 * pi)));
      }
      EXPECT_LT(nearest, 0.6 * pi / 180.0);
    }
  }
  EXPECT_TRUE(swung && stood);
}

TEST(TruckWorldSweep, TheLidarSeesTheTruckFromItsMast) {
  SceneOptions options;
  options.content = Content::truck;
  options.lidar = true;
  const Scene scene = draw_scene(shipped_classes(), options, 91, 0);
  EXPECT_EQ(scene.truth.sensor, Sensor::lidar);
  EXPECT_GT(scene.truth.of_truck.bed_returns, 100);
  for (std::size_t i = 1; i < scene.cloud.size(); ++i) ASSERT_GE(scene.cloud[i].scanline, scene.cloud[i - 1].scanline);
}

}  // namespace
}  // namespace berm::truck_world
