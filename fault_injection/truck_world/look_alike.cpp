#include <cmath>
#include <stdexcept>

#include "truck_world/thing.hpp"

namespace berm::truck_world {
namespace {

constexpr Surface of_look_alike = Surface::look_alike;

// An open box of drawn inside sizes that is outside every class.
OpenBox outside_box(LookAlike kind, const std::vector<TruckClass>& classes, Random& random, const Range& length, const Range& width,
                    const Range& height) {
  for (int attempt = 0; attempt < 1000; ++attempt) {
    const OpenBox box{random.uniform(length[0], length[1]), random.uniform(width[0], width[1]), random.uniform(height[0], height[1])};
    if (outside_every_class(classes, box)) return box;
  }
  throw std::runtime_error("look-alike " + std::string(name_of(kind)) + ": the truck classes take in all sizes that it has");
}

void add_open_container(DrawnLookAlike& drawn, double thickness, double floor) {
  const OpenBox& b = drawn.box;
  add_open_box(drawn.thing.mesh, b.length, b.width, floor, floor + b.height, thickness, of_look_alike);
  drawn.thing.half = {b.length / 2 + thickness, b.width / 2 + thickness};
  drawn.because.outside_sizes = true;
}

void trench_box(DrawnLookAlike& drawn, Random& random) {
  const OpenBox& b = drawn.box;
  Mesh& m = drawn.thing.mesh;
  for (const double y : {-b.width / 2 - 0.1, b.width / 2}) add_box(m, {-b.length / 2, y, -0.1}, {b.length / 2, y + 0.1, b.height}, of_look_alike);
  const double low = random.uniform(0.3, 0.5) * b.height;
  for (const double x : {-b.length / 2 + 0.4, b.length / 2 - 0.4})
    for (const double z : {low, b.height - 0.25}) add_box(m, {x - 0.08, -b.width / 2, z - 0.08}, {x + 0.08, b.width / 2, z + 0.08}, of_look_alike);
  drawn.thing.half = {b.length / 2, b.width / 2 + 0.1};
  drawn.because = {true, true, true, false};
}

void building_pit(DrawnLookAlike& drawn, Random& random) {
  const double thickness = 0.5, above = random.uniform(0.05, 0.4);
  const OpenBox& b = drawn.box;
  add_open_box(drawn.thing.mesh, b.length, b.width, above - b.height, above, thickness, of_look_alike);
  drawn.thing.half = {b.length / 2 + thickness, b.width / 2 + thickness};
  drawn.hole = {b.length / 2 + 0.02, b.width / 2 + 0.02};
  drawn.because.outside_sizes = true;
}

void loader_bucket(DrawnLookAlike& drawn) {
  const OpenBox& b = drawn.box;
  Mesh& m = drawn.thing.mesh;
  add_box(m, {-b.length / 2, -b.width / 2, 0.0}, {b.length / 2, b.width / 2, 0.08}, of_look_alike);
  add_box(m, {-b.length / 2, b.width / 2, 0.0}, {b.length / 2, b.width / 2 + 0.08, 0.08 + b.height}, of_look_alike);
  for (const double x : {-b.length / 2 - 0.05, b.length / 2})
    add_box(m, {x, -b.width / 2, 0.0}, {x + 0.05, b.width / 2, 0.08 + 0.8 * b.height}, of_look_alike);
  drawn.thing.half = {b.length / 2 + 0.05, b.width / 2 + 0.08};
  drawn.because = {true, true, false, false};
}

void hollow_pile(DrawnLookAlike& drawn, Random& random) {
  const double hollow = random.uniform(0.9, 2.2), depth = random.uniform(0.4, 0.9), height = depth + random.uniform(0.2, 0.8);
  const double slope = random.uniform(0.6, 0.85);
  const double radius = hollow + height / slope, stretch = random.uniform(1.0, 1.7);
  Mesh round;
  add_turned(round, {{0.0, height - depth}, {hollow * 0.4, height - depth * 0.9}, {hollow * 0.8, height - depth * 0.3}, {hollow, height},
                     {hollow + 0.2, height * 0.95}, {hollow + (radius - hollow) * 0.6, height * 0.4}, {radius, -0.1}}, 20, of_look_alike);
  Eigen::Affine3d stretched = Eigen::Affine3d::Identity();
  stretched.scale(Vector3d(stretch, 1.0, 1.0));
  for (const Triangle& t : round) drawn.thing.mesh.push_back({stretched * t.a, stretched * t.b, stretched * t.c, of_look_alike});
  drawn.box = {2 * hollow * stretch, 2 * hollow, depth};
  drawn.thing.half = {radius * stretch, radius};
  drawn.because.wall_missing = true;  // slopes of soil, and none upright
}

void add_lorry(DrawnLookAlike& drawn, double rear, double front, double width, double floor, Random& random) {
  Mesh& m = drawn.thing.mesh;
  const double gap = random.uniform(0.15, 0.4), cab = random.uniform(1.6, 2.2);
  add_box(m, {rear + 0.2, -0.45, 0.55}, {front + gap + cab, 0.45, floor - 0.02}, of_look_alike);
  add_box(m, {front + gap, -width / 2, 0.8}, {front + gap + cab, width / 2, random.uniform(2.6, 3.0)}, of_look_alike);
  for (const double x : {rear + 0.8, rear + 2.1, front + gap + 0.5 * cab})
    for (const double y : {-width / 2 + 0.25, width / 2 - 0.25}) add_wheel(m, {x, y, 0.5}, 0.5, 0.4, of_look_alike);
  drawn.thing.half = {front + gap + cab, width / 2};
}

void flat_bed(DrawnLookAlike& drawn, Random& random) {
  const double length = random.uniform(4.8, 7.0), width = random.uniform(2.40, 2.55);
  const double floor = random.uniform(1.05, 1.35), board = random.uniform(0.6, 1.4);
  Mesh& m = drawn.thing.mesh;
  add_box(m, {-length / 2, -width / 2, floor - 0.15}, {length / 2, width / 2, floor}, of_look_alike);
  add_box(m, {length / 2, -width / 2, floor - 0.15}, {length / 2 + 0.08, width / 2, floor + board}, of_look_alike);
  add_lorry(drawn, -length / 2, length / 2, width, floor, random);
  drawn.box = {length, width, 0.0};
  drawn.because.wall_missing = true;  // three of them
}

void box_trailer(DrawnLookAlike& drawn, Random& random) {
  const double length = random.uniform(4.8, 7.5), width = random.uniform(2.40, 2.55);
  const double floor = random.uniform(1.05, 1.30), height = random.uniform(1.2, 2.5);
  add_box(drawn.thing.mesh, {-length / 2, -width / 2, floor}, {length / 2, width / 2, floor + height}, of_look_alike);
  add_lorry(drawn, -length / 2, length / 2, width, floor, random);
  drawn.box = {length, width, height};
  drawn.because.roofed = true;
}

}  // namespace

DrawnLookAlike draw_look_alike(LookAlike kind, const std::vector<TruckClass>& classes, Random& random) {
  DrawnLookAlike drawn;
  drawn.kind = kind;
  drawn.thing.name = name_of(kind);
  const auto sized = [&](const Range& length, const Range& width, const Range& height) {
    drawn.box = outside_box(kind, classes, random, length, width, height);
  };
  switch (kind) {
    case LookAlike::long_container:
      sized({6.5, 9.0}, {2.20, 2.45}, {1.0, 2.2});
      add_open_container(drawn, 0.06, random.uniform(0.15, 0.3));
      break;
    case LookAlike::skip:
      sized({2.2, 3.8}, {1.4, 1.9}, {0.9, 1.5});
      add_open_container(drawn, 0.05, random.uniform(0.1, 0.2));
      break;
    case LookAlike::trench_box:
      sized({3.0, 6.0}, {0.9, 1.95}, {1.4, 2.4});
      trench_box(drawn, random);
      break;
    case LookAlike::building_pit:
      sized({4.0, 7.0}, {2.8, 4.2}, {1.2, 2.2});
      building_pit(drawn, random);
      break;
    case LookAlike::loader_bucket:
      sized({2.4, 3.3}, {0.9, 1.3}, {0.8, 1.3});
      loader_bucket(drawn);
      break;
    case LookAlike::hollow_pile: hollow_pile(drawn, random); break;
    case LookAlike::flat_bed: flat_bed(drawn, random); break;
    case LookAlike::box_trailer: box_trailer(drawn, random); break;
  }
  return drawn;
}

}  // namespace berm::truck_world
