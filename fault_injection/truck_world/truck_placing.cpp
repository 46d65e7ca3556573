#include "truck_world/truck_placing.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace berm::truck_world {
namespace {

constexpr double azimuth_low = 0.45, azimuth_high = 2.0;  // rad from the dig face to either side
constexpr int attempts = 2000;

std::optional<PlacedTruck> try_truck(const std::vector<TruckClass>& classes, const SceneOptions& options, std::uint64_t seed, int number,
                                     int attempt) {
  const auto own = [&](Stream subject) { return stream(seed, number, subject, attempt); };
  Random random = own(Stream::place), body_random = own(Stream::body);
  const std::size_t which = below(body_random, classes.size());
  const TruckBody body = draw_truck_body(classes[which], body_random);
  const SitePlace place = draw_place(random);
  const double settled_pitch = random.uniform(-0.015, 0.015), settled_roll = random.uniform(-0.02, 0.02), roughness = random.uniform(0.005, 0.04);

  GroundRectangle standing;
  standing.yaw = place.yaw;
  const double rear = -body.length / 2 - body.wall_thickness - 0.15;
  standing.half = {(body.front() - rear) / 2, body.outer_width() / 2};
  standing.centre = place.at + Eigen::Rotation2Dd(place.yaw) * Vector2d((body.front() + rear) / 2, 0.0);
  if (standing.distance(Vector2d::Zero()) < machine_clear) return std::nullopt;

  const SiteGround ground = ground_before(place, standing, roughness);
  for (const Vector2d& p : standing.outline(0.2))
    if (p.dot(place.at.normalized()) < ground.toe + 0.2) return std::nullopt;

  const Vector2d ahead(std::cos(place.yaw), std::sin(place.yaw)), left(-ahead.y(), ahead.x());
  const double pitch = settled_pitch - std::atan(place.gradient.dot(ahead)), roll = settled_roll + std::atan(place.gradient.dot(left));
  if (std::max(std::abs(pitch), std::abs(roll)) > tilt_most) return std::nullopt;
  const Eigen::Isometry3d pose = placed_at({place.at.x(), place.at.y(), -place.drop}, place.yaw, pitch, roll);

  std::array<Vector3d, 4> corners = opening_corners(body);
  for (Vector3d& corner : corners) corner = pose * corner;
  Random sweep_random = own(Stream::sweep);
  const Sweep sweep = draw_sweep(options.lidar, options.samples, place.at, options.swinging_share, sweep_random);
  for (const Vector3d& corner : corners)
    if (sweep.head.z() < corner.z() + look_down_least || !sweep.passes(corner, 0.04)) return std::nullopt;

  Random load_random = own(Stream::load), mud = own(Stream::mud);
  const Fill fill = static_cast<Fill>(below(load_random, fill_names.size()));
  PlacedTruck truck{which, body, BedLoad(body, fill, load_random), place, ground, standing, pose, pitch, roll, sweep, {}, corners, {}, {}};
  add_placed(truck.mesh, truck_mesh(body, mud), pose);
  add_placed(truck.mesh, truck.load.mesh(), pose);
  truck.edge = edge_points(corners, body.tailgate == Tailgate::up);
  truck.hidden = hidden_points(BoundingTree(truck.mesh), sweep, truck.edge);
  if (share(truck.hidden) > own_hidden_most) return std::nullopt;
  return truck;
}

}  // namespace

SitePlace draw_place(Random& random) {
  SitePlace p;
  const double side = chance(random, 0.5) ? 1.0 : -1.0;
  const double distance = random.uniform(place_near, place_far), azimuth = side * random.uniform(azimuth_low, azimuth_high);
  p.at = {distance * std::cos(azimuth), distance * std::sin(azimuth)};
  p.yaw = random.uniform(-pi, pi);
  p.drop = chance(random, 0.2) ? 0.0 : random.uniform(0.0, drop_most);
  const double slope = random.uniform(0.0, 0.05), downhill = random.uniform(-pi, pi);
  p.gradient = slope * Vector2d(std::cos(downhill), std::sin(downhill));
  return p;
}

SiteGround ground_before(const SitePlace& place, const GroundRectangle& standing, double roughness) {
  SiteGround g;
  g.place = place.at;
  g.drop = place.drop;
  g.gradient = place.gradient;
  g.roughness = roughness;
  const Vector2d towards = place.at.normalized();
  double nearest = place.at.norm();
  for (const Vector2d& p : standing.outline(0.2)) nearest = std::min(nearest, p.dot(towards));
  g.toe = std::max(1.6, nearest - 0.3);
  g.crest = std::max(0.8, g.toe - std::max(0.5, 0.35 * place.drop));
  return g;
}

PlacedTruck place_truck(const std::vector<TruckClass>& classes, const SceneOptions& options, std::uint64_t seed, int number) {
  for (int attempt = 0; attempt < attempts; ++attempt)
    if (auto truck = try_truck(classes, options, seed, number, attempt)) return *std::move(truck);
  throw std::runtime_error("scene " + std::to_string(number) + ": no truck of these classes fits the site within " + std::to_string(attempts) +
                           " draws");
}

}  // namespace berm::truck_world
