#include "truck_world/ground_plan.hpp"

#include <algorithm>
#include <cmath>

namespace berm::truck_world {

Vector2d GroundRectangle::at(double u, double v) const {
  return centre + Eigen::Rotation2Dd(yaw) * Vector2d(u * half.x(), v * half.y());
}

std::vector<Vector2d> GroundRectangle::outline(double spacing) const {
  std::vector<Vector2d> points;
  const Vector2d corner[4]{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
  for (int side = 0; side < 4; ++side) {
    const Vector2d from = at(corner[side].x(), corner[side].y()), to = at(corner[(side + 1) % 4].x(), corner[(side + 1) % 4].y());
    const int count = std::max(1, static_cast<int>(std::ceil((to - from).norm() / spacing)));
    for (int k = 0; k < count; ++k) points.push_back(from + (to - from) * k / count);
  }
  return points;
}

double GroundRectangle::distance(const Vector2d& point) const {
  const Vector2d local = Eigen::Rotation2Dd(-yaw) * (point - centre);
  return (local.cwiseAbs() - half).cwiseMax(0.0).norm();
}

bool apart(const GroundRectangle& a, const GroundRectangle& b, double gap) {
  const Vector2d between = b.centre - a.centre;
  for (const GroundRectangle* r : {&a, &b}) {
    for (const double turn : {0.0, 1.5707963267948966}) {
      const Vector2d axis(std::cos(r->yaw + turn), std::sin(r->yaw + turn));
      double reach = 0.0;
      for (const GroundRectangle* s : {&a, &b}) {
        const Vector2d x(std::cos(s->yaw), std::sin(s->yaw)), y(-x.y(), x.x());
        reach += s->half.x() * std::abs(axis.dot(x)) + s->half.y() * std::abs(axis.dot(y));
      }
      if (std::abs(axis.dot(between)) >= reach + gap) return true;
    }
  }
  return false;
}

}  // namespace berm::truck_world
