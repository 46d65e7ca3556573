#include "recognition/bed_solver.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace berm::app {
namespace {

using BedMatrix = Eigen::Matrix<double, kBedValues, kBedValues>;

constexpr double kFirstDamping = 1e-4;
constexpr double kLeastStep = 1e-8, kLeastGradient = 1e-10;
constexpr double kLeastOfDiagonal = 1e-6;
constexpr double kNoLoss = 1e-8;        // of a squared residual: its loss is the residual's square

// The sum of squares and its slopes. A statement's residual t is that whose square is the Cauchy loss of the residual r.
class Sums {
 public:
  Sums(const std::vector<BedConstraint>& statements, int open_end, std::span<const KnownValue> known, const BedVector& values) {
    const BedAxes axes(values);
    BedVector slope;
    for (const BedConstraint& c : statements) {
      const double r = residual(c, axes, values, open_end, &slope), s = r * r / (kRobust * kRobust), outer = 1.0 + s;
      if (r == 0.0) continue;
      const double loss = s > kNoLoss ? std::log(outer) : s, one_by_both = 1.0 / (loss * outer), one_by_outer = one_by_both * loss;
      square += kRobust * kRobust * loss;
      add(slope, s * one_by_both * one_by_outer, r * one_by_outer);
    }
    for (const KnownValue& k : known) {
      const double one = 1.0 / k.deviation, r = (values[k.which] - k.mean) * one;
      square += r * r;
      products_[k.which][k.which] += one * one;
      downhill[k.which] -= r * one;
    }
    for (int i = 0; i < kBedValues; ++i)
      for (int j = 0; j < kBedValues; ++j) products(i, j) = products_[std::min(i, j)][std::max(i, j)];
  }

  double square = 0.0;                      // of all t
  BedMatrix products;                       // J' J
  BedVector downhill = BedVector::Zero();   // -J' t

 private:
  void add(const BedVector& slope, double of_products, double of_slope) {
    double row[kRow] = {};
    for (int i = 0; i < kBedValues; ++i) row[i] = slope[i];
#pragma GCC unroll 9
    for (int i = 0; i < kBedValues; ++i) {
      const double factor = of_products * row[i];
#pragma GCC unroll 10
      for (int j = i & ~1; j < kRow; ++j) products_[i][j] += factor * row[j];  // in pairs, from the diagonal on
      downhill[i] -= of_slope * row[i];
    }
  }

  static constexpr int kRow = kBedValues + 1;  // even
  double products_[kBedValues][kRow] = {};
};

}  // namespace

void solve_bed(const std::vector<BedConstraint>& statements, int open_end, std::span<const KnownValue> known, int steps, double cost_step, BedVector& values) {
  Sums sums(statements, open_end, known, values);
  // Values of metres and of radians, alike.
  const BedVector scale = (1.0 + sums.products.diagonal().array().sqrt()).inverse();
  double damping = kFirstDamping, more = 2.0;
  for (int step = 1; step < steps; ++step) {
    const BedMatrix products = scale.asDiagonal() * sums.products * scale.asDiagonal();
    const BedVector downhill = scale.cwiseProduct(sums.downhill);
    if (downhill.lpNorm<Eigen::Infinity>() < kLeastGradient) return;
    BedMatrix damped = products;
    damped.diagonal() += damping * products.diagonal().cwiseMax(kLeastOfDiagonal);
    const BedVector scaled_move = damped.ldlt().solve(downhill), move = scale.cwiseProduct(scaled_move);
    if (move.norm() < kLeastStep * (values.norm() + kLeastStep)) return;
    const Sums there(statements, open_end, known, values + move);
    const double gain = sums.square - there.square, expected = scaled_move.dot(2.0 * downhill - products * scaled_move), share = gain / expected;
    if (share > 0.0) {
      values += move;
      sums = there;
      const double better = 2.0 * share - 1.0;
      damping *= std::max(1.0 / 3.0, 1.0 - better * better * better);
      more = 2.0;
    } else {
      damping *= more;
      more *= 2.0;
    }
    if (std::abs(gain) < cost_step) return;
  }
}

}  // namespace berm::app
