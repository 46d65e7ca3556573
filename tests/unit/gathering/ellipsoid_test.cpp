#include "gathering/error_ellipsoid.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace berm::app {
namespace {

Eigen::Matrix3d matrix(const Covariance& c) {
  Eigen::Matrix3d m;
  m << c.xx, c.xy, c.xz, c.xy, c.yy, c.yz, c.xz, c.yz, c.zz;
  return m;
}
Covariance covariance(const Eigen::Matrix3d& m) {
  return {static_cast<float>(m(0, 0)), static_cast<float>(m(0, 1)), static_cast<float>(m(0, 2)),
          static_cast<float>(m(1, 1)), static_cast<float>(m(1, 2)), static_cast<float>(m(2, 2))};
}

class GaussianDraw {
public:
  explicit GaussianDraw(unsigned seed) : engine_(seed) {}
  double normal() { return normal_(engine_); }
  double uniform(double low, double high) { return low + (high - low) * std::uniform_real_distribution<double>()(engine_); }
  Eigen::Vector3d vector() { return {normal(), normal(), normal()}; }
  Eigen::Matrix3d rotation() { return Eigen::Quaterniond(normal(), normal(), normal(), normal()).normalized().toRotationMatrix(); }
  Eigen::Matrix3d spread() {  // of semi-axes from 1 to 20 cm
    const Eigen::Matrix3d r = rotation();
    const Eigen::Vector3d axes(uniform(0.01, 0.2), uniform(0.01, 0.2), uniform(0.01, 0.2));
    return r * axes.cwiseAbs2().asDiagonal() * r.transpose();
  }

private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

// Ranges and angles are disturbed and the points placed through sines and cosines; their spread is what the first-order covariance says.
TEST(ErrorEllipsoid, MonteCarloOfRangeAndAngles) {
  const ScannerDeviations deviations{0.03, 0.004, 0.009};
  GaussianDraw draw(1);
  for (int scene = 0; scene < 5; ++scene) {
    const Eigen::Matrix3d frame = draw.rotation();
    const double range = draw.uniform(1.0, 20.0), angle = draw.uniform(-2.0, 2.0);
    const Eigen::Vector3d beam = frame * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0), normal = frame.col(2);
    const Eigen::Matrix3d ours = matrix(point_covariance(deviations, range, {beam[0], beam[1], beam[2]}, {normal[0], normal[1], normal[2]}));
    Eigen::Matrix3d seen = Eigen::Matrix3d::Zero();
    constexpr int kSamples = 40000;
    for (int i = 0; i < kSamples; ++i) {
      const double r = range + deviations.range_m * draw.normal(), a = angle + deviations.along_rad * draw.normal(),
                   up = deviations.across_rad * draw.normal();
      const Eigen::Vector3d error =
          r * (frame * Eigen::Vector3d(std::cos(a) * std::cos(up), std::sin(a) * std::cos(up), std::sin(up))) - range * beam;
      seen += error * error.transpose() / kSamples;
    }
    EXPECT_LT((ours - seen).norm(), 0.03 * ours.norm()) << "scene " << scene;
    EXPECT_NEAR(largest_half_width(covariance(ours), 2.0), 2.0 * std::sqrt(ours.diagonal().maxCoeff()), 1e-6);
  }
}

// Independent: the space is stretched until the first ellipsoid is the unit ball; then the distance from its centre to the second one by the nearest
// point's own equation.
bool overlap_by_distance(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, const Eigen::Vector3d& between, double& margin) {
  const Eigen::Matrix3d stretch = a.llt().matrixL().solve(Eigen::Matrix3d::Identity());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(stretch * b * stretch.transpose());
  const Eigen::Vector3d centre = axes.eigenvectors().transpose() * stretch * between, squared = axes.eigenvalues();
  const auto outside = [&](double t) {
    double sum = -1.0;
    for (int i = 0; i < 3; ++i) sum += squared[i] * centre[i] * centre[i] / ((squared[i] + t) * (squared[i] + t));
    return sum;
  };
  if (outside(0.0) <= 0.0) {
    margin = 1.0;
    return true;
  }
  double low = 0.0, high = 1.0;
  while (outside(high) > 0.0) high *= 2.0;
  for (int i = 0; i < 200; ++i) (outside(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
  double distance = 0.0;
  for (int i = 0; i < 3; ++i) distance += std::pow(centre[i] * low / (squared[i] + low), 2);
  margin = std::abs(std::sqrt(distance) - 1.0);
  return distance <= 1.0;
}

TEST(ErrorEllipsoid, OverlapAgainstDistance) {
  GaussianDraw draw(2);
  int overlapping = 0, decided = 0;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Matrix3d a = draw.spread(), b = draw.spread();
    const Eigen::Vector3d between = 0.25 * draw.vector();
    const double quantile = draw.uniform(0.5, 3.0);
    double margin = 0.0;
    const bool expected = overlap_by_distance(quantile * quantile * a, quantile * quantile * b, between, margin);
    if (margin < 1e-3) continue;  // beyond what single precision decides
    ++decided;
    overlapping += expected ? 1 : 0;
    const Vector3 apart{between[0], between[1], between[2]};
    ASSERT_EQ(ellipsoids_overlap(covariance(a), covariance(b), apart, quantile), expected) << "case " << i << ", margin " << margin;
    if (expected) {
      EXPECT_LE(ellipsoid_separation(covariance(a), covariance(b), apart, quantile), 1.001);
    }
  }
  EXPECT_GT(overlapping, decided / 5);
  EXPECT_LT(overlapping, decided * 4 / 5);
}

TEST(ErrorEllipsoid, SpheresTouchWhereTheirRadiiAddUp) {
  const Covariance one{1, 0, 0, 1, 0, 1}, four{4, 0, 0, 4, 0, 4};
  EXPECT_TRUE(ellipsoids_overlap(one, four, {2.999, 0, 0}, 1.0));
  EXPECT_FALSE(ellipsoids_overlap(one, four, {3.001, 0, 0}, 1.0));
  EXPECT_TRUE(ellipsoids_overlap(one, four, {0, 5.999, 0}, 2.0));
  EXPECT_FALSE(ellipsoids_overlap(one, four, {0, 6.001, 0}, 2.0));
}

// Two measurements of one place are drawn again and again: the merged point's errors are what its covariance says, and smaller than either's.
TEST(ErrorEllipsoid, MonteCarloOfMerging) {
  GaussianDraw draw(3);
  for (int scene = 0; scene < 4; ++scene) {
    const Eigen::Matrix3d a = draw.spread(), b = draw.spread(), root_a = a.llt().matrixL(), root_b = b.llt().matrixL();
    Eigen::Matrix3d seen = Eigen::Matrix3d::Zero(), said = seen;
    constexpr int kSamples = 30000;
    for (int i = 0; i < kSamples; ++i) {
      const Eigen::Vector3d first = root_a * draw.vector(), second = root_b * draw.vector(), between = second - first;
      const FusedPoint fused = fuse_points(covariance(a), covariance(b), {between[0], between[1], between[2]}, 0.0);
      const Eigen::Vector3d error = first + Eigen::Vector3d(fused.shift[0], fused.shift[1], fused.shift[2]);
      seen += error * error.transpose() / kSamples;
      said = matrix(fused.covariance);
    }
    EXPECT_LT((seen - said).norm(), 0.04 * said.norm());
    EXPECT_LT(said.determinant(), std::min(a.determinant(), b.determinant()));
  }
  const Covariance tiny{1e-6F, 0, 0, 1e-6F, 0, 1e-6F};
  EXPECT_FLOAT_EQ(fuse_points(tiny, tiny, {0, 0, 0}, 0.005).covariance.yy, 2.5e-5F);
}

}  // namespace
}  // namespace berm::app
