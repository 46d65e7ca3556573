#include "plant/world/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ranges>

namespace berm::plant {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

Vec3 point(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }

void nearer(std::optional<double> hit, double& range) {
  if (hit && *hit < range) range = *hit;
}

constexpr double rounding_m = 1e-6;  // more than the sums' rounding: what a ray only just touches is not left out

RayFan in(const PlanarFrame& frame, const RayFan& fan) {
  return {frame.in(fan.origin), frame.in(Ray{fan.origin, fan.ahead}).direction, frame.in(Ray{fan.origin, fan.aside}).direction, fan.spread};
}

// Whether the box reaches into the wedge that holds the fan. What cannot be told counts as met.
bool may_meet(const RayFan& fan, const Vec3& low, const Vec3& high) {
  const Vec3 from = 0.5 * (low + high) - fan.origin, half = 0.5 * (high - low);
  const auto extent = [&half](const Vec3& n) { return half.x * std::abs(n.x) + half.y * std::abs(n.y) + half.z * std::abs(n.z); };
  const double farthest = std::abs(from.x) + std::abs(from.y) + std::abs(from.z) + half.x + half.y + half.z;
  const bool behind = dot(from, fan.ahead) + extent(fan.ahead) < -rounding_m;
  const bool beside = std::abs(dot(from, fan.aside)) - extent(fan.aside) > fan.spread * farthest + rounding_m;
  return !behind && !beside;
}

BoxSolid box_round(const CylinderSolid& p) {
  return {PlanarFrame(), {p.x - p.radius, p.y - p.radius, p.z_low}, {p.x + p.radius, p.y + p.radius, p.z_high}};
}

}  // namespace

void Scene::place_site(const Terrain& terrain, const std::vector<Truck>& trucks, const Movers& movers, const std::vector<BoxConfig>& boxes) {
  terrain_ = &terrain;
  ground_changes_ = terrain.grid().newest_change().number;
  truck_.clear();
  for (const Truck& t : trucks) {
    if (!t.present()) continue;
    TruckSolid s;
    s.frame = t.frame();
    s.low = t.hull().low;
    s.high = {t.hull().high.x, t.hull().high.y, std::max(t.hull().high.z, t.heap().grid().highest())};
    for (const TruckPart& p : t.parts()) s.part.push_back({t.frame(), p.low, p.high});
    s.heap = &t.heap();
    s.heap_changes = t.heap().grid().newest_change().number;
    truck_.push_back(std::move(s));
  }
  box_.clear();
  box_mover_.assign(boxes.size(), no_mover);
  for (const BoxConfig& b : boxes) {
    box_.push_back({PlanarFrame(b.x, b.y, 0, b.yaw), {-b.length / 2, -b.width / 2, b.z_low}, {b.length / 2, b.width / 2, b.z_high}});
  }
  person_.clear();
  person_mover_.clear();
  for (size_t i = 0; i < movers.count(); ++i) {
    if (!movers.present(i)) continue;
    const MoverConfig& c = movers.config(i);
    const MoverPose& p = movers.pose(i);
    if (c.vehicle) {
      box_.push_back({PlanarFrame(p.x, p.y, p.z, p.yaw), {-c.length / 2, -c.width / 2, 0}, {c.length / 2, c.width / 2, c.height}});
      box_mover_.push_back(static_cast<int>(i));
    } else {
      person_.push_back({p.x, p.y, p.z, p.z + c.height, c.radius});
      person_mover_.push_back(static_cast<int>(i));
    }
  }
}

void Scene::place_machine(const ImplementShape& shape, const LinkFrames& links, double heap_volume) {
  implement_.clear();
  const auto add = [this](const std::vector<SwingPlanePoint>& outline, double half_width) {
    implement_.emplace_back(outline, half_width);
    const PrismSolid& s = implement_.back();
    implement_low_ = {std::min(implement_low_.x, s.low().x), std::min(implement_low_.y, s.low().y), std::min(implement_low_.z, s.low().z)};
    implement_high_ = {std::max(implement_high_.x, s.high().x), std::max(implement_high_.y, s.high().y), std::max(implement_high_.z, s.high().z)};
  };
  implement_low_ = {inf, inf, inf};
  implement_high_ = {-inf, -inf, -inf};
  for (const SolidPart& part : shape.parts) {
    std::vector<SwingPlanePoint> outline;
    for (const OutlinePoint& p : part.outline) outline.push_back(links.link[static_cast<size_t>(part.link)].out(p.x, p.z));
    add(outline, part.half_width);
  }
  if (heap_volume > 1e-3 && shape.bucket_half_width > 0) {
    // A triangular heap over the mouth, as high as its volume asks.
    const double base = 0.85 * shape.bucket, height = heap_volume / (shape.bucket_half_width * base);
    const LinkFrame& b = links.link[3];
    add({b.out(0.10 * shape.bucket, -height), b.out(0.95 * shape.bucket, 0), b.out(0.10 * shape.bucket, 0)}, shape.bucket_half_width);
  }
  upper_body_.clear();
  for (const AxisBox& b : shape.upper_body) upper_body_.push_back({PlanarFrame(), point(b.low), point(b.high)});
  track_.clear();
  for (const AxisBox& b : shape.tracks) track_.push_back({PlanarFrame(), point(b.low), point(b.high)});
}

double Scene::cast_truck(const TruckSolid& truck, const Ray& world, double range) const {
  const Ray local = truck.frame.in(world);
  if (!cast_box(local, truck.low, truck.high, range)) return range;
  for (const BoxSolid& p : truck.part) nearer(cast_box(local, p.low, p.high, range), range);
  nearer(truck.heap->grid().cast(local, range), range);
  return range;
}

// The step up from a map's rim to the level beyond, for a ray from inside that leaves the map under that level.
double Scene::cast_step_at_rim(const Ray& world, double range) const {
  const HeightGrid& g = terrain_->grid();
  if (!g.contains(world.origin.x, world.origin.y)) return range;
  const auto leaves = [](double from, double per_m, double low, double high) { return per_m > 0 ? (high - from) / per_m : per_m < 0 ? (low - from) / per_m : inf; };
  const double t = std::min(leaves(world.origin.x, world.direction.x, g.x_low(), g.x_low() + g.count_x() * g.cell_x()),
                            leaves(world.origin.y, world.direction.y, g.y_low(), g.y_low() + g.count_y() * g.cell_y()));
  return t < range && world.at(t).z < terrain_->levels_beyond().front() ? t : range;
}

// The ground outside the map: the two levels, and the slopes between them taken as steps.
double Scene::cast_beyond(const Ray& world, double range) const {
  if (world.direction.z >= 0) return range;
  const HeightGrid& g = terrain_->grid();
  const double z_at_range = world.origin.z + range * world.direction.z;
  for (const double level : terrain_->levels_beyond()) {
    if (z_at_range > level + rounding_m) continue;  // met before it comes so low
    const double t = (level - world.origin.z) / world.direction.z;
    if (t <= 0 || t >= range) continue;
    const Vec3 p = world.at(t);
    if (!g.contains(p.x, p.y) && level >= terrain_->as_built(p.x, p.y) - 1e-9) range = t;
  }
  return range;
}

std::optional<double> Scene::cast(const Ray& world, const Ray& base, const Ray& upper, double range_max) const {
  const std::optional<SceneHit> hit = meet(world, base, upper, range_max);
  return hit ? std::optional<double>(hit->range) : std::nullopt;
}

// of: which of each kind the ray is held against.
template <class Indices>
std::optional<SceneHit> Scene::first(const Indices& of, const Ray& world, const Ray& base, const Ray& upper, double range_max) const {
  double range = range_max, nearest_mover = range_max;
  int mover = no_mover;
  if (of.implement && cast_box(upper, implement_low_, implement_high_, range)) {
    for (const PrismSolid& s : implement_) nearer(s.cast(upper, range), range);
  }
  for (const std::size_t i : of.upper_body) nearer(cast_box(upper, upper_body_[i].low, upper_body_[i].high, range), range);
  for (const std::size_t i : of.track) nearer(cast_box(base, track_[i].low, track_[i].high, range), range);
  for (const std::size_t i : of.truck) range = cast_truck(truck_[i], world, range);
  const auto against = [&](const auto& solid, int which) {
    const double before = range;
    nearer(solid.cast(world, range), range);
    if (range >= before || which == no_mover) return;
    mover = which;
    nearest_mover = range;
  };
  for (const std::size_t i : of.box) against(box_[i], box_mover_[i]);
  for (const std::size_t i : of.person) against(person_[i], person_mover_[i]);
  if (terrain_ != nullptr) {
    nearer(terrain_->grid().cast(world, range), range);
    range = cast_beyond(world, range);
    if (terrain_->measured()) range = cast_step_at_rim(world, range);
  }
  if (range >= range_max) return std::nullopt;
  return SceneHit{range, range < nearest_mover ? no_mover : mover};
}

std::optional<SceneHit> Scene::meet(const Ray& world, const Ray& base, const Ray& upper, double range_max) const {
  struct All {
    bool implement = true;
    std::ranges::iota_view<std::size_t, std::size_t> upper_body, track, truck, box, person;
  };
  const auto every = [](const auto& of) { return std::views::iota(std::size_t{0}, of.size()); };
  return first(All{true, every(upper_body_), every(track_), every(truck_), every(box_), every(person_)}, world, base, upper, range_max);
}

std::optional<SceneHit> Scene::meet(const FanView& view, const Ray& world, const Ray& base, const Ray& upper, double range_max) const {
  return first(view, world, base, upper, range_max);
}

bool Scene::look(const RayFan& world, const RayFan& base, const RayFan& upper, FanView& view) const {
  if (std::max({upper_body_.size(), track_.size(), truck_.size(), box_.size(), person_.size()}) > FanView::most) return false;
  view.implement = !implement_.empty() && may_meet(upper, implement_low_, implement_high_);
  const auto choose = [](FanView::Few& few, const auto& of, const auto& may) {
    few.count = 0;
    for (std::size_t i = 0; i < of.size(); ++i)
      if (may(of[i])) few.add(i);
  };
  choose(view.upper_body, upper_body_, [&](const BoxSolid& b) { return may_meet(upper, b.low, b.high); });
  choose(view.track, track_, [&](const BoxSolid& b) { return may_meet(base, b.low, b.high); });
  choose(view.truck, truck_, [&](const TruckSolid& t) { return may_meet(in(t.frame, world), t.low, t.high); });
  choose(view.box, box_, [&](const BoxSolid& b) { return may_meet(in(b.frame, world), b.low, b.high); });
  choose(view.person, person_, [&](const CylinderSolid& p) { return may_meet(world, box_round(p).low, box_round(p).high); });
  return true;
}

SceneDifference Scene::difference(const Scene& before) const {
  constexpr double deep = -100.0;  // lower than any ground
  SceneDifference d;
  const HeightChange& ground = terrain_->grid().newest_change();
  const bool others = truck_.size() != before.truck_.size() || box_mover_ != before.box_mover_ || person_mover_ != before.person_mover_ ||
                      upper_body_ != before.upper_body_ || track_ != before.track_;
  const bool unknown = terrain_ != before.terrain_ || ground_changes_ != ground.number || ground_changes_ - before.ground_changes_ > 1;
  d.everywhere = others || unknown || (ground_changes_ != before.ground_changes_ && ground.highest);
  if (d.everywhere) return d;
  if (ground_changes_ != before.ground_changes_)
    d.site.push_back({PlanarFrame(), {ground.x_low, ground.y_low, deep}, {ground.x_high, ground.y_high, terrain_->grid().highest()}});
  const auto compare = [&d](const auto& now, const auto& then, const auto& box) {
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (now[i] == then[i]) continue;
      d.site.push_back(box(now[i]));
      d.site.push_back(box(then[i]));
    }
  };
  compare(truck_, before.truck_, [](const TruckSolid& t) { return BoxSolid{t.frame, t.low, t.high}; });
  compare(box_, before.box_, [](const BoxSolid& b) { return b; });
  compare(person_, before.person_, [](const CylinderSolid& p) { return box_round(p); });
  if (implement_ != before.implement_)
    d.machine = {{PlanarFrame(), implement_low_, implement_high_}, {PlanarFrame(), before.implement_low_, before.implement_high_}};
  return d;
}

bool SceneDifference::may_be_met(const RayFan& world, const RayFan& upper) const {
  const auto met_by = [](const RayFan& fan) { return [&fan](const BoxSolid& b) { return may_meet(in(b.frame, fan), b.low, b.high); }; };
  return everywhere || std::any_of(site.begin(), site.end(), met_by(world)) || std::any_of(machine.begin(), machine.end(), met_by(upper));
}

void note(const SceneHit& hit, const Ray& world, std::vector<MoverReturn>* returns) {
  if (returns == nullptr || hit.mover == no_mover) return;
  const Vec3 at = world.at(hit.range);
  returns->push_back({static_cast<size_t>(hit.mover), at.x, at.y, at.z});
}

}  // namespace berm::plant
