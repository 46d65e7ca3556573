// The truth of a scene against its triangles and its cloud, by rays and by counting, never by the generator's formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "truck_scenes.hpp"

namespace berm::truck_world {
namespace {

bool is_wall(Surface s) { return s >= Surface::wall_front && s <= Surface::wall_right; }

struct Opening {
  Vector3d middle, up;
  explicit Opening(const std::array<Vector3d, 4>& c) : middle((c[0] + c[1] + c[2] + c[3]) / 4), up((c[1] - c[0]).cross(c[3] - c[0]).normalized()) {
    if (up.z() < 0.0) up = -up;
  }
};

// From the middle of the opening towards the point, raised or lowered by rise: how far beyond the point (m) a wall is met.
double met_beyond(const BoundingTree& walls, const Opening& opening, const Vector3d& point, double rise) {
  const Vector3d from = opening.middle + rise * opening.up, way = point - opening.middle;
  const auto hit = walls.first(from, way.normalized(), 20.0);
  return hit ? hit->range - way.norm() : 100.0;
}

TEST(TruckWorldTruth, CornersLieOnTheInnerTopEdgeOfTheWalls) {
  const auto classes = shipped_classes();
  std::set<std::string> seen;
  int open_ends = 0;
  for (int number = 0; number < 24; ++number) {
    const Scene scene = draw_scene(classes, coarse(Content::truck), 31, number);
    const TruckTruth& k = scene.truth.of_truck;
    seen.insert(k.truck_class);
    const BoundingTree walls(part_of(scene, is_wall));
    const Opening opening(k.corners);
    for (std::size_t side = 0; side < 4; ++side) {
      const Vector3d &from = k.corners[side], &to = k.corners[(side + 1) % 4];
      for (const double along : {0.01, 0.1, 0.5, 0.9, 0.99}) {
        const Vector3d point = from + along * (to - from);
        const double below = met_beyond(walls, opening, point, -0.003), above = met_beyond(walls, opening, point, 0.003);
        if (side == 1 && k.tailgate != "up") {
          EXPECT_GT(below, 50.0) << number << ": a wall at the open end";
        } else {
          EXPECT_NEAR(below, 0.0, 0.01) << number << ": side " << side << " at " << along;
          EXPECT_GT(above, 0.5) << number << ": side " << side << " at " << along << " reaches higher";
        }
      }
    }
    // In order round the opening, counter-clockwise from above, with the first side along the bed and the yaw towards the cab.
    const Vector3d along = k.corners[0] - k.corners[1], across = k.corners[0] - k.corners[3];
    EXPECT_GT((k.corners[1] - k.corners[0]).cross(k.corners[2] - k.corners[1]).z(), 0.0);
    EXPECT_NEAR(std::remainder(std::atan2(along.y(), along.x()) - k.yaw, 2 * pi), 0.0, 1e-9);
    EXPECT_NEAR(along.norm(), k.inside_length, 1e-9);
    EXPECT_NEAR(across.norm(), k.inside_width, 1e-9);
    if (k.tailgate != "up") {  // the side walls end at the rear corners
      ++open_ends;
      const Vector3d back = -along.normalized();
      EXPECT_NEAR(met_beyond(walls, opening, k.corners[1] - 0.02 * back, -0.003), 0.0, 0.01);
      EXPECT_GT(met_beyond(walls, opening, k.corners[1] + 0.02 * back, -0.003), 50.0);
    }
  }
  EXPECT_EQ(seen.size(), classes.size());
  EXPECT_GT(open_ends, 2);
}

TEST(TruckWorldTruth, FillIsWhatLiesBetweenFloorAndSoil) {
  const auto classes = shipped_classes();
  std::set<std::string> fills;
  for (int number = 0; number < 16; ++number) {
    const Scene scene = draw_scene(classes, coarse(Content::truck), 41, number);
    const TruckTruth& k = scene.truth.of_truck;
    fills.insert(k.fill);
    const BoundingTree floor(
        part_of(scene, [](Surface s) { return s == Surface::bed_floor || s == Surface::wall_left || s == Surface::wall_right; }));
    const BoundingTree soil(part_of(scene, [](Surface s) { return s == Surface::load; }));
    const Opening opening(k.corners);
    const int along = 120, across = 60;
    double sum = 0.0;
    for (int i = 0; i < along; ++i) {
      for (int j = 0; j < across; ++j) {
        const double u = (i + 0.5) / along, v = (j + 0.5) / across;
        const Vector3d at = k.corners[1] + u * (k.corners[0] - k.corners[1]) + v * (k.corners[2] - k.corners[1]) + 2.0 * opening.up;
        const auto deep = floor.first(at, -opening.up, 10.0), top = soil.first(at, -opening.up, 10.0);
        if (deep && top) sum += std::max(0.0, deep->range - top->range);
      }
    }
    const double volume = sum * k.inside_length * k.inside_width / (along * across);
    // Mud on the walls takes room that the truth counts as soil, and a pipe of straight facets has less than a round one.
    EXPECT_NEAR(volume, k.fill_m3, 0.035 * k.struck_m3) << number << ' ' << k.truck_class << ' ' << k.fill;
    if (k.fill == "empty") {
      EXPECT_EQ(k.fill_m3, 0.0);
    }
    if (k.fill == "heaped") {
      EXPECT_GT(k.fill_m3, 0.6 * k.struck_m3);
    }
  }
  EXPECT_EQ(fills.size(), 4U);
}

TEST(TruckWorldTruth, TheEdgeIsHiddenAsDrawn) {
  const auto classes = shipped_classes();
  SceneOptions options = coarse(Content::truck);
  options.end_hidden_share = 0.15;
  std::set<std::string> occluders, walls;
  int occluded = 0;
  for (int number = 0; number < 60; ++number) {
    const Scene scene = draw_scene(classes, options, 51, number);
    const TruckTruth& k = scene.truth.of_truck;
    if (k.occluder.empty()) {
      EXPECT_LE(k.occluded_share, 0.021) << number;
      EXPECT_EQ(k.occluded_drawn, 0.0);
      continue;
    }
    ++occluded;
    occluders.insert(k.occluder);
    EXPECT_NEAR(k.occluded_share, k.occluded_drawn, 0.016) << number << ' ' << k.occluder;
    EXPECT_LE(k.occluded_share, 0.316) << number;
    EXPECT_GE(k.hidden_share, k.occluded_share - 0.08) << number;  // a return beside the occluder reaches 10 cm into its shadow
    if (k.wall_hidden.empty()) continue;
    walls.insert(k.wall_hidden);
    for (const PointTruth& p : scene.point_truth)
      EXPECT_FALSE(!p.outlier && name_of(p.surface) == k.wall_hidden) << number << " sample " << p.sample;
  }
  EXPECT_GT(occluded, 15);
  EXPECT_GE(occluders.size(), 2U);
  EXPECT_FALSE(walls.empty());
}

TEST(TruckWorldTruth, NoEndIsHiddenWholeWhereThatIsNotAskedFor) {
  const auto classes = shipped_classes();
  int occluded = 0;
  for (int number = 0; number < 40; ++number) {
    const Scene scene = draw_scene(classes, coarse(Content::truck), 51, number);
    const TruckTruth& k = scene.truth.of_truck;
    EXPECT_TRUE(k.wall_hidden.empty());
    occluded += k.occluder.empty() ? 0 : 1;
    const BoundingTree tree(scene.mesh);
    const std::vector<EdgePoint> edge = edge_points(k.corners, k.tailgate == "up");
    EXPECT_TRUE(every_end_in_sight(edge, hidden_points(tree, scene.sweep, edge))) << number << ' ' << k.occluder;
  }
  EXPECT_GT(occluded, 10);
}

TEST(TruckWorldTruth, AnEndIsInSightByHalfOfItsEdgeOrByOneSidesEnd) {
  const std::array<Vector3d, 4> corners{Vector3d(2.5, 1.2, 0), Vector3d(-2.5, 1.2, 0), Vector3d(-2.5, -1.2, 0), Vector3d(2.5, -1.2, 0)};
  const auto seen = [&](bool rear_wall, const auto& hides) {
    const std::vector<EdgePoint> edge = edge_points(corners, rear_wall);
    std::vector<bool> hidden;
    for (const EdgePoint& p : edge) hidden.push_back(hides(p.at));
    return every_end_in_sight(edge, hidden);
  };
  EXPECT_TRUE(seen(true, [](const Vector3d&) { return false; }));
  EXPECT_TRUE(seen(true, [](const Vector3d& p) { return p.x() > 2.4 && p.y() > 0.1; }));
  EXPECT_FALSE(seen(true, [](const Vector3d& p) { return p.x() > 2.4 && p.y() > -0.2; }));
  EXPECT_TRUE(seen(false, [](const Vector3d& p) { return p.x() < -2.2 && p.y() > 0.0; })) << "the other side's end is seen";
  EXPECT_FALSE(seen(false, [](const Vector3d& p) { return p.x() < -2.2; }));
}

TEST(TruckWorldTruth, WithoutOccludersNothingIsHiddenButByTheTruckItself) {
  SceneOptions options = coarse(Content::truck);
  options.hidden_max = 0.0;
  const auto classes = shipped_classes();
  for (int number = 0; number < 12; ++number) {
    const Scene scene = draw_scene(classes, options, 51, number);
    EXPECT_TRUE(scene.truth.of_truck.occluder.empty());
    EXPECT_LE(scene.truth.of_truck.occluded_share, 0.021) << number;
  }
}

TEST(TruckWorldTruth, HiddenShareAndReturnsAreThoseOfTheCloud) {
  SceneOptions options;
  options.content = Content::truck;
  const auto classes = shipped_classes();
  for (int number = 0; number < 3; ++number) {
    const Scene scene = draw_scene(classes, options, 61, number);
    const TruckTruth& k = scene.truth.of_truck;
    ASSERT_EQ(scene.cloud.size(), scene.point_truth.size());
    std::int64_t on_it = 0;
    for (const PointTruth& p : scene.point_truth) on_it += !p.outlier && is_truck(p.surface) ? 1 : 0;
    EXPECT_EQ(k.returns, on_it);
    EXPECT_GT(k.bed_returns, 100);
    // Every centimetre of the edge against every point of the cloud.
    std::int64_t bare = 0, all = 0;
    for (std::size_t side = 0; side < 4; ++side) {
      if (side == 1 && k.tailgate != "up") continue;
      const Vector3d &from = k.corners[side], &to = k.corners[(side + 1) % 4];
      const int steps = static_cast<int>((to - from).norm() / 0.02);
      for (int i = 0; i <= steps; ++i, ++all) {
        const Vector3d at = from + (to - from) * i / steps;
        bool shown = false;
        for (const app::ScanPoint& p : scene.cloud) shown = shown || (Vector3d(p.x, p.y, p.z) - at).norm() <= 0.10;
        bare += shown ? 0 : 1;
      }
    }
    EXPECT_NEAR(k.hidden_share, static_cast<double>(bare) / static_cast<double>(all), 0.02) << number;
  }
}

}  // namespace
}  // namespace berm::truck_world
