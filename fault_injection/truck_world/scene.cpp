#include "truck_world/scene.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "truck_world/occluder.hpp"
#include "truck_world/truck_placing.hpp"

namespace berm::truck_world {
namespace {

constexpr std::size_t clutter_most = 6;
constexpr int clutter_places = 20;        // tried for each piece
constexpr double clutter_reach = 14.0;    // m round the place
constexpr double occluded_least = 0.03;   // drawn share of the edge
constexpr double edge_occluded_share = 0.60;  // of the scenes with a truck

struct Assembly {
  const std::vector<TruckClass>& classes;
  const SceneOptions& options;
  std::uint64_t seed;
  int number;
  Scene scene;
  std::vector<GroundRectangle> taken;  // by what stands already

  [[nodiscard]] Random own(Stream subject, int attempt = 0) const { return stream(seed, number, subject, attempt); }
};

// Points on both faces and the top of a wall that bounds the bed at its front or rear.
std::vector<Vector3d> wall_points(const PlacedTruck& truck, Surface wall) {
  const TruckBody& b = truck.body;
  const double sense = wall == Surface::wall_front ? 1.0 : -1.0, y_end = b.outer_width() / 2;
  std::vector<Vector3d> points;
  for (const double x : {b.length / 2 - b.mud, b.length / 2 + b.wall_thickness + b.mud})
    for (int i = 0; i <= 30; ++i)
      for (int k = 0; k <= 8; ++k)
        points.push_back(truck.pose * Vector3d(sense * x, y_end * (i / 15.0 - 1.0), b.floor_height + b.wall_height * k / 8.0));
  return points;
}

void occlude(Assembly& a, const PlacedTruck& truck) {
  Random random = a.own(Stream::occluder);
  const double kind = random.uniform(), share_drawn = random.uniform(std::min(occluded_least, a.options.hidden_max), a.options.hidden_max);
  const bool front = truck.body.tailgate != Tailgate::up || chance(random, 0.5);
  if (a.options.hidden_max <= 0.0 || kind >= std::max(edge_occluded_share, a.options.end_hidden_share)) return;
  const std::vector<Vector2d> outline = truck.standing.outline(0.1);
  const OcclusionTask task{truck.sweep, truck.ground, truck.edge, truck.hidden, outline};
  TruckTruth& truth = a.scene.truth.of_truck;
  std::optional<Occluder> o;
  if (kind < a.options.end_hidden_share) {
    const Surface wall = front ? Surface::wall_front : Surface::wall_rear;
    o = draw_wall_occluder(task, wall_points(truck, wall), a.options.hidden_max, random);
    if (o) truth.wall_hidden = name_of(wall);
    if (o) truth.occluded_drawn = o->share;
  } else {
    o = draw_occluder(task, share_drawn, random);
    if (o) truth.occluded_drawn = share_drawn;
  }
  if (!o) return;
  truth.occluder = name_of(o->kind);
  add_placed(a.scene.mesh, o->mesh, Eigen::Isometry3d::Identity());
  a.taken.push_back({o->place, 0.0, {o->radius, o->radius}});
}

// Clutter never hides the opening's edge: what hides it is drawn by occlude, so that its share is known.
void add_clutter(Assembly& a, const SiteGround& ground, const PlacedTruck* truck) {
  Random random = a.own(Stream::clutter);
  const std::size_t count = below(random, clutter_most + 1);
  for (std::size_t piece = 0; piece < count; ++piece) {
    const Thing thing = draw_clutter(below(random, clutter_names.size()), random);
    for (int i = 0; i < clutter_places; ++i) {
      const double distance = random.uniform(0.0, clutter_reach), bearing = random.uniform(-pi, pi);
      GroundRectangle r;
      r.centre = ground.place + distance * Vector2d(std::cos(bearing), std::sin(bearing));
      r.yaw = random.uniform(-pi, pi);
      r.half = thing.half;
      const bool free = r.distance(Vector2d::Zero()) > machine_clear + 0.4 &&
                        std::all_of(a.taken.begin(), a.taken.end(), [&](const GroundRectangle& other) { return apart(r, other, 0.3); });
      if (!free) continue;
      Mesh placed;
      add_placed(placed, thing.mesh, placed_at({r.centre.x(), r.centre.y(), ground.height(r.centre)}, r.yaw));
      if (truck != nullptr) {
        const std::vector<bool> hidden = hidden_points(BoundingTree(placed), truck->sweep, truck->edge);
        if (std::find(hidden.begin(), hidden.end(), true) != hidden.end()) continue;
      }
      add_placed(a.scene.mesh, placed, Eigen::Isometry3d::Identity());
      a.taken.push_back(r);
      a.scene.truth.clutter.push_back(thing.name);
      break;
    }
  }
}

void say_place(SceneTruth& truth, const SitePlace& place) {
  truth.place = place.at;
  truth.drop = place.drop;
}

PlacedTruck with_truck(Assembly& a) {
  PlacedTruck truck = place_truck(a.classes, a.options, a.seed, a.number);
  SceneTruth& t = a.scene.truth;
  TruckTruth& k = t.of_truck;
  t.truck = true;
  say_place(t, truck.place);
  k.truck_class = a.classes[truck.truck_class].name;
  k.corners = truck.corners;
  k.yaw = truck.place.yaw;
  k.pitch = truck.pitch;
  k.roll = truck.roll;
  k.inside_length = truck.body.length;
  k.inside_width = truck.body.width;
  k.wall_height = truck.body.wall_height;
  k.wall_thickness = truck.body.wall_thickness;
  k.floor_height = truck.body.floor_height;
  k.struck_m3 = truck.body.struck_volume();
  k.tailgate = name_of(truck.body.tailgate);
  k.fill = name_of(truck.load.fill());
  k.fill_m3 = truck.load.volume_m3();
  k.canopy = truck.body.canopy;
  k.mud = truck.body.mud;
  a.scene.sweep = truck.sweep;
  add_placed(a.scene.mesh, truck.mesh, Eigen::Isometry3d::Identity());
  a.taken.push_back(truck.standing);
  occlude(a, truck);
  Random ground = a.own(Stream::ground);
  add_placed(a.scene.mesh, truck.ground.mesh(ground), Eigen::Isometry3d::Identity());
  add_clutter(a, truck.ground, &truck);
  return truck;
}

void without_truck(Assembly& a, bool look_alike, bool bare) {
  SceneTruth& t = a.scene.truth;
  for (int attempt = 0; attempt < 1000; ++attempt) {
    Random random = a.own(Stream::place, attempt), kinds = a.own(Stream::look_alike, attempt), sweep = a.own(Stream::sweep, attempt);
    const SitePlace place = draw_place(random);
    const double roughness = random.uniform(0.005, 0.04);
    DrawnLookAlike drawn;
    drawn.thing.half = {2.0, 1.0};
    if (look_alike) drawn = draw_look_alike(static_cast<LookAlike>(below(kinds, look_alike_names.size())), a.classes, kinds);
    const GroundRectangle standing{place.at, place.yaw, drawn.thing.half};
    const SiteGround ground = ground_before(place, standing, roughness);
    const bool beyond_toe = place.at.normalized().dot(place.at) >= ground.toe;
    if (standing.distance(Vector2d::Zero()) < machine_clear || !beyond_toe) continue;
    say_place(t, place);
    a.scene.sweep = draw_sweep(a.options.lidar, a.options.samples, place.at, a.options.swinging_share, sweep);
    if (look_alike) {
      t.look_alike = name_of(drawn.kind);
      t.look_alike_box = drawn.box;
      t.no_truck = drawn.because;
      const double tilt_x = std::atan(place.gradient.dot(Vector2d(std::cos(place.yaw), std::sin(place.yaw))));
      const double tilt_y = std::atan(place.gradient.dot(Vector2d(-std::sin(place.yaw), std::cos(place.yaw))));
      add_placed(a.scene.mesh, drawn.thing.mesh, placed_at({place.at.x(), place.at.y(), -place.drop}, place.yaw, -tilt_x, tilt_y));
      a.taken.push_back(standing);
    }
    Random ground_random = a.own(Stream::ground);
    add_placed(a.scene.mesh, ground.mesh(ground_random, drawn.hole, place.yaw), Eigen::Isometry3d::Identity());
    if (!bare) add_clutter(a, ground, nullptr);
    return;
  }
  throw std::runtime_error("scene " + std::to_string(a.number) + ": nothing fits the site");
}

}  // namespace

Scene draw_scene(const std::vector<TruckClass>& classes, const SceneOptions& options, std::uint64_t seed, int number) {
  Assembly a{classes, options, seed, number, {}, {}};
  SceneTruth& t = a.scene.truth;
  t.seed = seed;
  t.scene = number;
  Random content = a.own(Stream::content);
  const bool truck_drawn = chance(content, 0.5), look_alike = chance(content, 0.5), bare = chance(content, 0.15);
  const bool truck = options.content == Content::truck || (options.content == Content::either && truck_drawn);
  std::vector<EdgePoint> edge;
  if (truck) {
    edge = with_truck(a).edge;
  } else {
    without_truck(a, look_alike, bare);
  }
  const Sweep& sweep = a.scene.sweep;
  const BoundingTree tree(a.scene.mesh);
  Random noise = a.own(Stream::noise);
  take_sweep(sweep, options.noise, a.scene.mesh, tree, noise, a.scene.cloud, a.scene.point_truth);

  t.sensor = sweep.sensor;
  t.viewpoint = sweep.head_at(sweep.duration() / 2);
  t.swing_begin = sweep.swing_begin;
  t.swing_rate = sweep.swing_rate;
  t.time_begin = sweep.time_begin;
  t.duration = sweep.duration();
  t.samples = sweep.samples;
  t.returns = static_cast<std::int64_t>(a.scene.cloud.size());
  for (const PointTruth& p : a.scene.point_truth) {
    t.outliers += p.outlier ? 1 : 0;
    if (p.outlier || !is_truck(p.surface)) continue;
    ++t.of_truck.returns;
    t.of_truck.bed_returns += p.surface != Surface::truck_body ? 1 : 0;
  }
  if (truck) {
    t.of_truck.occluded_share = share(hidden_points(tree, sweep, edge));
    t.of_truck.hidden_share = share(points_without_return(a.scene.cloud, edge));
  }
  return std::move(a.scene);
}

}  // namespace berm::truck_world
