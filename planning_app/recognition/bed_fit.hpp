// The fit of a bed to the rays of a sweep: pose, inside length, width, plane of the tops and wall thickness by robust least squares (bed_solver), with the
// covariance that the rays carry. Frames and units as in bed_model.hpp.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "recognition/bed_constraints.hpp"
#include "recognition/bed_model.hpp"
#include "recognition/bed_residuals.hpp"
#include "recognition/packed_rays.hpp"
#include "recognition/truck_ranges.hpp"

namespace berm::app {

using Matrix8d = Eigen::Matrix<double, 8, 8>;
using Matrix12d = Eigen::Matrix<double, 12, 12>;

struct FittedBed {
  BedPose pose;
  Matrix8d covariance = Matrix8d::Zero();   // of middle x y z, yaw, pitch, roll, length, width; m, rad
  int residuals = 0;
  bool converged = false;
  // What the last round went by, and where it came to: for the covariance, where that is asked for later.
  std::vector<BedConstraint> statements;
  BedVector values = BedVector::Zero();
};

// Two kinds of residuals. Returns on a face or on the walls' tops: their distance from that plane. Rays past an edge: each must pass on its side, by
// the negative logarithm of a logistic function of the distance; so an edge is bracketed between the rays that pass it on either side, however far
// apart two rays of one scanline are. What a ray passed is decided by the pose, which must be near already (0.2 m, 3 degrees), and decided again in
// every round. In all rounds but the last two edges are blurred, so that a wall some centimetres too high or low comes to where it is; not those of
// the bed's ends, which would wander off where no ray shows them.
enum class BedSolver { sums, ceres };  // bed_solver for the many fits of a search; the one that is the answer ends with Ceres
// sizes: what is known of width and walls beforehand.
FittedBed fit_bed(const BedPose& start, const std::vector<Ray>& rays, int rounds, const BedSizes& sizes, BedSolver solver = BedSolver::sums);
// The same without its covariance, which of most fits is never asked for; find_covariance adds it. packed: the same rays.
FittedBed fit_pose(const BedPose& start, const std::vector<Ray>& rays, const PackedRays& packed, int rounds, const BedSizes& sizes);
void find_covariance(FittedBed& fit, const BedSizes& sizes);

// Of the opening on the inner top edge: (+u, +v), (-u, +v), (-u, -v), (+u, -v).
std::array<Eigen::Vector3d, 4> opening_corners(const BedPose& pose);
// Of x y z of the four corners in turn; rank 8.
Matrix12d corner_covariance(const FittedBed& fit);

}  // namespace berm::app
