// The least squares of a bed's fit by Ceres' solver for small problems.
#pragma once

#include <span>
#include <vector>

#include "recognition/bed_solver.hpp"

namespace berm::app {

// As solve_bed.
void solve_bed_by_ceres(const std::vector<BedConstraint>& statements, int open_end, std::span<const KnownValue> known, int steps, double cost_step,
                        BedVector& values);

}  // namespace berm::app
