#include "gathering/scan_frame.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace berm::app {

std::optional<PlanarScan> fit_scan(std::span<const ScanPoint> points, const Eigen::Vector3d& origin, const Eigen::Isometry3d* before) {
  constexpr double kOffPlane = 0.035, kSpread = 0.05;  // radians
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> rays;
  rays.reserve(points.size());
  for (const ScanPoint& p : points) {
    const Eigen::Vector3d ray = Eigen::Vector3d(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)) - origin;
    const double range = ray.norm();
    if (!(range > 1e-3)) continue;
    rays.push_back(ray);
    spread += ray * ray.transpose() / (range * range);
    mean += ray / range;
  }
  if (rays.size() < 2) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread / static_cast<double>(rays.size()));
  if (axes.eigenvalues()[1] < kSpread * kSpread || axes.eigenvalues()[0] > kOffPlane * kOffPlane) return std::nullopt;
  Eigen::Vector3d normal = axes.eigenvectors().col(0);
  if (before != nullptr && normal.dot(before->linear().col(2)) < 0.0) normal = -normal;
  Eigen::Vector3d x = before != nullptr ? Eigen::Vector3d(before->linear().col(0)) : mean;
  x -= x.dot(normal) * normal;
  if (x.norm() < 1e-6) x = axes.eigenvectors().col(2);
  x.normalize();
  PlanarScan out;
  out.frame.setIdentity();
  out.frame.linear() << x, normal.cross(x), normal;
  out.frame.translation() = origin;
  out.returns.reserve(rays.size());
  for (const Eigen::Vector3d& ray : rays) out.returns.push_back({std::atan2(ray.dot(out.frame.linear().col(1)), ray.dot(x)), ray.norm()});
  std::sort(out.returns.begin(), out.returns.end(), [](const PolarReturn& p, const PolarReturn& q) { return p.angle_rad < q.angle_rad; });
  return out;
}

}  // namespace berm::app
