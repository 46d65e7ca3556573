#include "plant/process/triangulated_surface.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Projection_traits_xy_3.h>

namespace berm::plant {

namespace {

using Exact = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_2<CGAL::Projection_traits_xy_3<Exact>>;
using Corner = Exact::Point_3;

double squared_in_plan(const Corner& a, const Corner& b) {
  const double x = a.x() - b.x(), y = a.y() - b.y();
  return x * x + y * y;
}

}  // namespace

struct TriangulatedSurface::Triangles {
  Delaunay net;
  Delaunay::Face_handle near;
};

TriangulatedSurface::TriangulatedSurface(const std::vector<std::array<double, 3>>& points, double gap)
    : triangles_(std::make_unique<Triangles>()), gap_(gap) {
  std::vector<Corner> corners;
  corners.reserve(points.size());
  for (const auto& p : points) corners.emplace_back(p[0], p[1], p[2]);
  triangles_->net.insert(corners.begin(), corners.end());
}

TriangulatedSurface::~TriangulatedSurface() = default;

std::optional<double> TriangulatedSurface::height(double x, double y) {
  const Delaunay& net = triangles_->net;
  if (net.dimension() < 2) return std::nullopt;
  const Delaunay::Face_handle face = net.locate(Corner(x, y, 0), triangles_->near);
  if (face == nullptr || net.is_infinite(face)) return std::nullopt;
  triangles_->near = face;
  const Corner &a = face->vertex(0)->point(), &b = face->vertex(1)->point(), &c = face->vertex(2)->point();
  for (const double side : {squared_in_plan(a, b), squared_in_plan(b, c), squared_in_plan(c, a)})
    if (side > gap_ * gap_) return std::nullopt;
  const double area = (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
  const double u = ((x - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (y - a.y())) / area;
  const double v = ((b.x() - a.x()) * (y - a.y()) - (x - a.x()) * (b.y() - a.y())) / area;
  return a.z() + u * (b.z() - a.z()) + v * (c.z() - a.z());
}

}  // namespace berm::plant
