// The ray caster against every triangle tried one by one, by another formula.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "truck_scenes.hpp"

namespace berm::truck_world {
namespace {

// Where the ray meets the triangle's plane, if that is inside by the three edges' sides. Not the tree's own formula.
std::optional<double> meets(const Triangle& t, const Vector3d& origin, const Vector3d& direction) {
  const Vector3d normal = (t.b - t.a).cross(t.c - t.a);
  const double across = normal.dot(direction);
  if (across == 0.0) return std::nullopt;
  const double range = normal.dot(t.a - origin) / across;
  const Vector3d p = origin + range * direction;
  const Vector3d corner[3]{t.a, t.b, t.c};
  for (int i = 0; i < 3; ++i)
    if ((corner[(i + 1) % 3] - corner[i]).cross(p - corner[i]).dot(normal) < 0.0) return std::nullopt;
  return range > 0.0 ? std::optional(range) : std::nullopt;
}

double nearest_of_all(const Mesh& mesh, const Vector3d& origin, const Vector3d& direction, double range_limit) {
  double best = range_limit;
  for (const Triangle& t : mesh)
    if (const auto range = meets(t, origin, direction)) best = std::min(best, *range);
  return best;
}

Vector3d drawn_direction(Random& random) { return Vector3d(random.normal(), random.normal(), random.normal()).normalized(); }

TEST(TruckWorldBoundingTree, MeetsWhatAllTrianglesTriedMeet) {
  Random random(11);
  int hits = 0, misses = 0;
  for (int round = 0; round < 60; ++round) {
    Mesh mesh(below(random, 200) + 1);
    const double size = random.uniform(0.2, 4.0);
    const auto drawn = [&](double spread) {
      const double x = random.uniform(-spread, spread), y = random.uniform(-spread, spread), z = random.uniform(-spread, spread);
      return Vector3d(x, y, z);
    };
    for (Triangle& t : mesh) {
      const Vector3d at = drawn(8.0);
      t = {at + drawn(size), at + drawn(size), at + drawn(size), Surface::clutter};
    }
    const BoundingTree tree(mesh);
    for (int i = 0; i < 60; ++i) {
      const Vector3d origin = drawn(10.0), direction = drawn_direction(random);
      const double expected = nearest_of_all(mesh, origin, direction, 15.0);
      const auto hit = tree.first(origin, direction, 15.0);
      ASSERT_EQ(hit.has_value(), expected < 15.0) << "round " << round << ", ray " << i;
      if (hit) {
        ASSERT_NEAR(hit->range, expected, 1e-9) << "round " << round << ", ray " << i;
      }
      ++(hit ? hits : misses);
    }
  }
  EXPECT_GT(hits, 300);
  EXPECT_GT(misses, 300);
}

TEST(TruckWorldBoundingTree, MeetsWhatAllTrianglesTriedMeetInAScene) {
  const Scene scene = draw_scene(shipped_classes(), coarse(Content::truck), 3, 5);
  const BoundingTree tree(scene.mesh);
  int hits = 0;
  for (int sample = 0; sample < scene.sweep.samples; sample += 61) {
    const SampleRay ray = scene.sweep.ray(sample);
    const double expected = nearest_of_all(scene.mesh, ray.origin, ray.direction, range_max);
    const auto hit = tree.first(ray.origin, ray.direction, range_max);
    ASSERT_EQ(hit.has_value(), expected < range_max) << "sample " << sample;
    if (hit) {
      ASSERT_NEAR(hit->range, expected, 1e-8) << "sample " << sample;
    }
    hits += hit ? 1 : 0;
  }
  EXPECT_GT(hits, 50);
}

TEST(TruckWorldBoundingTree, TakesRaysAlongAxesAndNothingAtAll) {
  Mesh mesh;
  add_box(mesh, {1, -1, -1}, {2, 1, 1}, Surface::clutter);
  const BoundingTree tree(mesh);
  const auto hit = tree.first(Vector3d::Zero(), Vector3d::UnitX(), 10.0);
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->range, 1.0);
  EXPECT_FALSE(tree.first(Vector3d::Zero(), -Vector3d::UnitX(), 10.0));
  EXPECT_FALSE(tree.first(Vector3d::Zero(), Vector3d::UnitX(), 0.9));
  EXPECT_FALSE(tree.first({0, 3, 0}, Vector3d::UnitX(), 10.0));
  EXPECT_FALSE(BoundingTree(Mesh{}).first(Vector3d::Zero(), Vector3d::UnitX(), 10.0));
}

}  // namespace
}  // namespace berm::truck_world
