// The least squares of a bed's fit, by the method of Levenberg and Marquardt: the steps of Ceres' TinySolver (Madsen, Nielsen and Tingleff, 2004), on
// sums over the statements instead of a Jacobian, of which a row would be written, scaled and read again for every statement.
#pragma once

#include <span>
#include <vector>

#include "recognition/bed_sums.hpp"

namespace berm::app {

// What is known of a value beforehand.
struct KnownValue {
  BedValue which;
  double mean, deviation;
};

// Moves the values to where all losses and what is known come to least, in at most so many steps; it ends where a step changes their sum by less than
// cost_step, in squared standard deviations.
void solve_bed(const std::vector<BedConstraint>& statements, int open_end, std::span<const KnownValue> known, int steps, double cost_step, BedVector& values);

}  // namespace berm::app
