#include "walked_ground.hpp"

#include <algorithm>
#include <cmath>

namespace berm::kernel::test {

namespace {
constexpr double kFarthestM = 25.0;
}

double WalkedGround::ground(double x, double y) const { return slope_ * x + 0.10 * std::sin(0.9 * x) * std::cos(0.7 * y); }

// To and fro.
double WalkedGround::pan(double t) const {
  const double period = 4.0 * kPanRad / kPanRadPerS, part = std::fmod(t, period) / period;
  return kPanRad * (part < 0.5 ? 4.0 * part - 1.0 : 3.0 - 4.0 * part);
}

double WalkedGround::walked_m(double t) const { return std::max(walker.to_m, walker.from_m - walker.speed_m_s * (t - walker.starts_s)); }

// Range of the nearest thing along a ray from the head, or 0.
double WalkedGround::cast(const std::array<double, 3>& along, double t, bool& of_walker) const {
  double nearest = 0.0;
  of_walker = false;
  const auto meet = [&nearest](double range) {
    const bool nearer = range > 0.5 && range < kFarthestM && (nearest == 0.0 || range < nearest);
    if (nearer) nearest = range;
    return nearer;
  };
  double before = 0.0;
  for (double range = 1.0; range < kFarthestM && nearest == 0.0; range += 0.25) {  // the ground, then halved
    if (kHeadZ + range * along[2] > ground(range * along[0], range * along[1])) {
      before = range;
      continue;
    }
    double low = before, high = range;
    for (int k = 0; k < 12; ++k) {
      const double middle = 0.5 * (low + high);
      (kHeadZ + middle * along[2] > ground(middle * along[0], middle * along[1]) ? low : high) = middle;
    }
    meet(high);
  }
  for (const Wall& wall : walls) {
    double in = 0.0, out = kFarthestM;
    const double from[3] = {0.0, 0.0, kHeadZ};
    for (int k = 0; k < 3; ++k) {
      const double slowness = std::fabs(along[k]) < 1e-12 ? 1e12 : 1.0 / along[k];
      const double a = (wall.low[k] - from[k]) * slowness, b = (wall.high[k] - from[k]) * slowness;
      in = std::max(in, std::min(a, b));
      out = std::min(out, std::max(a, b));
    }
    if (in < out) meet(in);
  }
  if (!walks || t < walker.starts_s) return nearest;
  const double far = walked_m(t), x = far * std::cos(walker.bearing), y = far * std::sin(walker.bearing), foot = ground(x, y);
  const double a = along[0] * along[0] + along[1] * along[1], b = along[0] * x + along[1] * y, c = x * x + y * y - walker.radius * walker.radius;
  const double root = b * b - a * c;
  if (root < 0.0) return nearest;
  const double range = (b - std::sqrt(root)) / a, z = kHeadZ + range * along[2];
  if (z > foot && z < foot + walker.height) of_walker = meet(range);
  return nearest;
}

double WalkedGround::line(std::vector<Seen>& out) {
  out.clear();
  const double t = time_s();
  std::normal_distribution<double> noise(0.0, kNoiseM), turn(0.0, kPanNoiseRad);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  const double heading = pan(t) + turn(random_);
  int sample = 0;
  for (double up = kLowestRad; up < kHighestRad; up += kSampleRad, ++sample) {
    const std::array<double, 3> along{std::cos(up) * std::cos(heading), std::cos(up) * std::sin(heading), std::sin(up)};
    bool of_walker = false;
    double range = cast(along, t, of_walker);
    const bool spurious = any(random_) < kSpurious;
    if (spurious) range = 1.0 + (kFarthestM - 1.0) * any(random_);
    else if (range > 0.0) range += noise(random_);
    if (range <= 0.0) continue;
    out.push_back({range * along[0], range * along[1], kHeadZ + range * along[2], lines_, sample, of_walker && !spurious, spurious});
  }
  ++lines_;
  return t;
}

}  // namespace berm::kernel::test
