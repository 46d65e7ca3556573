#include "recognition/bed_fit.hpp"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "recognition/bed_constraints.hpp"

namespace berm::app {
namespace {

enum Parameter { kX, kY, kZ, kYaw, kPitch, kRoll, kLength, kWidth, kThickness, kParameters };
constexpr double kRobust = 2.0;               // of the Cauchy loss, in standard deviations
constexpr double kThicknessSpread = 0.025;    // m, of the classes' walls
constexpr double kWidthUsual = 2.38, kWidthSpread = 0.15;  // m, of beds that drive on roads
constexpr double kTiltSpread = 0.03;          // rad

constexpr double kShared = 3.0;               // rays that count as one
// Of middle x y z (m), yaw, pitch, roll (rad), length and width (m) by the body alone; calibrated on drawn scenes.
constexpr std::array<double, 8> kBodyDeviation{0.008, 0.008, 0.004, 0.001, 0.002, 0.003, 0.012, 0.010};

using Normal = Eigen::Matrix<double, kParameters, kParameters>;

// One statement of a ray, with its derivatives after all nine parameters.
class RayCost : public ceres::SizedCostFunction<1, kParameters> {
 public:
  RayCost(const BedConstraint& constraint, int open_end) : c_(constraint), open_end_(open_end) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    using Jet = ceres::Jet<double, kParameters>;
    if (jacobians == nullptr || jacobians[0] == nullptr) {
      residuals[0] = value<double>(parameters[0]);
      return true;
    }
    std::array<Jet, kParameters> p;
    for (int i = 0; i < kParameters; ++i) p[static_cast<std::size_t>(i)] = Jet(parameters[0][i], i);
    const Jet r = value<Jet>(p.data());
    residuals[0] = r.a;
    for (int i = 0; i < kParameters; ++i) jacobians[0][i] = r.v[i];
    return true;
  }

 private:
  template <typename T>
  T face(const T* p, const BedPlane& plane) const {
    if (plane.axis == 2) return T(0.0);
    const T inner = (plane.axis == 0 ? p[kLength] : p[kWidth]) * 0.5;
    return plane.outer && !(plane.axis == 0 && plane.side == open_end_) ? inner + p[kThickness] : inner;
  }
  template <typename T>
  T value(const T* p) const {
    using std::cos;
    using std::exp;
    using std::log;
    using std::sin;
    using std::sqrt;
    const T cy = cos(p[kYaw]), sy = sin(p[kYaw]), cp = cos(p[kPitch]), sp = sin(p[kPitch]), cr = cos(p[kRoll]), sr = sin(p[kRoll]);
    const T columns[3][3] = {{cy * cp, sy * cp, -sp},
                             {cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr},
                             {cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr}};
    const auto in_bed = [&](const Eigen::Vector3d& q, int axis) {
      return columns[axis][0] * (q.x() - p[kX]) + columns[axis][1] * (q.y() - p[kY]) + columns[axis][2] * (q.z() - p[kZ]);
    };
    const double side = c_.plane.side;
    const T end = in_bed(c_.at, c_.plane.axis) * side, limit = face(p, c_.plane);
    if (!c_.edge) return (end - limit - c_.offset) / c_.deviation;
    const T begin = in_bed(c_.head, c_.plane.axis) * side, share = (limit - begin) / (end - begin);
    const T first = in_bed(c_.head, c_.bound.axis), at = first + share * (in_bed(c_.at, c_.bound.axis) - first);
    const T y = (at * static_cast<double>(c_.bound.side) - face(p, c_.bound)) * (c_.sense / c_.deviation);
    // sqrt(2 log(1 + e^y)): half its square is the logistic function's negative logarithm.
    if (y > T(30.0)) return sqrt(y * 2.0);
    if (y < T(-30.0)) return T(0.0);
    return sqrt(log(exp(y) + 1.0) * 2.0);
  }

  BedConstraint c_;
  int open_end_;
};

// A value known beforehand.
class KnownCost : public ceres::SizedCostFunction<1, kParameters> {
 public:
  KnownCost(int which, double mean, double deviation) : which_(which), mean_(mean), deviation_(deviation) {}
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    residuals[0] = (parameters[0][which_] - mean_) / deviation_;
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      for (int i = 0; i < kParameters; ++i) jacobians[0][i] = 0.0;
      jacobians[0][which_] = 1.0 / deviation_;
    }
    return true;
  }

 private:
  int which_;
  double mean_, deviation_;
};

// The information of the residuals, each weighted as the loss weights it.
Normal information(const std::vector<std::unique_ptr<ceres::CostFunction>>& costs, const ceres::LossFunction& loss, const double* values,
                   std::size_t rays) {
  Normal sum = Normal::Zero();
  for (std::size_t i = 0; i < costs.size(); ++i) {
    double residual = 0.0;
    Eigen::Matrix<double, 1, kParameters> slope;
    double* slopes = slope.data();
    costs[i]->Evaluate(&values, &residual, &slopes);
    double rho[3] = {0.0, 1.0, 0.0};
    if (i < rays) loss.Evaluate(residual * residual, rho);
    sum += rho[1] * slope.transpose() * slope;
  }
  return sum;
}

}  // namespace

FittedBed fit_bed(const BedPose& start, const std::vector<Ray>& rays, int rounds) {
  FittedBed fit;
  fit.pose = start;
  ceres::CauchyLoss loss(kRobust);
  for (int round = 0; round < rounds; ++round) {
    const std::vector<BedConstraint> statements = constraints(fit.pose, rays);
    fit.residuals = static_cast<int>(statements.size());
    if (fit.residuals < 20) return fit;
    BedPose& p = fit.pose;
    double values[kParameters] = {p.middle.x(), p.middle.y(), p.middle.z(), p.yaw, p.pitch, p.roll, p.length, p.width, p.thickness};
    std::vector<std::unique_ptr<ceres::CostFunction>> costs;
    costs.reserve(statements.size() + 4);
    for (const BedConstraint& c : statements) costs.push_back(std::make_unique<RayCost>(c, p.open_end));
    const std::size_t of_rays = costs.size();
    costs.push_back(std::make_unique<KnownCost>(kThickness, 0.095, kThicknessSpread));
    costs.push_back(std::make_unique<KnownCost>(kWidth, kWidthUsual, kWidthSpread));
    costs.push_back(std::make_unique<KnownCost>(kPitch, 0.0, kTiltSpread));
    costs.push_back(std::make_unique<KnownCost>(kRoll, 0.0, kTiltSpread));
    ceres::Problem::Options own;
    own.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    own.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    own.disable_all_safety_checks = true;
    ceres::Problem problem(own);
    for (std::size_t i = 0; i < costs.size(); ++i) problem.AddResidualBlock(costs[i].get(), i < of_rays ? &loss : nullptr, values);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    options.max_num_iterations = 12;
    options.function_tolerance = 1e-5;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (!summary.IsSolutionUsable()) return fit;
    p.middle = {values[kX], values[kY], values[kZ]};
    p.yaw = std::remainder(values[kYaw], 2 * 3.14159265358979323846);
    p.pitch = values[kPitch];
    p.roll = values[kRoll];
    p.length = values[kLength];
    p.width = values[kWidth];
    p.thickness = std::min(0.2, std::max(0.03, values[kThickness]));
    if (round + 1 < rounds) continue;
    fit.converged = true;
    const Eigen::LDLT<Normal> solved(information(costs, loss, values, of_rays) + Normal::Identity() * 1e-6);
    const Normal inverse = solved.solve(Normal::Identity());
    // Rays that share a wall share its mud, its bends and what was wrongly decided of an edge, so they tell less than as many that do not.
    fit.covariance = kShared * inverse.topLeftCorner<8, 8>();
    for (int i = 0; i < 8; ++i) fit.covariance(i, i) += kBodyDeviation[static_cast<std::size_t>(i)] * kBodyDeviation[static_cast<std::size_t>(i)];
  }
  return fit;
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
