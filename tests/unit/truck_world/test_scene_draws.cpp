// What is drawn: the same again for the same seed, all kinds of it, within its ranges.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>

#include "truck_scenes.hpp"
#include "truck_world/truck_placing.hpp"

namespace berm::truck_world {
namespace {

bool same_clouds(const Scene& a, const Scene& b) {
  if (a.cloud.size() != b.cloud.size()) return false;
  for (std::size_t i = 0; i < a.cloud.size(); ++i) {
    const app::ScanPoint &p = a.cloud[i], &q = b.cloud[i];
    if (std::memcmp(&p.x, &q.x, 3 * sizeof(float)) != 0 || p.scanline != q.scanline || p.time_s != q.time_s) return false;
    if (a.point_truth[i].surface != b.point_truth[i].surface || a.point_truth[i].outlier != b.point_truth[i].outlier) return false;
  }
  return true;
}

TEST(TruckWorldScenes, TheSameSeedAndNumberGiveTheSameBits) {
  const auto classes = shipped_classes();
  for (const int number : {0, 1, 2, 3}) {
    const Scene once = draw_scene(classes, coarse(Content::either), 7, number), again = draw_scene(classes, coarse(Content::either), 7, number);
    EXPECT_TRUE(same_clouds(once, again)) << number;
    EXPECT_EQ(std::memcmp(once.truth.of_truck.corners.data(), again.truth.of_truck.corners.data(), sizeof once.truth.of_truck.corners), 0);
    EXPECT_FALSE(same_clouds(once, draw_scene(classes, coarse(Content::either), 8, number))) << number;
    EXPECT_FALSE(same_clouds(once, draw_scene(classes, coarse(Content::either), 7, number + 1))) << number;
  }
}

TEST(TruckWorldScenes, NoiseChangesNothingOfTheScene) {
  const auto classes = shipped_classes();
  SceneOptions quiet = coarse(Content::truck);
  quiet.noise = {0.0, 0.0, 0.0};
  const Scene noisy = draw_scene(classes, coarse(Content::truck), 7, 4), still = draw_scene(classes, quiet, 7, 4);
  ASSERT_EQ(noisy.mesh.size(), still.mesh.size());
  for (std::size_t i = 0; i < still.mesh.size(); ++i) ASSERT_EQ(noisy.mesh[i].a, still.mesh[i].a);
  EXPECT_FALSE(same_clouds(noisy, still));
}

TEST(TruckWorldScenes, TrucksAreWithinTheirClassAndTheSite) {
  const auto classes = shipped_classes();
  std::set<std::string> seen, fills, gates;
  const auto inside = [](double x, const Range& range) { return x >= range[0] && x <= range[1]; };
  int left = 0, level = 0, deep = 0;
  const int scenes = 120;
  for (int number = 0; number < scenes; ++number) {
    const PlacedTruck truck = place_truck(classes, coarse(Content::truck), 21, number);
    const TruckClass& c = classes[truck.truck_class];
    const TruckBody& b = truck.body;
    seen.insert(c.name);
    fills.insert(std::string(name_of(truck.load.fill())));
    gates.insert(name_of(b.tailgate));
    // As measured on the corners, not as the draw says.
    const double length = (truck.corners[0] - truck.corners[1]).norm(), width = (truck.corners[1] - truck.corners[2]).norm();
    EXPECT_TRUE(inside(length, c.inside_length) && inside(width, c.inside_width)) << c.name << ' ' << length << ' ' << width;
    EXPECT_TRUE(inside(b.wall_height, c.wall_height) && inside(b.wall_thickness, c.wall_thickness)) << c.name;
    EXPECT_TRUE(inside(b.floor_height, c.floor_height)) << c.name;
    EXPECT_TRUE(inside(b.top(), c.wall_top) && inside(b.mud, c.mud)) << c.name;
    EXPECT_TRUE(inside(b.struck_volume(), {12.0, 23.0})) << c.name << ' ' << b.struck_volume();
    const double distance = truck.place.at.norm();
    EXPECT_TRUE(inside(distance, {5.0, 12.0})) << distance;
    EXPECT_TRUE(inside(truck.place.drop, {0.0, 3.0}));
    EXPECT_LE(std::max(std::abs(truck.pitch), std::abs(truck.roll)), 0.0600001);
    for (const Triangle& t : truck.mesh)
      for (const Vector3d& p : {t.a, t.b, t.c}) EXPECT_GT(p.head<2>().norm(), 3.1);
    left += truck.place.at.y() > 0.0 ? 1 : 0;
    level += truck.place.drop == 0.0 ? 1 : 0;
    deep += truck.place.drop > 2.0 ? 1 : 0;
  }
  EXPECT_EQ(seen.size(), classes.size());
  EXPECT_EQ(fills.size(), 4U);
  EXPECT_EQ(gates.size(), 3U);
  EXPECT_GT(left, scenes / 4);
  EXPECT_LT(left, 3 * scenes / 4);
  EXPECT_GT(level, 0);
  EXPECT_GT(deep, 0);
}

// How high what the look-alike has at its middle is; -100 with nothing there.
double height_over_place(const Scene& scene) {
  const BoundingTree tree(part_of(scene, [](Surface s) { return s == Surface::look_alike; }));
  const Vector3d above(scene.truth.place.x(), scene.truth.place.y(), 20.0);
  const auto hit = tree.first(above, -Vector3d::UnitZ(), 60.0);
  return hit ? above.z() - hit->range : -100.0;
}

TEST(TruckWorldScenes, ScenesWithoutATruckHaveNoneAndWhatIsLikeOneIsNone) {
  const auto classes = shipped_classes();
  std::set<std::string> kinds, clutter;
  int like = 0, bare = 0;
  const int scenes = 150;
  for (int number = 0; number < scenes; ++number) {
    const Scene scene = draw_scene(classes, coarse(Content::no_truck), 5, number);
    EXPECT_FALSE(scene.truth.truck);
    for (const Triangle& t : scene.mesh) ASSERT_FALSE(is_truck(t.surface)) << number;
    for (const PointTruth& p : scene.point_truth) ASSERT_FALSE(is_truck(p.surface)) << number;
    clutter.insert(scene.truth.clutter.begin(), scene.truth.clutter.end());
    bare += scene.truth.look_alike.empty() && scene.truth.clutter.empty() ? 1 : 0;
    if (scene.truth.look_alike.empty()) continue;
    ++like;
    kinds.insert(scene.truth.look_alike);
    const NoTruck& why = scene.truth.no_truck;
    EXPECT_TRUE(why.outside_sizes || why.wall_missing || why.roofed) << scene.truth.look_alike;
    if (why.outside_sizes) {
      const OpenBox& box = scene.truth.look_alike_box;
      for (const TruckClass& c : classes) {
        const auto beyond = [](double x, const Range& range) { return std::max(range[0] - x, x - range[1]); };
        const double most = std::max({beyond(box.length, c.inside_length), beyond(box.width, c.inside_width), beyond(box.height, c.wall_height)});
        EXPECT_GE(most, 0.3) << scene.truth.look_alike << " against " << c.name;
      }
    }
    if (why.roofed) {
      EXPECT_GT(height_over_place(scene), -scene.truth.drop + 2.0);
    }
    if (scene.truth.look_alike == "trench_box") {
      EXPECT_LT(height_over_place(scene), -50.0) << "a floor";
    }
  }
  EXPECT_EQ(kinds.size(), look_alike_names.size());
  EXPECT_EQ(clutter.size(), clutter_names.size());
  EXPECT_GT(bare, 0);
  EXPECT_NEAR(like, scenes / 2, 30);
}

TEST(TruckWorldScenes, HalfOfThemHaveATruckUnlessAskedOtherwise) {
  const auto classes = shipped_classes();
  int trucks = 0;
  for (int number = 0; number < 40; ++number) trucks += draw_scene(classes, coarse(Content::either), 2, number).truth.truck ? 1 : 0;
  EXPECT_NEAR(trucks, 20, 13);
}

}  // namespace
}  // namespace berm::truck_world
