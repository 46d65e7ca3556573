#include "truck_world/site_ground.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace berm::truck_world {
namespace {

constexpr double fine = 7.0, far = 60.0, growth = 1.4;  // m, m; of the cells beyond the fine ones

std::vector<double> offsets() {
  std::vector<double> right;
  double at = 0.0, step = ground_cell;
  while (at < far) {
    at += step;
    right.push_back(at);
    if (at > fine) step *= growth;
  }
  std::vector<double> all;
  for (auto x = right.rbegin(); x != right.rend(); ++x) all.push_back(-*x);
  all.push_back(0.0);
  all.insert(all.end(), right.begin(), right.end());
  return all;
}

}  // namespace

double SiteGround::height(const Vector2d& at) const {
  const double along = at.dot(place.normalized());
  const double lower = -drop + gradient.dot(at - place) * std::clamp(1.0 - ((at - place).norm() - 12.0) / 12.0, 0.0, 1.0);
  const double share = std::clamp((along - crest) / (toe - crest), 0.0, 1.0);
  return share * lower;
}

Mesh SiteGround::mesh(Random& random, const Vector2d& hole, double hole_yaw) const {
  const std::vector<double> offset = offsets();
  const int n = static_cast<int>(offset.size()) - 1;
  const auto point = [&](int column, int row) {
    const Vector2d at = place + Vector2d(offset[static_cast<std::size_t>(column)], offset[static_cast<std::size_t>(row)]);
    return Vector3d(at.x(), at.y(), height(at) + roughness * random.normal());
  };
  Mesh mesh;
  add_grid(mesh, n, n, point, Surface::ground);
  if (hole.x() <= 0.0) return mesh;
  const Eigen::Rotation2Dd into(-hole_yaw);
  const auto in_hole = [&](const Vector3d& p) {
    const Vector2d local = into * (p.head<2>() - place);
    return std::abs(local.x()) < hole.x() && std::abs(local.y()) < hole.y();
  };
  std::erase_if(mesh, [&](const Triangle& t) { return in_hole(t.a) || in_hole(t.b) || in_hole(t.c); });
  return mesh;
}

}  // namespace berm::truck_world
