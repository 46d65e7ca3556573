// Weights of depths below a bed's tops, kStep apart, as logarithms: of what its returns and the classes of trucks say of the height of its walls.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace berm::app {

constexpr double kStep = 0.01, kShallowest = 0.5, kDeepestSeen = 2.4;  // m
constexpr std::size_t kDepths = 191;
static_assert(kDepths == static_cast<std::size_t>((kDeepestSeen - kShallowest) / kStep + 1.5));
using DepthWeights = std::array<double, kDepths>;
constexpr double kImpossible = -1e9;

inline double depth_of(std::size_t i) { return kShallowest + kStep * static_cast<double>(i); }

constexpr double kTopLeft = 0.3;     // m: what lies nearer to the tops tells nothing
constexpr double kIndependent = 0.5;  // neighbouring rays share mud and the errors of the pose

inline double gauss(double x, double spread) { return 0.3989422804 / spread * std::exp(-0.5 * x * x / (spread * spread)); }

inline double add_logs(double a, double b) {
  const double most = std::max(a, b);
  return most <= kImpossible ? kImpossible : most + std::log1p(std::exp(-std::fabs(a - b)));
}

}  // namespace berm::app
