#include "recognition/bed_ceres.hpp"

#include <ceres/tiny_solver.h>

#include <cmath>

namespace berm::app {
namespace {

// A statement's residual t is that whose square is the Cauchy loss of the residual r.
class Problem {
 public:
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = kBedValues };

  Problem(const std::vector<BedConstraint>& all, int open_end, std::span<const KnownValue> known) : all_(all), open_end_(open_end), known_(known) {}
  [[nodiscard]] int NumResiduals() const { return static_cast<int>(all_.size() + known_.size()); }

  bool operator()(const double* parameters, double* residuals, double* jacobian) const {
    const BedVector values = Eigen::Map<const BedVector>(parameters);
    const BedAxes axes(values);
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, kBedValues>> slopes(jacobian, jacobian != nullptr ? NumResiduals() : 0, kBedValues);
    BedVector slope;
    Eigen::Index row = 0;
    for (const BedConstraint& c : all_) {
      const double r = residual(c, axes, values, open_end_, jacobian != nullptr ? &slope : nullptr);
      const double s = r * r / (kRobust * kRobust), t = std::copysign(kRobust * std::sqrt(std::log1p(s)), r);
      residuals[row] = t;
      if (jacobian != nullptr) slopes.row(row) = (std::abs(t) > 1e-9 ? r / (t * (1.0 + s)) : 1.0) * slope.transpose();
      ++row;
    }
    for (const KnownValue& k : known_) {
      residuals[row] = (parameters[k.which] - k.mean) / k.deviation;
      if (jacobian != nullptr) {
        slopes.row(row).setZero();
        slopes(row, k.which) = 1.0 / k.deviation;
      }
      ++row;
    }
    return true;
  }

 private:
  const std::vector<BedConstraint>& all_;
  int open_end_;
  std::span<const KnownValue> known_;
};

}  // namespace

void solve_bed_by_ceres(const std::vector<BedConstraint>& statements, int open_end, std::span<const KnownValue> known, int steps, double cost_step,
                        BedVector& values) {
  ceres::TinySolver<Problem> solver;
  solver.options.max_num_iterations = steps;
  solver.options.function_tolerance = cost_step;
  solver.Solve(Problem(statements, open_end, known), &values);
}

}  // namespace berm::app
