// Joint vectors and angle helpers. Radians and seconds everywhere in the app; joint order swing, boom, stick, bucket.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace berm::app {

inline constexpr std::size_t joints = 4;
enum Joint : std::size_t { swing = 0, boom = 1, stick = 2, bucket = 3 };
inline constexpr std::array<const char*, joints> joint_names{"swing", "boom", "stick", "bucket"};

using Joints = std::array<double, joints>;  // rad or rad/s

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }
constexpr double degrees(double radians_) { return radians_ * 180.0 / std::numbers::pi; }

// Into (-pi, pi].
inline double wrapped(double angle) {
  const double turns = std::floor((angle + std::numbers::pi) / (2.0 * std::numbers::pi));
  const double a = angle - turns * 2.0 * std::numbers::pi;
  return a <= -std::numbers::pi ? a + 2.0 * std::numbers::pi : a;
}

}  // namespace berm::app
