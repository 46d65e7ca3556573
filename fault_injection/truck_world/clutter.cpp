#include <cmath>

#include "truck_world/thing.hpp"

namespace berm::truck_world {
namespace {

constexpr Surface of_clutter = Surface::clutter;

Thing ridge(Random& random) {
  const double length = random.uniform(3.0, 8.0), height = random.uniform(0.4, 1.2), half_width = height / random.uniform(0.6, 0.9);
  Thing thing;
  const int columns = 14, rows = 8;
  const auto point = [&](int column, int row) {
    const double u = 2.0 * column / columns - 1.0, v = 2.0 * row / rows - 1.0;
    const double z = height * std::min(1.0, (1.0 - std::abs(u)) * length / 2 / half_width) * (1.0 - std::abs(v));
    return Vector3d(u * length / 2, v * half_width, z + (z > 0.0 ? random.uniform(-0.06, 0.06) : -0.1));
  };
  add_grid(thing.mesh, columns, rows, point, of_clutter);
  thing.half = {length / 2, half_width};
  return thing;
}

Thing heap(Random& random) {
  const double height = random.uniform(0.5, 1.8), radius = height / random.uniform(0.6, 0.9);
  Thing thing;
  std::vector<Vector2d> profile;
  for (int i = 0; i <= 6; ++i) profile.emplace_back(radius * i / 6.0, height * (1.0 - i / 6.0) - (i == 6 ? 0.1 : 0.0));
  add_turned(thing.mesh, profile, 14, of_clutter);
  thing.half = {radius, radius};
  return thing;
}

Thing loader(Random& random) {
  const double length = random.uniform(4.6, 5.6), width = random.uniform(2.2, 2.6), top = random.uniform(2.9, 3.3);
  Thing thing;
  Mesh& m = thing.mesh;
  add_box(m, {-length / 2, -width / 2 + 0.35, 0.7}, {length / 2 - 0.6, width / 2 - 0.35, 1.9}, of_clutter);
  add_box(m, {-0.6, -0.75, 1.9}, {0.8, 0.75, top}, of_clutter);
  for (const double x : {-length / 2 + 0.9, length / 2 - 1.2})
    for (const double y : {-width / 2 + 0.25, width / 2 - 0.25}) add_wheel(m, {x, y, 0.7}, 0.7, 0.5, of_clutter);
  for (const double y : {-0.5, 0.5}) add_box(m, {length / 2 - 0.6, y - 0.1, 0.7}, {length / 2 + 1.0, y + 0.1, 1.2}, of_clutter);
  // The bucket, open to the front and above.
  const double rear = length / 2 + 1.0, front = rear + random.uniform(0.9, 1.2);
  add_box(m, {rear, -width / 2, 0.15}, {rear + 0.08, width / 2, 1.2}, of_clutter);
  add_box(m, {rear, -width / 2, 0.15}, {front, width / 2, 0.23}, of_clutter);
  for (const double y : {-width / 2, width / 2 - 0.06}) add_box(m, {rear, y, 0.15}, {front - 0.2, y + 0.06, 1.0}, of_clutter);
  thing.half = {front, width / 2};
  return thing;
}

Thing container(Random& random) {  // ISO 668: 20 and 10 feet, closed
  const double length = chance(random, 0.6) ? 6.06 : 2.99;
  Thing thing;
  add_box(thing.mesh, {-length / 2, -1.22, 0.05}, {length / 2, 1.22, 2.64}, of_clutter);
  thing.half = {length / 2, 1.22};
  return thing;
}

Thing pickup(Random& random) {
  const double length = random.uniform(5.0, 5.5), bed = random.uniform(1.4, 1.8), y = 0.9;
  Thing thing;
  Mesh& m = thing.mesh;
  const double rear = -length / 2, cab_rear = rear + bed + 0.1;
  add_box(m, {rear, -y, 0.4}, {length / 2, y, 0.7}, of_clutter);
  for (const double side : {-y, y - 0.08}) add_box(m, {rear, side, 0.7}, {cab_rear, side + 0.08, 1.2}, of_clutter);
  add_box(m, {rear, -y, 0.7}, {rear + 0.06, y, 1.2}, of_clutter);
  add_box(m, {cab_rear, -y, 0.7}, {cab_rear + 1.7, y, 1.8}, of_clutter);
  add_box(m, {cab_rear + 1.7, -y, 0.7}, {length / 2, y, 1.15}, of_clutter);
  for (const double x : {rear + 0.9, length / 2 - 0.9})
    for (const double side : {-y + 0.1, y - 0.1}) add_wheel(m, {x, side, 0.38}, 0.38, 0.25, of_clutter);
  thing.half = {length / 2, y};
  return thing;
}

Thing person(Random& random) {
  const double height = random.uniform(1.55, 1.95);
  const auto round = [](double radius) {
    std::vector<Vector2d> outline;
    for (int i = 0; i < 8; ++i) outline.emplace_back(radius * std::cos(pi * i / 4), radius * std::sin(pi * i / 4));
    return outline;
  };
  Thing thing;
  add_prism(thing.mesh, round(0.17), 0.0, 0.5 * height, of_clutter);
  add_prism(thing.mesh, round(0.25), 0.5 * height, 0.85 * height, of_clutter);
  add_prism(thing.mesh, round(0.11), 0.85 * height, height, of_clutter);
  thing.half = {0.3, 0.3};
  return thing;
}

Thing wall(Random& random) {
  const double length = random.uniform(3.0, 9.0), height = random.uniform(0.8, 2.6), half = random.uniform(0.08, 0.2);
  Thing thing;
  add_box(thing.mesh, {-length / 2, -half, -0.3}, {length / 2, half, height}, of_clutter);
  thing.half = {length / 2, half};
  return thing;
}

}  // namespace

Thing draw_clutter(std::size_t kind, Random& random) {
  using Draw = Thing (*)(Random&);
  constexpr std::array<Draw, clutter_names.size()> draws{ridge, heap, loader, container, pickup, person, wall};
  Thing thing = draws.at(kind)(random);
  thing.name = clutter_names[kind];
  return thing;
}

}  // namespace berm::truck_world
