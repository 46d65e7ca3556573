// Whether a convex hull and a column without a bottom have a point in common: by all the axes along which two convex bodies can be apart.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace berm::core_test {

using Vector = std::array<std::int64_t, 3>;

struct Column {
  std::int64_t x_low, x_high, y_low, y_high, top;
};

// Exact for coordinates within 50000, flat hulls, segments and points included (a column is a solid body).
class ExactHull {
 public:
  explicit ExactHull(const std::vector<Vector>& vertices);
  bool meets(const Column& column) const;
  std::int64_t highest() const { return highest_; }

 private:
  struct Axis {
    Vector normal;
    std::int64_t low, high;  // of the hull along it
  };
  void add(const Vector& normal, const std::vector<Vector>& vertices);
  std::vector<Axis> axes_;
  std::int64_t lowest_, highest_;
};

}  // namespace berm::core_test
