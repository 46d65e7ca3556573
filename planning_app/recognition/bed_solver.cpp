#include "recognition/bed_solver.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace berm::app {
namespace {

constexpr double kFirstDamping = 1e-4;
constexpr double kLeastStep = 1e-8, kLeastGradient = 1e-10;
constexpr double kLeastOfDiagonal = 1e-6;

// Of the statements and of what is known beforehand.
BedSums sums_of_all(const PackedStatements& statements, std::span<const KnownValue> known, const BedVector& values) {
  BedSums sums = sums_of(statements, values);
  for (const KnownValue& k : known) {
    const double one = 1.0 / k.deviation, r = (values[k.which] - k.mean) * one;
    sums.square += r * r;
    sums.products(k.which, k.which) += one * one;
    sums.downhill[k.which] -= r * one;
  }
  return sums;
}

double square_of_all(const PackedStatements& statements, std::span<const KnownValue> known, const BedVector& values) {
  double square = square_of(statements, values);
  for (const KnownValue& k : known) {
    const double r = (values[k.which] - k.mean) / k.deviation;
    square += r * r;
  }
  return square;
}

}  // namespace

void solve_bed(const std::vector<BedConstraint>& all, int open_end, std::span<const KnownValue> known, int steps, double cost_step, BedVector& values) {
  const PackedStatements statements(all, open_end);
  BedSums sums = sums_of_all(statements, known, values);
  // Values of metres and of radians, alike.
  const BedVector scale = (1.0 + sums.products.diagonal().array().sqrt()).inverse();
  double damping = kFirstDamping, more = 2.0;
  for (int step = 1; step < steps; ++step) {
    const BedSums::Products products = scale.asDiagonal() * sums.products * scale.asDiagonal();
    const BedVector downhill = scale.cwiseProduct(sums.downhill);
    if (downhill.lpNorm<Eigen::Infinity>() < kLeastGradient) return;
    BedSums::Products damped = products;
    damped.diagonal() += damping * products.diagonal().cwiseMax(kLeastOfDiagonal);
    const BedVector scaled_move = damped.ldlt().solve(downhill), move = scale.cwiseProduct(scaled_move);
    if (move.norm() < kLeastStep * (values.norm() + kLeastStep)) return;
    const BedVector to = values + move;
    // Where so little is expected that the fit is about to end, the slopes there are hardly ever needed.
    const double expected = scaled_move.dot(2.0 * downhill - products * scaled_move);
    const bool ends = expected < cost_step;
    BedSums there;
    if (ends) there.square = square_of_all(statements, known, to);
    else there = sums_of_all(statements, known, to);
    const double gain = sums.square - there.square, share = gain / expected;
    if (share > 0.0) values = to;
    if (std::abs(gain) < cost_step) return;
    if (share > 0.0) {
      sums = ends ? sums_of_all(statements, known, to) : there;
      const double better = 2.0 * share - 1.0;
      damping *= std::max(1.0 / 3.0, 1.0 - better * better * better);
      more = 2.0;
    } else {
      damping *= more;
      more *= 2.0;
    }
  }
}

}  // namespace berm::app
