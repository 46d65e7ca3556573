#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "gathering/gatherer.hpp"

namespace berm::app {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

class UniformDraw {
public:
  explicit UniformDraw(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) { return low + (high - low) * std::uniform_real_distribution<double>()(engine_); }

private:
  std::mt19937_64 engine_;
};

Vector3d place(const Isometry3d& frame, const PolarReturn& p) {
  return frame * Vector3d(p.range_m * std::cos(p.angle_rad), p.range_m * std::sin(p.angle_rad), 0);
}

struct Scan {
  Isometry3d frame;
  std::vector<PolarReturn> returns;
};

// Two scans of a pan about an axis that is lever away from the optical centre; ranges rise and fall smoothly, and jump now and then.
std::pair<Scan, Scan> two_scans(UniformDraw& draw, double lever, double turn, double field_rad) {
  Isometry3d base = Isometry3d::Identity();
  base.linear() = Eigen::Quaterniond(draw(-1, 1), draw(-1, 1), draw(-1, 1), draw(-1, 1)).normalized().toRotationMatrix();
  base.translation() = Vector3d(draw(-2, 2), draw(-2, 2), draw(-2, 2));
  const double phase = draw(0, 6);
  const auto scan = [&](double pan) {
    Scan out;
    out.frame = base * Eigen::AngleAxisd(pan, Vector3d::UnitY()) * Eigen::Translation3d(lever, 0, 0);
    for (double angle = -0.5 * field_rad + draw(0, 0.01); angle < 0.5 * field_rad; angle += 0.01) {
      if (draw(0, 1) < 0.1) continue;  // no return
      const double range = 4.0 + std::sin(3.0 * angle + phase) + (std::sin(9.0 * angle + 2.0 * phase) > 0.6 ? -1.5 : 0.0);
      out.returns.push_back({angle, range});
    }
    return out;
  };
  return {scan(0.0), scan(turn)};
}

// Moeller and Trumbore 1997: how many times the ray's length the hit is away; negative when the triangle is missed.
double hit(const Vector3d& origin, const Vector3d& ray, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d e1 = b - a, e2 = c - a, p = ray.cross(e2);
  const double determinant = e1.dot(p);
  if (std::abs(determinant) < 1e-14) return -1.0;
  const Vector3d t = origin - a, q = t.cross(e1);
  const double u = t.dot(p) / determinant, v = ray.dot(q) / determinant;
  return u < 0.0 || v < 0.0 || u + v > 1.0 ? -1.0 : e2.dot(q) / determinant;
}

// The paper's own test over every triangle of the strip and all planes: the ray from the scanner through the place hits a triangle behind the place.
enum class Verdict { kInside, kOutside, kTooNearToSay };
Verdict brute_force(const Scan& a, const Scan& b, const Vector3d& p, double tolerance) {
  const Vector3d origin = 0.5 * (a.frame.translation() + b.frame.translation()), ray = p - origin;
  const double da = a.frame.linear().col(2).dot(p - a.frame.translation()), db = b.frame.linear().col(2).dot(p - b.frame.translation());
  if (std::min(std::abs(da), std::abs(db)) < tolerance * ray.norm()) return Verdict::kTooNearToSay;
  if (da * db > 0.0) return Verdict::kOutside;
  std::size_t i = 0, j = 0;
  while (i + 1 < a.returns.size() || j + 1 < b.returns.size()) {
    const bool first = j + 1 == b.returns.size() || (i + 1 < a.returns.size() && a.returns[i + 1].angle_rad <= b.returns[j + 1].angle_rad);
    const Vector3d next = first ? place(a.frame, a.returns[i + 1]) : place(b.frame, b.returns[j + 1]);
    const double at = hit(origin, ray, place(a.frame, a.returns[i]), place(b.frame, b.returns[j]), next);
    if (at > 0.0) return std::abs(at - 1.0) < tolerance ? Verdict::kTooNearToSay : at > 1.0 ? Verdict::kInside : Verdict::kOutside;
    ++(first ? i : j);
  }
  return Verdict::kOutside;
}

DeletionRule bare() {  // nothing shrunk or widened, gaps looked through
  DeletionRule rule;
  rule.shrink_m = rule.range_m = rule.along_rad = rule.across_rad = 0.0;
  rule.max_gap_rad = 0.5;
  return rule;
}

void against_brute_force(double lever, double field, double tolerance) {
  UniformDraw draw(11);
  int inside = 0, outside = 0, differ = 0;
  for (int scene = 0; scene < 20; ++scene) {
    const auto [a, b] = two_scans(draw, lever, draw(0.005, 0.04), field);
    DeletionVolume volume;
    volume.build(a.frame, a.returns, b.frame, b.returns, bare());
    ASSERT_FALSE(volume.empty());
    for (int k = 0; k < 500; ++k) {
      const double share = draw(-0.5, 1.5), angle = draw(-0.6 * field, 0.6 * field), range = draw(0.5, 6.0);
      const Vector3d from = place(a.frame, {angle, range}), to = place(b.frame, {angle, range}), p = from + share * (to - from);
      const Verdict expected = brute_force(a, b, p, tolerance);
      if (expected == Verdict::kTooNearToSay) continue;
      const bool ours = volume.contains(p.x(), p.y(), p.z());
      ++(expected == Verdict::kInside ? inside : outside);
      differ += ours != (expected == Verdict::kInside) ? 1 : 0;
      if (ours) {  // the bounds for the search hold
        EXPECT_TRUE(volume.box().contains(p));
        EXPECT_LE(std::abs(volume.normal().dot(p - volume.origin())), volume.slab_half_width((p - volume.origin()).norm()));
      }
    }
  }
  printf("%d inside, %d outside, %d decided differently\n", inside, outside, differ);
  EXPECT_GT(inside, 1000);
  EXPECT_GT(outside, 1000);
  // What is left: places beside the jumps of the strip, where a triangle's edge bends between the two ways of looking at it.
  EXPECT_LE(differ, (inside + outside) / 200);
}

TEST(DeletionVolume, AgainstEveryTriangle) { against_brute_force(0.0, 1.5, 2e-3); }
TEST(DeletionVolume, AgainstEveryTriangleBehindTheScannerToo) { against_brute_force(0.0, 4.7, 2e-3); }
TEST(DeletionVolume, AgainstEveryTriangleOnALever) { against_brute_force(0.15, 1.5, 5e-3); }

// A wall seen twice is not deleted; what stands before it is, what stands behind it is not; a gap is not looked through.
TEST(DeletionVolume, ShrinkAndGaps) {
  std::vector<PolarReturn> wall;
  for (double angle = -0.5; angle < 0.5; angle += 0.005)
    if (std::abs(angle - 0.3) > 0.05) wall.push_back({angle, 5.0 / std::cos(angle)});
  const Isometry3d first = Isometry3d::Identity();
  Isometry3d second = first;
  second.linear() = Eigen::AngleAxisd(0.01, Vector3d::UnitY()).toRotationMatrix();
  DeletionRule rule;
  DeletionVolume volume;
  volume.build(first, wall, second, wall, rule);
  const auto at = [&](double range, double angle, double share) {
    const Vector3d p = Eigen::AngleAxisd(0.01 * share, Vector3d::UnitY()) * Vector3d(range * std::cos(angle), range * std::sin(angle), 0);
    return volume.contains(p.x(), p.y(), p.z());
  };
  EXPECT_FALSE(at(5.0, 0.0, 0.5));
  EXPECT_FALSE(at(4.94, 0.0, 0.5));  // 5 cm and two deviations of the range
  EXPECT_TRUE(at(4.90, 0.0, 0.5));
  EXPECT_TRUE(at(1.0, -0.2, 0.5));
  EXPECT_FALSE(at(5.2, 0.0, 0.5));
  EXPECT_FALSE(at(1.0, 0.3, 0.5));              // in the gap
  EXPECT_TRUE(at(2.0, 0.0, 1.0 + 0.5 * 0.88));  // beside the plane by half of two deviations
  EXPECT_FALSE(at(2.0, 0.0, 1.0 + 1.5 * 0.88));
  EXPECT_FALSE(at(-2.0, 0.0, 0.5));  // behind the scanner, where nothing was measured
  second.linear() = Eigen::AngleAxisd(0.1, Vector3d::UnitY()).toRotationMatrix();
  volume.build(first, wall, second, wall, rule);
  EXPECT_TRUE(volume.empty());  // too far apart to have looked between
  volume.build(first, wall, first, wall, rule);
  EXPECT_TRUE(volume.contains(2.0, 0.1, 0.0));  // standing still it still looks along its plane
  EXPECT_FALSE(volume.contains(2.0, 0.1, 0.1));
}

// The search through the blocks finds exactly what the test of every point finds.
TEST(DeletionVolume, SearchThroughBlocksMissesNothing) {
  UniformDraw draw(12);
  std::uint64_t total = 0;
  for (int scene = 0; scene < 30; ++scene) {
    GatheringOptions options;
    options.voxel_m = draw(0.05, 0.3);
    PointCloudGatherer gatherer(options);
    const ScannerDeviations deviations;
    const std::size_t filler = gatherer.add_scanner(deviations), scanner = gatherer.add_scanner(deviations);
    std::vector<ScanPoint> cloud;
    const double extent = scene % 2 == 0 ? 5.0 : 1.0;  // many blocks, and few
    for (int i = 0; i < 4000; ++i)
      cloud.push_back(
          {static_cast<float>(draw(-extent, extent)), static_cast<float>(draw(-extent, extent)), static_cast<float>(draw(-extent, extent)), 0, 0});
    gatherer.add_points(filler, Isometry3d::Identity(), Vector3d::Zero(), cloud, 0.0);
    const auto [a, b] = two_scans(draw, 0.1, draw(0.005, 0.04), 3.0);
    gatherer.add_scan(scanner, a.frame, a.returns, 0.1);
    DeletionVolume volume;
    volume.build(a.frame, a.returns, b.frame, b.returns,
                 {options.shrink_m, options.quantile, deviations.range_m, deviations.along_rad, deviations.across_rad, options.max_gap_rad,
                  options.max_turn_rad});
    std::uint64_t expected = 0;
    const CloudStore& store = gatherer.store();
    for (std::uint32_t i = 0; i < store.places(); ++i)
      expected +=
          store.used(i) && volume.contains(static_cast<double>(store[i].x), static_cast<double>(store[i].y), static_cast<double>(store[i].z)) ? 1 : 0;
    gatherer.add_scan(scanner, b.frame, b.returns, 0.2);
    EXPECT_EQ(gatherer.counts().deleted, expected) << "scene " << scene;
    total += expected;
  }
  EXPECT_GT(total, 300U);
}

}  // namespace
}  // namespace berm::app
