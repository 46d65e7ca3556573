// The statements of a fit as residuals with their derivatives, in closed form; for the nine values that describe a bed.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "recognition/bed_constraints.hpp"

namespace berm::app {

// Middle x y z (m), yaw, pitch, roll (rad), inside length and width, wall thickness (m).
enum BedValue { kBedX, kBedY, kBedZ, kBedYaw, kBedPitch, kBedRoll, kBedLength, kBedWidth, kBedThickness, kBedValues };
using BedVector = Eigen::Matrix<double, kBedValues, 1>;

BedVector values_of(const BedPose& pose);
void set_values(BedPose& pose, const BedVector& values);

// A bed's axes at some values, and how they turn with its angles.
struct BedAxes {
  explicit BedAxes(const BedVector& values);
  Eigen::Vector3d middle;
  std::array<Eigen::Vector3d, 3> axis;                 // u, v, w
  std::array<std::array<Eigen::Vector3d, 3>, 3> turn;  // [angle: yaw, pitch, roll][axis]: its derivative
};

constexpr double kCertain = 12.0;  // of a logistic function's argument: a residual of 0.004 standard deviations, and none any more

// The residual in standard deviations: of a return its distance from the plane; of a ray past an edge sqrt(2 log(1 + e^y)), y the distance beyond the
// bound, so that half its square is the negative logarithm of a logistic function. slope: null when it is not asked for.
double residual(const BedConstraint& c, const BedAxes& axes, const BedVector& values, int open_end, BedVector* slope);

}  // namespace berm::app
