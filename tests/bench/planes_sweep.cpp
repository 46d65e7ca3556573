#include "planes_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "truck_world/truck_class.hpp"

namespace berm::bench {
namespace {

using namespace truck_world;

constexpr double kLeastReturns = 50.0;
constexpr double kReach = 30.0;       // m
constexpr double kRimMargin = 0.02;   // m below the tops
constexpr double kFaceTurned = 0.85;  // cosine between a triangle's normal and its wall's: mud is uneven, edges and tops are turned by 90 degrees

}  // namespace

SweepPoints sweep_points(const Scene& scene) {
  SweepPoints out;
  out.scene = &scene;
  out.density = static_cast<double>(scene.sweep.samples) / kUsualSamples;
  for (std::size_t i = 0; i < scene.cloud.size(); ++i) {
    const app::ScanPoint& p = scene.cloud[i];
    const Vector3d at(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z));
    if ((at - scene.truth.viewpoint).norm() > kReach) continue;
    out.points.push_back(at);
    out.samples.push_back(scene.point_truth[i].sample);
  }
  return out;
}

std::vector<WallFace> faces_seen(const Scene& scene, const std::vector<TruckClass>& classes) {
  const TruckTruth& k = scene.truth.of_truck;
  const auto own = std::find_if(classes.begin(), classes.end(), [&](const TruckClass& c) { return c.name == k.truck_class; });
  const double straight = own->bed == BedShape::half_round ? k.wall_height - k.inside_width / 2 : k.wall_height;
  const Vector3d u = (k.corners[0] - k.corners[1]).normalized(), v = (k.corners[0] - k.corners[3]).normalized(), w = u.cross(v);
  const Vector3d middle = (k.corners[0] + k.corners[1] + k.corners[2] + k.corners[3]) / 4.0;

  std::array<WallFace, 8> faces{};
  const BoundingTree tree(scene.mesh);
  for (const PointTruth& p : scene.point_truth) {
    if (p.outlier || p.surface < Surface::wall_front || p.surface > Surface::wall_right) continue;
    const bool end = p.surface == Surface::wall_front || p.surface == Surface::wall_rear;
    const double side = p.surface == Surface::wall_front || p.surface == Surface::wall_left ? 1.0 : -1.0;
    const Vector3d normal = side * (end ? u : v);
    const SampleRay ray = scene.sweep.ray(static_cast<int>(p.sample));
    const auto hit = tree.first(ray.origin, ray.direction, range_max);
    if (!hit) continue;
    const Triangle& t = scene.mesh[hit->triangle];
    const Vector3d at = ray.origin + hit->range * ray.direction;
    const double depth = -w.dot(at - middle), beyond = normal.dot(at - middle) - (end ? k.inside_length : k.inside_width) / 2;
    const Vector3d turned = (t.b - t.a).cross(t.c - t.a).normalized();
    if (std::abs(turned.dot(normal)) < kFaceTurned || depth < kRimMargin || (!end && depth > straight)) continue;
    const bool outer = beyond > k.wall_thickness / 2;
    WallFace& face = faces[2 * (static_cast<std::size_t>(p.surface) - static_cast<std::size_t>(Surface::wall_front)) + (outer ? 1 : 0)];
    if (face.returns++ == 0) face = {p.surface, outer, normal, Vector3d::Zero(), Vector3d::Zero(), 1};
    face.middle += at;
  }
  std::vector<WallFace> seen;
  for (WallFace& face : faces) {
    if (face.returns < kLeastReturns * scene.sweep.samples / kUsualSamples) continue;
    face.middle /= face.returns;
    const bool end = face.wall == Surface::wall_front || face.wall == Surface::wall_rear;
    const double to_face = (end ? k.inside_length : k.inside_width) / 2 + (face.outer ? k.wall_thickness : 0.0);
    face.bare = face.middle + (to_face - face.normal.dot(face.middle - middle)) * face.normal;
    seen.push_back(face);
  }
  return seen;
}

FaceError match(const WallFace& face, const std::vector<FoundPlane>& planes) {
  FaceError best;
  double least = 2.0;
  for (const FoundPlane& p : planes) {
    const double angle = std::acos(std::min(1.0, std::abs(p.normal.dot(face.normal)))), offset = std::abs(p.normal.dot(face.middle - p.at));
    if (angle > kAngleGate || offset > kOffsetGate || p.box.exteriorDistance(face.middle) > kBoxGate) continue;
    const double far = std::pow(angle / kAngleGate, 2) + std::pow(offset / kOffsetGate, 2);
    if (best.matched && far >= least) continue;
    least = far;
    best = {true, angle, offset, std::abs(p.normal.dot(face.bare - p.at))};
  }
  return best;
}

}  // namespace berm::bench
