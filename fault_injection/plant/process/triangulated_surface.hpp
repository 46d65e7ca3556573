// The surface over points: their Delaunay triangulation in plan (CGAL), linear on each triangle. It goes through every point, and adds nothing
// between them that a survey did not see: no smoothing, no overshoot.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace berm::plant {

class TriangulatedSurface {
 public:
  // Points x, y, z; of points with the same x and y the last counts. gap, m: a triangle with a longer side covers a place that was not measured.
  TriangulatedSurface(const std::vector<std::array<double, 3>>& points, double gap);
  ~TriangulatedSurface();

  // Height at a place; none outside the points' convex hull or where nothing was measured. Fast for places near the one asked before.
  [[nodiscard]] std::optional<double> height(double x, double y);

 private:
  struct Triangles;  // CGAL's headers cost every includer seconds to compile
  std::unique_ptr<Triangles> triangles_;
  double gap_;
};

}  // namespace berm::plant
