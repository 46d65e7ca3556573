#include "recognition/region_planes.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {
namespace {

using Eigen::Vector3d;

constexpr double kUprightGate = 0.15;  // m, of a return from the upright plane: a wall may lean
constexpr double kGateLeast = 0.04, kGateMost = 0.09, kGateDeviations = 2.5;  // m; of the returns from their plane
constexpr int kPlaneRounds = 3;
constexpr double kOfPlaneLeast = 8.0;
// Walls lean by so much, and ranges are so unsure: a low region, whose returns tell little of how it leans, stays near the upright.
constexpr double kLeanSpread = 0.035, kNoise = 0.03;  // rad, m; standard deviations
constexpr double kLeanMost = 0.06;  // rad: what leans more has soil at its foot

// Sums of returns along a region (x), up (z), and out of its upright plane (y).
struct Moments {
  double n = 0.0, x = 0.0, y = 0.0, z = 0.0, xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;
  void add(double at_x, double at_y, double at_z) {
    n += 1.0, x += at_x, y += at_y, z += at_z;
    xx += at_x * at_x, xy += at_x * at_y, xz += at_x * at_z, yy += at_y * at_y, yz += at_y * at_z, zz += at_z * at_z;
  }
};

// y = out + turn x + lean z.
struct Leaning {
  double out = 0.0, turn = 0.0, lean = 0.0;
  [[nodiscard]] double off(double x, double y, double z) const { return y - out - turn * x - lean * z; }
};

}  // namespace

RegionPlane plane_of(const FanSweep& sweep, const UprightRegion& region) {
  const Eigen::Vector2d middle = 0.5 * (region.first + region.last);
  const Vector3d about(middle.x(), middle.y(), 0.5 * (region.low + region.high)), out(region.normal.x(), region.normal.y(), 0.0), along(-out.y(), out.x(), 0.0);
  Leaning plane;
  Vector3d mean = about;
  double gate = kUprightGate;
  for (int round = 0; round < kPlaneRounds; ++round) {
    Moments m;
    for (const UprightSegment& s : region.segments)
      for (const FanReturn& r : sweep.of(s.fan)) {
        const double height = static_cast<double>(r.place.z());
        if (height < s.low || height > s.high) continue;
        const Vector3d at = r.at() - about;
        const double x = along.dot(at), y = out.dot(at);
        if (std::abs(plane.off(x, y, at.z())) < gate) m.add(x, y, at.z());
      }
    if (m.n < kOfPlaneLeast) break;
    const double x = m.x / m.n, y = m.y / m.n, z = m.z / m.n;
    const double xx = m.xx - m.n * x * x, xz = m.xz - m.n * x * z, xy = m.xy - m.n * x * y, yz = m.yz - m.n * y * z, yy = m.yy - m.n * y * y;
    const double zz = m.zz - m.n * z * z + kNoise * kNoise / (kLeanSpread * kLeanSpread), size = xx * zz - xz * xz;
    if (size <= 1e-9 * xx * zz) break;
    plane.lean = std::clamp((yz * xx - xy * xz) / size, -kLeanMost, kLeanMost);
    plane.turn = (xy - plane.lean * xz) / xx;
    plane.out = y - plane.turn * x - plane.lean * z;
    mean = about + x * along + y * out + z * Vector3d::UnitZ();
    gate = std::clamp(kGateDeviations * std::sqrt(std::max(0.0, yy - plane.turn * xy - plane.lean * yz) / m.n), kGateLeast, kGateMost);
  }
  return {(out - plane.turn * along - plane.lean * Vector3d::UnitZ()).normalized(), mean};
}

}  // namespace berm::app
