// The convex hull of a slice's integer vertices as half-spaces, found by brute force in integers: no idea of the slice's topology,
// no code of the kernel.
#ifndef BERM_TESTS_GEOMETRY_EXACT_HULL_HPP
#define BERM_TESTS_GEOMETRY_EXACT_HULL_HPP

#include <vector>

#include "core/clearance.h"

namespace berm::kernel::test {

class ExactHull {
public:
  explicit ExactHull(const sk_slice& slice);

  // Point in mm. tolerance_mm: how far outside a facet still counts as inside.
  bool contains(double x, double y, double z, double tolerance_mm = 0.0) const;
  bool solid() const { return facet_.size() >= 4; }
  const double* low() const { return low_; }
  const double* high() const { return high_; }

private:
  struct Facet {
    double x, y, z, d; // unit outward normal
  };
  std::vector<Facet> facet_;
  double low_[3], high_[3];
};

} // namespace berm::kernel::test
#endif
