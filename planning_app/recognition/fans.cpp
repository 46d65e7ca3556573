#include "recognition/fans.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace berm::app {
namespace {

constexpr double kRangeLimit = 30.0;     // m
constexpr std::size_t kLeastReturns = 8; // of a fan
constexpr std::size_t kLeastFans = 10;
constexpr double kSearchStep = 0.0175;   // rad between fans
constexpr double kOffPlane = 0.02;       // m, root mean square of the sensor's place over the fans' planes

using Eigen::Vector2d;

// The upright plane of a fan's returns; false when they spread too little.
bool fit_plane(std::span<const FanReturn> returns, FanPlane& out) {
  Vector2d mean = Vector2d::Zero();
  for (const FanReturn& r : returns) mean += r.place.head<2>().cast<double>();
  mean /= static_cast<double>(returns.size());
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const FanReturn& r : returns) {
    const Vector2d d = r.place.head<2>().cast<double>() - mean;
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

// Of a fan whose returns and head stand in the sweep.
void find_directions(FanSweep& sweep, std::size_t fan) {
  const Eigen::Vector3f head = sweep.heads[fan].cast<float>();
  const std::size_t begin = sweep.begin[fan], end = sweep.begin[fan + 1];
  FanDirections& to = sweep.directions;
  float farthest = 0.0F;  // the longest ray's direction is the fan's
  Eigen::Vector2f normal = Eigen::Vector2f::Zero();
  for (std::size_t k = begin; k < end; ++k) {
    const Eigen::Vector3f d = sweep.returns[k].place - head;
    const float level = std::max(std::sqrt(d.x() * d.x() + d.y() * d.y()), 1e-9F), one = 1.0F / level;
    to.x[k] = d.x() * one, to.y[k] = d.y() * one, to.slope[k] = d.z() * one;
    if (level > farthest) farthest = level, normal = {-to.y[k], to.x[k]};
  }
  float spread = 0.0F;
  for (std::size_t k = begin; k < end; ++k) spread = std::max(spread, std::abs(normal.x() * to.x[k] + normal.y() * to.y[k]));
  sweep.plans[fan] = {normal.cast<double>(), static_cast<double>(spread)};
}

}  // namespace

Eigen::Vector3d head_turned(const Eigen::Vector3d& head, double angle) {
  if (angle == 0.0) return head;
  Eigen::Vector3d out = head;
  out.head<2>() = turned(head.head<2>(), angle);
  return out;
}

std::optional<FanPlane> append_fan(FanSweep& sweep, std::span<const ScanPoint> scanline, const Eigen::Vector3d& head) {
  if (scanline.empty()) return std::nullopt;
  const std::size_t first = sweep.returns.size();
  for (const ScanPoint& p : scanline) {
    const FanReturn r{{p.x, p.y, p.z}};
    if ((r.at() - head).squaredNorm() < kRangeLimit * kRangeLimit) sweep.returns.push_back(r);
  }
  FanPlane plane{Vector2d::Zero(), 0.0, 0.5 * (scanline.front().time_s + scanline.back().time_s), 0.0};
  const std::span<const FanReturn> own(sweep.returns.data() + first, sweep.returns.size() - first);
  if (own.size() < kLeastReturns || !fit_plane(own, plane)) {
    sweep.returns.resize(first);
    return std::nullopt;
  }
  sweep.heads.push_back(head);
  if (sweep.begin.empty()) sweep.begin.push_back(0);
  sweep.begin.push_back(sweep.returns.size());
  sweep.directions.resize(sweep.returns.size());
  sweep.plans.emplace_back();
  find_directions(sweep, sweep.heads.size() - 1);
  return plane;
}

double turn_between(const FanPlane& one, const FanPlane& next) {
  const Vector2d &a = one.normal, &b = next.normal;
  return std::remainder(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)), std::numbers::pi);
}

double median_of(std::vector<double> steps) {
  if (steps.empty()) return 0.0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

SwingOfHead swing_of_head(const std::vector<FanPlane>& planes, const Eigen::Vector3d& head) {
  SwingOfHead swing;
  if (planes.size() < kLeastFans) {
    swing.reason = "the sweep has fewer than 10 scanlines with 8 returns within 30 m";
    return swing;
  }
  bool told = false;
  for (const FanPlane& p : planes) {
    swing.middle += p.time / static_cast<double>(planes.size());
    told = told || p.turned != 0.0;
  }
  const double as_told = told ? kOffPlane * kOffPlane : 1e-6;  // a fan that is measured while the machine swings is twisted a little
  const auto residual = [&](const FanPlane& p) { return p.normal.dot(turned(head.head<2>(), p.turned + swing.at(p.time))) - p.offset; };
  double error = 0.0;
  for (int round = 0; round < 8; ++round) {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Identity() * 1e-9;
    Vector2d right = Vector2d::Zero();
    error = 0.0;
    for (const FanPlane& p : planes) {
      const double e = residual(p), dt = p.time - swing.middle;
      const Vector2d place = turned(head.head<2>(), p.turned + swing.angle + swing.rate * dt), way(-place.y(), place.x());
      const Vector2d slope = p.normal.dot(way) * Vector2d(1.0, dt);
      normal += slope * slope.transpose();
      right -= slope * e;
      error += e * e / static_cast<double>(planes.size());
    }
    if (round == 0 && error < as_told) break;
    const Vector2d step = normal.ldlt().solve(right);
    swing.angle += step.x();
    swing.rate += step.y();
    if (step.norm() < 1e-9) break;
  }
  if (!(std::sqrt(error) < kOffPlane)) swing.reason = "the scanlines are no upright fans through the viewpoint, standing or swinging";
  return swing;
}

void place_heads(FanSweep& sweep, const std::vector<FanPlane>& planes, const Eigen::Vector3d& head, const SwingOfHead& swing) {
  for (std::size_t fan = 0; fan < planes.size(); ++fan) {
    sweep.heads[fan] = head;
    sweep.heads[fan].head<2>() = turned(head.head<2>(), planes[fan].turned + swing.at(planes[fan].time));
    find_directions(sweep, fan);
  }
}

FanSweep make_fans(std::span<const ScanPoint> points, const std::array<double, 3>& viewpoint) {
  FanSweep sweep;
  const Eigen::Vector3d head(viewpoint[0], viewpoint[1], viewpoint[2]);
  std::vector<FanPlane> planes;
  std::vector<double> steps;
  sweep.returns.reserve(points.size());
  sweep.directions.reserve(points.size());
  visit_scanlines(points, [&](std::span<const ScanPoint> scanline) {
    const auto plane = append_fan(sweep, scanline, head);
    if (!plane) return;
    if (!planes.empty()) steps.push_back(std::abs(turn_between(planes.back(), *plane)));
    planes.push_back(*plane);
  });
  const SwingOfHead swing = swing_of_head(planes, head);
  if (!swing.reason.empty()) sweep = {};
  sweep.reason = swing.reason;
  if (!sweep.reason.empty()) return sweep;
  if (!swing.stands()) place_heads(sweep, planes, head, swing);
  sweep.swing_rate = swing.rate;
  sweep.step = median_of(std::move(steps));
  return sweep;
}

std::size_t thinning(double step) { return static_cast<std::size_t>(std::max(1.0, std::round(kSearchStep / std::max(step, 1e-4)))); }

void append_thinned(FanSweep& out, const FanSweep& sweep, std::size_t fan) {
  for (const FanReturn& r : sweep.of(fan)) out.returns.push_back({r.place});
  const auto first = static_cast<std::ptrdiff_t>(sweep.begin[fan]), end = static_cast<std::ptrdiff_t>(sweep.begin[fan + 1]);
  for (std::vector<float> FanDirections::*of : {&FanDirections::x, &FanDirections::y, &FanDirections::slope}) {
    const std::vector<float>& from = sweep.directions.*of;
    std::vector<float>& to = out.directions.*of;
    to.insert(to.end(), from.begin() + first, from.begin() + end);
  }
  out.heads.push_back(sweep.heads[fan]);
  out.plans.push_back(sweep.plans[fan]);
  if (out.begin.empty()) out.begin.push_back(0);
  out.begin.push_back(out.returns.size());
}

FanSweep thinned(const FanSweep& sweep) {
  const std::size_t stride = thinning(sweep.step);
  FanSweep out;
  out.swing_rate = sweep.swing_rate;
  out.step = static_cast<double>(stride) * sweep.step;
  out.returns.reserve(sweep.returns.size() / stride + 1);
  for (std::size_t fan = 0; fan < sweep.heads.size(); fan += stride) append_thinned(out, sweep, fan);
  return out;
}

}  // namespace berm::app
