#include "identify/step_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "motion/joint_response.hpp"

namespace berm::identify {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

enum Parameter : Eigen::Index { kDeadTime, kLag, kStopLag, kGain, kRates };  // then speeding and slowing of each load and reach

constexpr double kNormal95 = 1.96;
constexpr double kLeastRate = 0.01, kLeastLag = 0.0, kMostLag = 2.0;
constexpr int kIterations = 60;
constexpr double kLeastSeenLag = 1e-3;  // s
constexpr double kSettled = 1e-9;   // of the sum of squares, relative
constexpr double kMostDamping = 1e9;

Eigen::Index rate_index(std::size_t reaches, bool slowing, bool loaded, std::size_t reach) {
  return kRates + static_cast<Eigen::Index>(((slowing ? 2u : 0u) + (loaded ? 1u : 0u)) * reaches + reach);
}

app::JointResponse response_of(const VectorXd& p, std::size_t reaches, const StepPlan& plan, double speed_max) {
  return {p[kDeadTime], p[rate_index(reaches, false, plan.loaded, plan.reach)], speed_max, p[kLag], p[kStopLag],
          p[rate_index(reaches, true, plan.loaded, plan.reach)], p[kGain]};
}

// From standstill. A command acts dead_time after the reading that it answered, wherever between two readings that falls.
std::vector<double> speeds_of(const app::JointResponse& response, const std::vector<StepSample>& samples) {
  std::vector<double> speeds{0.0};
  const double cycle = (samples.back().time_s - samples.front().time_s) / static_cast<double>(samples.size() - 1);
  const auto whole = static_cast<std::ptrdiff_t>(response.dead_time / cycle);
  const double rest = response.dead_time - static_cast<double>(whole) * cycle;
  const auto command = [&](std::ptrdiff_t k) { return k < 0 ? 0.0 : samples[static_cast<std::size_t>(k)].command; };
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const auto k = static_cast<std::ptrdiff_t>(i) - 1 - whole;
    const double between = app::speed_after(response, speeds.back(), command(k - 1), rest);
    speeds.push_back(app::speed_after(response, between, command(k), cycle - rest));
  }
  return speeds;
}

class Problem {
 public:
  Problem(const std::vector<const StepRecord*>& records, std::size_t reaches, double speed_max) : records_(records), reaches_(reaches), speed_max_(speed_max) {
    for (const StepRecord* record : records_) size_ += static_cast<Eigen::Index>(record->samples.size());
  }
  VectorXd residuals(const VectorXd& p) const {
    VectorXd out(size_);
    Eigen::Index at = 0;
    for (const StepRecord* record : records_) {
      const auto speeds = speeds_of(response_of(p, reaches_, record->plan, speed_max_), record->samples);
      for (std::size_t i = 0; i < speeds.size(); ++i) out[at++] = record->samples[i].speed - speeds[i];
    }
    return out;
  }
  // Of the model, by differences; towards larger values where a limit is near.
  MatrixXd jacobian(const VectorXd& p) const {
    MatrixXd out(size_, p.size());
    for (Eigen::Index k = 0; k < p.size(); ++k) {
      const double step = k <= kStopLag ? 5e-4 : 1e-3 * p[k];
      VectorXd low = p, high = p;
      high[k] += step;
      if (k > kStopLag || p[k] >= step) low[k] -= step;
      out.col(k) = (residuals(low) - residuals(high)) / (high[k] - low[k]);
    }
    return out;
  }
  const std::vector<const StepRecord*>& records() const { return records_; }

 private:
  const std::vector<const StepRecord*>& records_;
  std::size_t reaches_;
  double speed_max_;
  Eigen::Index size_ = 0;
};

void keep_in_limits(VectorXd& p) {
  for (Eigen::Index k = 0; k < p.size(); ++k) p[k] = k <= kStopLag ? std::clamp(p[k], kLeastLag, kMostLag) : std::max(p[k], kLeastRate);
}

// Levenberg and Marquardt.
VectorXd minimised(const Problem& problem, VectorXd p) {
  VectorXd r = problem.residuals(p);
  double damping = 1e-3;
  for (int i = 0; i < kIterations && damping < kMostDamping; ++i) {
    const MatrixXd j = problem.jacobian(p);
    const MatrixXd normal = j.transpose() * j;
    const VectorXd slope = j.transpose() * r;
    const double before = r.squaredNorm();
    for (; damping < kMostDamping; damping *= 4.0) {
      MatrixXd damped = normal;
      damped.diagonal() *= 1.0 + damping;
      damped.diagonal().array() += 1e-12;
      VectorXd next = p + damped.ldlt().solve(slope);
      keep_in_limits(next);
      const VectorXd then = problem.residuals(next);
      if (then.squaredNorm() >= before) continue;
      p = next;
      r = then;
      damping = std::max(1e-9, 0.1 * damping);
      break;
    }
    if (before - r.squaredNorm() < kSettled * before) break;
  }
  return p;
}

// A lag too short to be seen is none: the model does not depend on it there, and nothing can be said of its confidence.
bool unseen(const VectorXd& p, Eigen::Index k) { return (k == kLag || k == kStopLag) && p[k] < kLeastSeenLag; }

// Of the parameters, by records; j without the columns of what was not seen.
MatrixXd covariance(const Problem& problem, const MatrixXd& j, const VectorXd& r) {
  const MatrixXd normal = j.transpose() * j;
  for (Eigen::Index k = 0; k < normal.rows(); ++k)
    if (normal(k, k) <= 0.0) throw std::runtime_error("the step responses do not determine the model: a load or reach has none");
  const MatrixXd inverse = normal.ldlt().solve(MatrixXd::Identity(normal.rows(), normal.cols()));
  MatrixXd spread = MatrixXd::Zero(normal.rows(), normal.cols());
  Eigen::Index at = 0;
  for (const StepRecord* record : problem.records()) {
    const auto count = static_cast<Eigen::Index>(record->samples.size());
    const VectorXd pull = j.middleRows(at, count).transpose() * r.segment(at, count);
    spread += pull * pull.transpose();
    at += count;
  }
  const auto records = static_cast<double>(problem.records().size());
  return inverse * spread * inverse * records / std::max(1.0, records - 1.0);
}

double root_mean_square(const VectorXd& r) { return std::sqrt(r.squaredNorm() / static_cast<double>(r.size())); }

}  // namespace

StepFit fit_steps(const std::vector<const StepRecord*>& records, std::size_t reaches, double speed_max, double rate) {
  VectorXd p = VectorXd::Constant(rate_index(reaches, true, true, reaches), rate);
  p[kDeadTime] = 0.05;
  p[kLag] = 0.1;
  p[kStopLag] = 0.02;
  p[kGain] = 1.0;
  const Problem problem(records, reaches, speed_max);
  p = minimised(problem, p);
  std::vector<Eigen::Index> seen;
  for (Eigen::Index k = 0; k < p.size(); ++k) {
    if (unseen(p, k)) p[k] = 0.0;
    else seen.push_back(k);
  }
  const VectorXd r = problem.residuals(p);
  const MatrixXd c = covariance(problem, problem.jacobian(p)(Eigen::all, seen), r);
  const auto fitted = [&](Eigen::Index k) {
    const auto at = std::find(seen.begin(), seen.end(), k);
    if (at == seen.end()) return Fitted{0.0, 0.0};
    const Eigen::Index i = at - seen.begin();
    return Fitted{p[k], kNormal95 * std::sqrt(std::max(0.0, c(i, i)))};
  };
  StepFit fit;
  fit.dead_time = fitted(kDeadTime), fit.lag = fitted(kLag), fit.stop_lag = fitted(kStopLag), fit.gain = fitted(kGain);
  for (const bool loaded : {false, true}) {
    for (std::size_t reach = 0; reach < reaches; ++reach) {
      fit.speeding[loaded].push_back(fitted(rate_index(reaches, false, loaded, reach)));
      fit.slowing[loaded].push_back(fitted(rate_index(reaches, true, loaded, reach)));
    }
  }
  fit.residual = root_mean_square(r);
  fit.records = records.size();
  Eigen::Index at = 0;
  for (const StepRecord* record : records) {
    const auto count = static_cast<Eigen::Index>(record->samples.size());
    fit.worst_residual = std::max(fit.worst_residual, root_mean_square(r.segment(at, count)));
    at += count;
  }
  fit.samples = static_cast<std::size_t>(at);
  return fit;
}

std::vector<double> fitted_speeds(const StepFit& fit, const StepRecord& record, double speed_max) {
  const StepPlan& plan = record.plan;
  return speeds_of({fit.dead_time.value, fit.speeding[plan.loaded][plan.reach].value, speed_max, fit.lag.value, fit.stop_lag.value,
                    fit.slowing[plan.loaded][plan.reach].value, fit.gain.value},
                   record.samples);
}

}  // namespace berm::identify
