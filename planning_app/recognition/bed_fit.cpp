#include "recognition/bed_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "recognition/bed_ceres.hpp"
#include "recognition/bed_constraints.hpp"
#include "recognition/bed_residuals.hpp"
#include "recognition/bed_solver.hpp"

namespace berm::app {
namespace {

constexpr double kSpeaking = 0.55, kSpeakingBelow = 0.2;  // m from the walls, and below what is seen of them: rays beyond make no statement
constexpr double kBlur = 3.0;                 // of edges, from round to round
constexpr int kIterations = 12;
constexpr double kCostStep = 1e-2;            // in squared standard deviations: the fit ends
constexpr double kCostStepBefore = 1.0;       // the same of a round that another follows, with statements of its own
constexpr int kResidualsLeast = 20;
constexpr double kThinnest = 0.03, kThicknessSlack = 0.06;  // m, of walls
constexpr double kLeastSpread = 0.002;        // m: of a size that all classes share
constexpr double kShared = 3.0;               // rays that count as one
// Of middle x y z (m), yaw, pitch, roll (rad), length and width (m) by the body alone; calibrated on drawn scenes.
constexpr std::array<double, 8> kBodyDeviation{0.007, 0.007, 0.007, 0.001, 0.002, 0.0045, 0.013, 0.012};

// What is known beforehand: walls and widths of the classes, each as likely within its range, and ground that is nearly level.
using Known = std::array<KnownValue, 4>;
KnownValue evenly(BedValue which, const SizeRange& range) { return {which, 0.5 * (range[0] + range[1]), 0.5 * (range[1] - range[0]) * std::numbers::inv_sqrt3 + kLeastSpread}; }
Known known_of(const BedSizes& sizes) { return {{evenly(kBedThickness, sizes.thickness), evenly(kBedWidth, sizes.width), {kBedPitch, 0.0, 0.03}, {kBedRoll, 0.0, 0.03}}}; }

// Of a length whose end no ray shows the classes tell so much; where one is seen it must not pull.
constexpr double kLengthSpread = 0.7;  // m

using Normal = Eigen::Matrix<double, kBedValues, kBedValues>;

// What a fit goes by.
class Statements {
 public:
  Statements(const std::vector<BedConstraint>& all, int open_end, const Known& known) : all_(all), open_end_(open_end), known_(known) {}

  // Of the residuals, each weighted as the loss weights it, and of what is known. Rays that share a wall share its mud, its bends and what was wrongly
  // decided of an edge, so they tell less than as many that do not; returns in a corner may be of either wall, and tell nothing of one.
  [[nodiscard]] Normal information(const BedVector& values) const {
    Normal sum = Normal::Zero();
    const BedAxes axes(values);
    BedVector slope;
    for (const BedConstraint& c : all_) {
      if (c.in_corner) continue;
      const double r = residual(c, axes, values, open_end_, &slope);
      sum += slope * slope.transpose() / (1.0 + r * r / (kRobust * kRobust));
    }
    sum = sum / kShared + Normal::Identity() * 1e-6;
    for (const KnownValue& k : known_) sum(k.which, k.which) += 1.0 / (k.deviation * k.deviation);
    sum(kBedLength, kBedLength) += 1.0 / (kLengthSpread * kLengthSpread);
    return sum;
  }

 private:
  const std::vector<BedConstraint>& all_;
  int open_end_;
  const Known& known_;
};

FittedBed fit(const BedPose& start, const std::vector<Ray>& all_rays, const PackedRays& packed, int rounds, const BedSizes& sizes, BedSolver solver) {
  const Known known = known_of(sizes);
  FitRays rays(start, all_rays, packed, kSpeaking, kSpeakingBelow);
  FittedBed fit;
  fit.pose = start;
  for (int round = 0; round < rounds; ++round) {
    std::vector<BedConstraint> statements = rays.constraints(fit.pose);
    for (BedConstraint& c : statements)
      if (c.edge && c.bound.axis != 0) c.deviation *= std::pow(kBlur, std::max(0, rounds - 2 - round));
    fit.residuals = static_cast<int>(statements.size());
    if (fit.residuals < kResidualsLeast) return fit;
    BedVector values = values_of(fit.pose);
    // Ceres has the last word, from where the sums come to: its own steps, with a Jacobian and in double precision, take much longer.
    const bool last = round + 1 == rounds, exact = last || solver == BedSolver::ceres;
    solve_bed(statements, start.open_end, known, kIterations, exact ? kCostStep : kCostStepBefore, values);
    if (last && solver == BedSolver::ceres && values.allFinite()) solve_bed_by_ceres(statements, start.open_end, known, kIterations, kCostStep, values);
    if (!values.allFinite()) return fit;
    set_values(fit.pose, values);
    fit.pose.yaw = std::remainder(fit.pose.yaw, 2 * std::numbers::pi);
    fit.pose.thickness = std::clamp(fit.pose.thickness, std::max(kThinnest, sizes.thickness[0] - kThicknessSlack), sizes.thickness[1] + kThicknessSlack);
    if (round + 1 < rounds) continue;
    fit.converged = true;
    fit.statements = std::move(statements);
    fit.values = values;
  }
  return fit;
}

}  // namespace

FittedBed fit_bed(const BedPose& start, const std::vector<Ray>& rays, int rounds, const BedSizes& sizes, BedSolver solver) {
  FittedBed out = fit(start, rays, PackedRays(rays), rounds, sizes, solver);
  find_covariance(out, sizes);
  return out;
}
FittedBed fit_pose(const BedPose& start, const std::vector<Ray>& rays, const PackedRays& packed, int rounds, const BedSizes& sizes) {
  return fit(start, rays, packed, rounds, sizes, BedSolver::sums);
}

void find_covariance(FittedBed& fit, const BedSizes& sizes) {
  if (!fit.converged) return;
  const Known known = known_of(sizes);
  const Normal inverse = Eigen::LDLT<Normal>(Statements(fit.statements, fit.pose.open_end, known).information(fit.values)).solve(Normal::Identity());
  fit.covariance = inverse.topLeftCorner<8, 8>();
  for (int i = 0; i < 8; ++i) fit.covariance(i, i) += kBodyDeviation[static_cast<std::size_t>(i)] * kBodyDeviation[static_cast<std::size_t>(i)];
}

std::array<Eigen::Vector3d, 4> opening_corners(const BedPose& pose) {
  const Eigen::Matrix3d r = pose.rotation();
  const double x = pose.length / 2, y = pose.width / 2;
  std::array<Eigen::Vector3d, 4> out;
  const double signs[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
  for (std::size_t i = 0; i < 4; ++i) out[i] = pose.middle + r * Eigen::Vector3d(signs[i][0] * x, signs[i][1] * y, 0.0);
  return out;
}

Matrix12d corner_covariance(const FittedBed& fit) {
  Eigen::Matrix<double, 12, 8> slope;
  const auto moved = [&](int which, double by) {
    BedPose p = fit.pose;
    double* const places[8] = {&p.middle.x(), &p.middle.y(), &p.middle.z(), &p.yaw, &p.pitch, &p.roll, &p.length, &p.width};
    *places[which] += by;
    return opening_corners(p);
  };
  for (int k = 0; k < 8; ++k) {
    const auto more = moved(k, 1e-5), less = moved(k, -1e-5);
    for (int i = 0; i < 4; ++i) slope.block<3, 1>(3 * i, k) = (more[static_cast<std::size_t>(i)] - less[static_cast<std::size_t>(i)]) / 2e-5;
  }
  return slope * fit.covariance * slope.transpose();
}

}  // namespace berm::app
