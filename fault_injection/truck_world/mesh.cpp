#include "truck_world/mesh.hpp"

#include <cmath>

namespace berm::truck_world {

void add_quad(Mesh& mesh, const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d, Surface surface) {
  mesh.push_back({a, b, c, surface});
  mesh.push_back({a, c, d, surface});
}

void add_prism(Mesh& mesh, const std::vector<Vector2d>& outline, double z_low, double z_high, Surface surface) {
  const std::size_t n = outline.size();
  const auto at = [&](std::size_t i, double z) { return Vector3d(outline[i % n].x(), outline[i % n].y(), z); };
  for (std::size_t i = 0; i < n; ++i) add_quad(mesh, at(i, z_low), at(i + 1, z_low), at(i + 1, z_high), at(i, z_high), surface);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    mesh.push_back({at(0, z_high), at(i, z_high), at(i + 1, z_high), surface});
    mesh.push_back({at(0, z_low), at(i + 1, z_low), at(i, z_low), surface});
  }
}

void add_box(Mesh& mesh, const Vector3d& low, const Vector3d& high, Surface surface) {
  add_prism(mesh, {{low.x(), low.y()}, {high.x(), low.y()}, {high.x(), high.y()}, {low.x(), high.y()}}, low.z(), high.z(), surface);
}

void add_grid(Mesh& mesh, int columns, int rows, const std::function<Vector3d(int, int)>& point, Surface surface) {
  std::vector<Vector3d> before, now;
  for (int row = 0; row <= rows; ++row) {
    now.clear();
    for (int column = 0; column <= columns; ++column) now.push_back(point(column, row));
    for (std::size_t i = 0; row > 0 && i + 1 < now.size(); ++i) add_quad(mesh, before[i], before[i + 1], now[i + 1], now[i], surface);
    before.swap(now);
  }
}

void add_wheel(Mesh& mesh, const Vector3d& centre, double radius, double width, Surface surface) {
  std::vector<Vector2d> rim;
  for (int i = 0; i < 12; ++i) {
    const double angle = pi * i / 6.0;
    rim.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  Mesh lying;
  add_prism(lying, rim, -width / 2, width / 2, surface);
  Eigen::Isometry3d upright = Eigen::Isometry3d::Identity();
  upright.translate(centre);
  upright.rotate(Eigen::AngleAxisd(pi / 2, Vector3d::UnitX()));
  add_placed(mesh, lying, upright);
}

void add_turned(Mesh& mesh, const std::vector<Vector2d>& profile, int sides, Surface surface) {
  const auto point = [&](int side, int ring) {
    const double angle = 2.0 * pi * (side % sides) / sides;
    const Vector2d& p = profile[static_cast<std::size_t>(ring)];
    return Vector3d(p.x() * std::cos(angle), p.x() * std::sin(angle), p.y());
  };
  add_grid(mesh, sides, static_cast<int>(profile.size()) - 1, point, surface);
}

void add_open_box(Mesh& mesh, double length, double width, double z_low, double z_high, double thickness, Surface surface) {
  const double x = length / 2, y = width / 2, t = thickness;
  add_box(mesh, {-x - t, -y - t, z_low - t}, {x + t, y + t, z_low}, surface);
  add_box(mesh, {-x - t, y, z_low}, {x + t, y + t, z_high}, surface);
  add_box(mesh, {-x - t, -y - t, z_low}, {x + t, -y, z_high}, surface);
  add_box(mesh, {x, -y, z_low}, {x + t, y, z_high}, surface);
  add_box(mesh, {-x - t, -y, z_low}, {-x, y, z_high}, surface);
}

void add_placed(Mesh& mesh, const Mesh& part, const Eigen::Isometry3d& placement) {
  mesh.reserve(mesh.size() + part.size());
  for (const Triangle& t : part) mesh.push_back({placement * t.a, placement * t.b, placement * t.c, t.surface});
}

Eigen::Isometry3d placed_at(const Vector3d& origin, double yaw, double pitch, double roll) {
  Eigen::Isometry3d placement = Eigen::Isometry3d::Identity();
  placement.translate(origin);
  placement.rotate(Eigen::AngleAxisd(yaw, Vector3d::UnitZ()));
  placement.rotate(Eigen::AngleAxisd(pitch, Vector3d::UnitY()));
  placement.rotate(Eigen::AngleAxisd(roll, Vector3d::UnitX()));
  return placement;
}

}  // namespace berm::truck_world
