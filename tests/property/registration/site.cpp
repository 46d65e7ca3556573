#include "site.hpp"

#include <algorithm>
#include <cmath>

namespace berm::registration_test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kHead = 3.3;          // the scanner's height over the base's ground, m; above the swing axis
constexpr double kFarthest = 14.0, kNearest = 2.5, kStep = 0.1;
constexpr int kWaves = 60;
constexpr double kReach = 17.0, kPitch = 0.1;  // of the lattice
constexpr int kSide = 341;
constexpr int kReturns = 40;           // of a cycle
constexpr double kLowest = -2.2;       // of the ground beyond the edges

double fall(double p, double crest, double toe) { return p <= crest ? 0.0 : p >= toe ? kLowest : kLowest * (p - crest) / (toe - crest); }

}  // namespace

Site::Site(const SiteConfig& config, std::uint64_t seed) : random(seed), config_(config), height_(kSide * kSide) {
  struct Wave {
    double kx, ky, phase;
  };
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Wave> waves;
  for (int i = 0; i < kWaves; ++i) {
    const double length = 0.5 * std::pow(8.0, unit(random)), heading = 2 * kPi * unit(random);  // 0.5 to 4 m
    waves.push_back({2 * kPi / length * std::cos(heading), 2 * kPi / length * std::sin(heading), 2 * kPi * unit(random)});
  }
  const double amplitude = config.relief_m * std::sqrt(2.0 / kWaves);
  for (int iy = 0; iy < kSide; ++iy) {
    for (int ix = 0; ix < kSide; ++ix) {
      const double x = ix * kPitch - kReach, y = iy * kPitch - kReach;
      double z = config_.edges ? std::min(fall(x, 6.0, 7.5), fall(y, 3.6, 5.0)) : 0.0;
      for (const Wave& w : waves) z += amplitude * std::sin(w.kx * x + w.ky * y + w.phase);
      height_[static_cast<std::size_t>(iy * kSide + ix)] = static_cast<float>(z);
    }
  }
}

double Site::height(double x, double y) const {
  const double u = std::clamp((x + kReach) / kPitch, 0.0, kSide - 1.001), v = std::clamp((y + kReach) / kPitch, 0.0, kSide - 1.001);
  const int ix = static_cast<int>(u), iy = static_cast<int>(v);
  const double fu = u - ix, fv = v - iy;
  const float* at = &height_[static_cast<std::size_t>(iy * kSide + ix)];
  return (at[0] * (1 - fu) + at[1] * fu) * (1 - fv) + (at[kSide] * (1 - fu) + at[kSide + 1] * fu) * fv;
}

void Site::dig(double x, double y, double radius, double depth) {
  for (int iy = 0; iy < kSide; ++iy) {
    for (int ix = 0; ix < kSide; ++ix) {
      const double d = std::hypot(ix * kPitch - kReach - x, iy * kPitch - kReach - y);
      if (d < radius) height_[static_cast<std::size_t>(iy * kSide + ix)] -= static_cast<float>(depth * (1 - d / radius));
    }
  }
}

bool Site::cast(double bearing, double depression, double& range) const {
  const double heading = bearing + base_yaw, dx = std::cos(heading), dy = std::sin(heading), slope = std::tan(depression);
  double over = 1.0, far = 0.0;
  for (double d = kNearest; d <= kFarthest; d += kStep) {
    const double x = base_x + d * dx, y = base_y + d * dy, z = base_z + kHead - d * slope;
    double top = height(x, y);
    for (const Thing& t : things) {
      const double u = (x - t.x) * std::cos(t.yaw) + (y - t.y) * std::sin(t.yaw), v = (y - t.y) * std::cos(t.yaw) - (x - t.x) * std::sin(t.yaw);
      if (std::fabs(u) <= t.length / 2 && std::fabs(v) <= t.width / 2) top = std::max(top, t.top);
    }
    if (z <= top) {
      // Between the last step over it and this: where the line meets the straight slope between them.
      const double under = top - z, share = d > kNearest ? over / (over + under) : 1.0;
      far = d - kStep * (1 - share);
      range = far / std::cos(depression);
      return true;
    }
    over = z - top;
  }
  return false;
}

void Site::scan(double time_s, std::vector<sk_point>& returns) {
  std::normal_distribution<double> noise(0.0, config_.range_stddev_m), wander(0.0, 1.0);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  swing_error_ = 0.98 * swing_error_ + 0.2 * config_.swing_error_rad / 2 * wander(random);
  const double sweep = 2.4 * std::sin(2 * kPi * time_s / 9.0);  // the upper body swings, the scanners pan with it
  returns.clear();
  for (int i = 0; i < kReturns; ++i) {
    const double bearing = sweep + 1.2 * (unit(random) - 0.5), depression = (12.0 + 40.0 * unit(random)) * kPi / 180;
    double range = 0.0;
    if (!cast(bearing, depression, range)) continue;
    range += noise(random);
    const double seen = bearing + swing_error_;
    returns.push_back({static_cast<std::int32_t>(std::lround(1e3 * range * std::cos(depression) * std::cos(seen))),
                       static_cast<std::int32_t>(std::lround(1e3 * range * std::cos(depression) * std::sin(seen))),
                       static_cast<std::int32_t>(std::ceil(1e3 * (kHead - range * std::sin(depression))))});
  }
}

}  // namespace berm::registration_test
