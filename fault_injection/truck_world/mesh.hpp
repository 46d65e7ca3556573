// Triangles of a scene, and the shapes that its things are put together from. Metres.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <numbers>
#include <vector>

#include "truck_world/surface.hpp"

namespace berm::truck_world {

using Eigen::Vector2d;
using Eigen::Vector3d;
constexpr double pi = std::numbers::pi;

struct Triangle {
  Vector3d a, b, c;
  Surface surface = Surface::ground;
};
using Mesh = std::vector<Triangle>;

void add_quad(Mesh& mesh, const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d, Surface surface);
// Faces along the axes.
void add_box(Mesh& mesh, const Vector3d& low, const Vector3d& high, Surface surface);
// A grid of (columns + 1) x (rows + 1) points, two triangles a cell; point(column, row).
void add_grid(Mesh& mesh, int columns, int rows, const std::function<Vector3d(int, int)>& point, Surface surface);
// A closed upright prism over an outline (counter-clockwise, convex).
void add_prism(Mesh& mesh, const std::vector<Vector2d>& outline, double z_low, double z_high, Surface surface);
// A wheel: a cylinder of twelve faces with its axis along y.
void add_wheel(Mesh& mesh, const Vector3d& centre, double radius, double width, Surface surface);
// Surface of revolution about the z axis through the origin: profile is (radius, z) from the middle outwards.
void add_turned(Mesh& mesh, const std::vector<Vector2d>& profile, int sides, Surface surface);
// Four walls without a roof: inside length (x), width (y); z from floor to top; walls outside of it; floor at z_low.
void add_open_box(Mesh& mesh, double length, double width, double z_low, double z_high, double thickness, Surface surface);
// Appends part, moved to where placement puts it.
void add_placed(Mesh& mesh, const Mesh& part, const Eigen::Isometry3d& placement);
// x, y, z of the origin, then yaw, pitch (nose down positive) and roll about the moved axes, radians.
Eigen::Isometry3d placed_at(const Vector3d& origin, double yaw, double pitch = 0.0, double roll = 0.0);

}  // namespace berm::truck_world
