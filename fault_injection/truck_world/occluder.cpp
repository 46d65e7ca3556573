#include "truck_world/occluder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace berm::truck_world {
namespace {

constexpr int places = 24;                                // tried for one occluder
constexpr double arm_width_low = 0.15, arm_width_high = 2.2, arm_depth = 0.45;  // m; from a stick's to a bucket's across, and half as much again
constexpr double heap_slope = 0.95, heap_high = 4.5;      // tangent; m
constexpr double clear = 0.25;                            // m between occluder and truck
constexpr double foreign_from = 4.2;                      // m from the swing axis: nearer it can only be the machine's own

// A line of sight to the truck on which an occluder may stand.
struct Sight {
  Vector3d head;
  Vector2d along;    // unit
  double free = 0.0; // m up to the truck
};

Sight sight_to(const OcclusionTask& task, const Vector3d& target) {
  Sight sight;
  sight.head = task.sweep.head_seeing(target);
  const Vector2d from = sight.head.head<2>(), way = target.head<2>() - from;
  sight.along = way.normalized();
  sight.free = way.norm();
  for (const Vector2d& p : task.outline) sight.free = std::min(sight.free, (p - from).norm());
  sight.free -= clear;
  return sight;
}

Occluder arm(const OcclusionTask& task, const Sight& sight, double distance, double width) {
  Occluder o;
  o.place = sight.head.head<2>() + distance * sight.along;
  o.radius = std::hypot(width, arm_depth) / 2;
  o.kind = o.place.norm() - o.radius < foreign_from ? OccluderKind::own_arm : OccluderKind::foreign_arm;
  const Surface surface = o.kind == OccluderKind::own_arm ? Surface::own_arm : Surface::occluder;
  Mesh box;
  const double low = task.ground.height(o.place) + 0.1;
  add_box(box, {-arm_depth / 2, -width / 2, low}, {arm_depth / 2, width / 2, sight.head.z() + 1.0}, surface);
  add_placed(o.mesh, box, placed_at({o.place.x(), o.place.y(), 0.0}, std::atan2(sight.along.y(), sight.along.x())));
  return o;
}

Occluder heap(const OcclusionTask& task, const Vector2d& place, double height) {
  Occluder o;
  o.kind = OccluderKind::heap;
  o.place = place;
  o.radius = height / heap_slope;
  Mesh round;
  add_turned(round, {{0.0, height}, {o.radius * 0.15, height * 0.9}, {o.radius * 0.6, height * 0.42}, {o.radius, -0.2}}, 16, Surface::occluder);
  add_placed(o.mesh, round, placed_at({place.x(), place.y(), task.ground.height(place)}, 0.0));
  return o;
}

std::vector<bool> hidden_with(const OcclusionTask& task, const Mesh& mesh) {
  const BoundingTree tree(mesh);
  std::vector<bool> hidden = task.hidden;
  for (std::size_t i = 0; i < task.edge.size(); ++i) hidden[i] = hidden[i] || hides(tree, task.sweep, task.edge[i].at);
  return hidden;
}

double share_with(const OcclusionTask& task, const Mesh& mesh) { return share(hidden_with(task, mesh)); }

// The smallest size between low and high with enough(size), which must hold at high and for all above any at which it holds.
template <typename Enough>
double least_size(double low, double high, const Enough& enough) {
  for (int i = 0; i < 10; ++i) {
    const double middle = (low + high) / 2;
    (enough(middle) ? high : low) = middle;
  }
  return high;
}

template <typename Make>
std::optional<Occluder> sized(const OcclusionTask& task, double share, double low, double high, const Make& make) {
  if (high <= low || share_with(task, make(high).mesh) < share || share_with(task, make(low).mesh) > share) return std::nullopt;
  Occluder o = make(least_size(low, high, [&](double size) { return share_with(task, make(size).mesh) >= share; }));
  o.share = share_with(task, o.mesh);
  if (std::abs(o.share - share) > occlusion_tolerance) return std::nullopt;
  return o;
}

}  // namespace

std::optional<Occluder> draw_occluder(const OcclusionTask& task, double share, Random& random) {
  const bool heap_first = chance(random, 0.5);
  for (int i = 0; i < places; ++i) {
    const Sight sight = sight_to(task, task.edge[below(random, task.edge.size())].at);
    const double part = random.uniform(0.35, 0.8), distance = part * sight.free;
    if (sight.free < 1.2) continue;
    std::optional<Occluder> o;
    if (heap_first && i < places / 2) {
      const Vector2d place = sight.head.head<2>() + distance * sight.along;
      const double room = std::min(sight.free - distance, place.norm() - own_radius);
      const auto make = [&](double height) { return heap(task, place, height); };
      o = sized(task, share, 0.3, std::min(heap_high, room * heap_slope), make);
    } else {
      const auto make = [&](double width) { return arm(task, sight, distance, width); };
      o = sized(task, share, arm_width_low, std::min(arm_width_high, 1.5 * distance), make);
    }
    if (o && every_end_in_sight(task.edge, hidden_with(task, o->mesh))) return o;
  }
  return std::nullopt;
}

std::optional<Occluder> draw_wall_occluder(const OcclusionTask& task, const std::vector<Vector3d>& wall, double share_max, Random& random) {
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : wall) middle += p / static_cast<double>(wall.size());
  const Sight sight = sight_to(task, middle);
  for (int i = 0; i < places / 2 && sight.free > 1.2; ++i) {
    const double distance = random.uniform(0.35, 0.8) * sight.free;
    const auto hides_all = [&](double width) {
      const BoundingTree tree(arm(task, sight, distance, width).mesh);
      return std::all_of(wall.begin(), wall.end(), [&](const Vector3d& p) { return hides(tree, task.sweep, p); });
    };
    if (!hides_all(arm_width_high)) continue;
    // A little more than needed: the noise of the range does not turn round a corner, but a head between two scanlines does.
    Occluder o = arm(task, sight, distance, least_size(arm_width_low, arm_width_high, hides_all) + 0.06);
    o.share = share_with(task, o.mesh);
    if (o.share <= share_max) return o;
  }
  return std::nullopt;
}

}  // namespace berm::truck_world
