#include "recognition/fans.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace berm::app {
namespace {

constexpr double kRangeLimit = 30.0;     // m
constexpr std::size_t kLeastReturns = 8; // of a fan
constexpr double kSearchStep = 0.0175;   // rad between fans
constexpr double kOffPlane = 0.02;       // m, root mean square of the sensor's place over the fans' planes

using Eigen::Vector2d;

struct FanPlane {
  Vector2d normal;  // horizontal, unit
  double offset, time;
};

// The upright plane of a fan's returns; false when they spread too little.
bool fit_plane(std::span<const FanReturn> returns, FanPlane& out) {
  Vector2d mean = Vector2d::Zero();
  for (const FanReturn& r : returns) mean += r.at.head<2>();
  mean /= static_cast<double>(returns.size());
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const FanReturn& r : returns) {
    const Vector2d d = r.at.head<2>() - mean;
    xx += d.x() * d.x();
    xy += d.x() * d.y();
    yy += d.y() * d.y();
  }
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  out.normal = {-std::sin(angle), std::cos(angle)};
  out.offset = out.normal.dot(mean);
  return xx + yy > 0.05 * static_cast<double>(returns.size());
}

Vector2d turned(const Vector2d& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

FanSweep failed(const char* reason) {
  FanSweep sweep;
  sweep.reason = reason;
  return sweep;
}

void find_directions(FanSweep& sweep) {
  sweep.directions.resize(sweep.returns.size());
  sweep.plans.reserve(sweep.heads.size());
  for (std::size_t fan = 0; fan < sweep.heads.size(); ++fan) {
    const Eigen::Vector3d& head = sweep.heads[fan];
    FanPlan plan{Vector2d::Zero(), 0.0};
    double farthest = 0.0;  // the longest ray's direction is the fan's
    for (std::size_t k = sweep.begin[fan]; k < sweep.begin[fan + 1]; ++k) {
      const Eigen::Vector3d d = sweep.returns[k].at - head;
      const double level = std::max(d.head<2>().norm(), 1e-9);
      sweep.directions[k] = {d.head<2>() / level, d.z() / level};
      if (level > farthest) farthest = level, plan.normal = {-sweep.directions[k].level.y(), sweep.directions[k].level.x()};
    }
    for (std::size_t k = sweep.begin[fan]; k < sweep.begin[fan + 1]; ++k) plan.spread = std::max(plan.spread, std::abs(plan.normal.dot(sweep.directions[k].level)));
    sweep.plans.push_back(plan);
  }
}

}  // namespace

FanSweep make_fans(const std::vector<ScanPoint>& points, const std::array<double, 3>& viewpoint) {
  FanSweep sweep;
  const Eigen::Vector3d head(viewpoint[0], viewpoint[1], viewpoint[2]);
  std::vector<FanPlane> planes;
  sweep.returns.reserve(points.size());
  for (std::size_t i = 0; i < points.size();) {
    std::size_t end = i;
    const std::size_t first = sweep.returns.size();
    for (; end < points.size() && points[end].scanline == points[i].scanline; ++end) {
      const Eigen::Vector3d at(static_cast<double>(points[end].x), static_cast<double>(points[end].y), static_cast<double>(points[end].z));
      if ((at - head).squaredNorm() < kRangeLimit * kRangeLimit) sweep.returns.push_back({at, static_cast<std::uint32_t>(sweep.heads.size())});
    }
    FanPlane plane{Vector2d::Zero(), 0.0, 0.5 * (points[i].time_s + points[end - 1].time_s)};
    const std::span<const FanReturn> own(sweep.returns.data() + first, sweep.returns.size() - first);
    if (own.size() >= kLeastReturns && fit_plane(own, plane)) {
      planes.push_back(plane);
      sweep.heads.push_back(head);
      sweep.begin.push_back(first);
    } else {
      sweep.returns.resize(first);
    }
    i = end;
  }
  sweep.begin.push_back(sweep.returns.size());
  if (planes.size() < 10) return failed("the sweep has fewer than 10 scanlines with 8 returns within 30 m");

  double middle = 0.0;
  for (const FanPlane& p : planes) middle += p.time / static_cast<double>(planes.size());
  const auto residual = [&](const FanPlane& p, double angle, double rate) {
    return p.normal.dot(turned(head.head<2>(), angle + rate * (p.time - middle))) - p.offset;
  };
  double angle = 0.0, rate = 0.0, error = 0.0;
  for (int round = 0; round < 8; ++round) {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Identity() * 1e-9;
    Vector2d right = Vector2d::Zero();
    error = 0.0;
    for (const FanPlane& p : planes) {
      const double e = residual(p, angle, rate), dt = p.time - middle;
      const Vector2d place = turned(head.head<2>(), angle + rate * dt), way(-place.y(), place.x());
      const Vector2d slope = p.normal.dot(way) * Vector2d(1.0, dt);
      normal += slope * slope.transpose();
      right -= slope * e;
      error += e * e / static_cast<double>(planes.size());
    }
    if (round == 0 && error < 1e-6) break;
    const Vector2d step = normal.ldlt().solve(right);
    angle += step.x();
    rate += step.y();
    if (step.norm() < 1e-9) break;
  }
  if (!(std::sqrt(error) < kOffPlane))
    return failed("the scanlines are no upright fans through the viewpoint, standing or swinging");
  for (std::size_t k = 0; k < planes.size(); ++k) sweep.heads[k].head<2>() = turned(head.head<2>(), angle + rate * (planes[k].time - middle));
  sweep.swing_rate = rate;
  std::vector<double> steps;
  for (std::size_t k = 1; k < planes.size(); ++k) {
    const Vector2d &a = planes[k - 1].normal, &b = planes[k].normal;
    steps.push_back(std::abs(std::remainder(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)), std::numbers::pi)));
  }
  const auto middle_step = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle_step, steps.end());
  sweep.step = *middle_step;
  find_directions(sweep);
  return sweep;
}

FanSweep thinned(const FanSweep& sweep) {
  const auto stride = static_cast<std::size_t>(std::max(1.0, std::round(kSearchStep / std::max(sweep.step, 1e-4))));
  FanSweep out;
  out.swing_rate = sweep.swing_rate;
  out.step = static_cast<double>(stride) * sweep.step;
  out.returns.reserve(sweep.returns.size() / stride + 1);
  for (std::size_t fan = 0; fan < sweep.heads.size(); fan += stride) {
    out.begin.push_back(out.returns.size());
    for (const FanReturn& r : sweep.of(fan)) out.returns.push_back({r.at, static_cast<std::uint32_t>(out.heads.size())});
    const auto begin = sweep.directions.begin() + static_cast<std::ptrdiff_t>(sweep.begin[fan]);
    out.directions.insert(out.directions.end(), begin, begin + static_cast<std::ptrdiff_t>(sweep.begin[fan + 1] - sweep.begin[fan]));
    out.heads.push_back(sweep.heads[fan]);
    out.plans.push_back(sweep.plans[fan]);
  }
  out.begin.push_back(out.returns.size());
  return out;
}

}  // namespace berm::app
