// What a fit's statements add up to at some values of the bed: the loss, its slopes, and the products of slopes that a step is found by. Eight statements
// at a time, in single precision: a search makes hundreds of fits, and each sums up some hundred statements a dozen times.
#pragma once

#include <vector>

#include "recognition/bed_residuals.hpp"
#include "recognition/lanes.hpp"

namespace berm::app {

// Of the Cauchy loss, in standard deviations. The loss of a residual r is kRobust^2 log(1 + r^2 / kRobust^2).
constexpr double kRobust = 2.0;

// Statements of a bed whose open end is known, eight side by side; the last eight are filled up with such as say nothing.
class PackedStatements {
 public:
  using Vector = Eights<3>;
  // A return is bound by the plane that it lies on. A ray past an edge is bound where it crosses a plane.
  struct alignas(32) EightStatements {
    Vector head, at;          // of the ray, base frame
    Vector bound, plane;      // outward normals in the bed's frame
    Eight bound_thick, plane_thick;  // 1: of an outer face, a wall's thickness beyond the inner one
    Eight scale, offset;       // 1/m, less than 0 where the ray must pass beyond the bound; m
    EightInt edge;             // a mask
  };
  PackedStatements(const std::vector<BedConstraint>& statements, int open_end);
  [[nodiscard]] const std::vector<EightStatements>& eights() const { return eights_; }

 private:
  std::vector<EightStatements> eights_;
};

struct BedSums {
  using Products = Eigen::Matrix<double, kBedValues, kBedValues>;
  double square = 0.0;                     // of all t: that whose square is the loss of a residual (bed_residuals.hpp)
  Products products = Products::Zero();    // J' J, of their slopes
  BedVector downhill = BedVector::Zero();  // -J' t
};
BedSums sums_of(const PackedStatements& statements, const BedVector& values);
// The square alone.
double square_of(const PackedStatements& statements, const BedVector& values);

}  // namespace berm::app
