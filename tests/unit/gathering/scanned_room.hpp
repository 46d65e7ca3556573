// Two panning scanners on one encoder before a wall and a box: what each beam meets, with noise.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "gathering/gatherer.hpp"

namespace berm::app::test {

struct Box {
  Eigen::Vector3d low, high;
};

// The wall stands at x = 4 m; the cloud's frame has its origin on the ground under the axis of the pan.
class ScannedRoom {
public:
  static constexpr double kWall = 4.0;

  explicit ScannedRoom(unsigned seed) : engine_(seed) {}
  std::optional<Box> box;

  double range(const Eigen::Vector3d& from, const Eigen::Vector3d& beam) const {  // without noise; infinite when nothing is met
    double met = beam.x() > 1e-9 ? (kWall - from.x()) / beam.x() : std::numeric_limits<double>::infinity();
    if (box) {
      double enter = 0.0, leave = met;
      for (int i = 0; i < 3; ++i) {
        const double a = (box->low[i] - from[i]) / beam[i], b = (box->high[i] - from[i]) / beam[i];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
      }
      if (enter < leave) met = enter;
    }
    return met;
  }

  // What one turn of the mirror measures from where the scanner is; every angle of half a degree from -45 to 45.
  std::vector<PolarReturn> scan(const Eigen::Isometry3d& frame, double range_deviation_m) {
    std::vector<PolarReturn> out;
    std::normal_distribution<double> noise(0.0, range_deviation_m);
    for (int step = -90; step <= 90; ++step) {
      const double angle = step * 0.5 * 0.017453292519943295;
      const double met = range(frame.translation(), frame.linear() * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0));
      if (met < 20.0) out.push_back({angle, met + noise(engine_)});
    }
    return out;
  }
  double vibration(double deviation_rad) { return std::normal_distribution<double>(0.0, deviation_rad)(engine_); }

private:
  std::mt19937_64 engine_;
};

// As in the paper's Figure 7: both on one encoder, the second turned against the first and beside it.
inline std::vector<KinematicChain> two_scanners() {
  constexpr double kQuarterTurn = 1.5707963267948966;
  const DhLink pan{0.0, 1.0, 0.0, 0.0, DhLink::Joint::kRevolute, 0};
  return {KinematicChain({pan, {0.0, 0.1, 0.15, kQuarterTurn}}), KinematicChain({pan, {0.25, -0.1, 0.15, kQuarterTurn - 0.4}})};
}

// One sweep of both scanners from one pan angle to another, at step_rad from scan to scan.
inline void sweep(PointCloudGatherer& gatherer, ScannedRoom& room, const std::vector<KinematicChain>& chains, double from, double to, double step_rad,
                  double& time_s) {
  const int steps = static_cast<int>(std::ceil(std::abs(to - from) / step_rad));
  for (int i = 0; i <= steps; ++i, time_s += 0.02) {
    const double told = from + (to - from) * i / steps;
    for (std::size_t s = 0; s < chains.size(); ++s) {
      const double angle[] = {told + room.vibration(0.001)}, encoder[] = {told};
      gatherer.add_scan(s, encoder, room.scan(chains[s].pose(angle), 0.01), time_s);
    }
  }
}

}  // namespace berm::app::test
