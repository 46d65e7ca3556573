// Distance between two convex bodies in double precision (Gilbert, Johnson and Keerthi, 1988), with a certificate: the true distance
// lies between `lower` and `upper`.
//
// Each round gives an upper bound (the nearest point found of the difference of the bodies) and a lower bound (the supporting plane
// seen from it). It ends when they are within 1e-7 m, when rounding allows no more progress, or when the bodies are found to meet.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace berm::plant::oracle {

using Point = Eigen::Vector3d;

// A convex polytope by its corners, or an upright cylinder by the middle of its lower disc.
struct Body {
  std::vector<Point> corner;
  Point foot = Point::Zero();
  double radius = 0, height = 0;  // of the cylinder; used when there are no corners
  Point middle = Point::Zero();   // of a sphere that holds the body
  double reach = 0;

  static Body polytope(std::vector<Point> corners);
  static Body cylinder(const Point& foot, double radius, double height);
  // The body's furthest point in a direction.
  [[nodiscard]] Point support(const Point& direction) const;
};

struct Distance {
  double lower = 0, upper = 0;
  [[nodiscard]] bool meet() const { return upper <= 1e-6; }  // nearer than this counts as touching
};

Distance distance(const Body& a, const Body& b);

}  // namespace berm::plant::oracle
