#include "exact_overlap.hpp"

#include <algorithm>

namespace berm::core_test {
namespace {

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
std::int64_t dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

constexpr Vector kUnit[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

}  // namespace

ExactHull::ExactHull(const std::vector<Vector>& vertices) : lowest_(vertices[0][2]), highest_(vertices[0][2]) {
  for (const Vector& v : vertices) {
    lowest_ = std::min(lowest_, v[2]);
    highest_ = std::max(highest_, v[2]);
  }
  for (const Vector& axis : kUnit) add(axis, vertices);  // the column's faces
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (std::size_t j = i + 1; j < vertices.size(); ++j) {
      const Vector edge = minus(vertices[j], vertices[i]);
      for (const Vector& axis : kUnit) add(cross(edge, axis), vertices);  // an edge of each
      for (std::size_t k = j + 1; k < vertices.size(); ++k) add(cross(edge, minus(vertices[k], vertices[i])), vertices);  // the hull's faces
    }
}

void ExactHull::add(const Vector& normal, const std::vector<Vector>& vertices) {
  Axis axis{normal, dot(normal, vertices[0]), dot(normal, vertices[0])};
  for (const Vector& v : vertices) {
    axis.low = std::min(axis.low, dot(normal, v));
    axis.high = std::max(axis.high, dot(normal, v));
  }
  axes_.push_back(axis);
}

bool ExactHull::meets(const Column& c) const {
  // nothing of the hull is below its lowest point: a column cut off below it, meets it where the whole one does
  const std::int64_t bottom = std::min(lowest_, c.top) - 1;
  return std::none_of(axes_.begin(), axes_.end(), [&](const Axis& axis) {
    std::int64_t low = INT64_MAX, high = INT64_MIN;
    for (const std::int64_t x : {c.x_low, c.x_high})
      for (const std::int64_t y : {c.y_low, c.y_high})
        for (const std::int64_t z : {bottom, c.top}) {
          const std::int64_t along = dot(axis.normal, {x, y, z});
          low = std::min(low, along);
          high = std::max(high, along);
        }
    return axis.high < low || high < axis.low;
  });
}

}  // namespace berm::core_test
