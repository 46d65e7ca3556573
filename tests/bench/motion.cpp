#include "motion.hpp"

#include <cmath>

namespace berm::bench {

namespace {

constexpr double kRadPerDegree = 3.141592653589793 / 180.0;
// From behind the right over the front to the left, 40 deg/s on average; the implements raise, reach out and curl.
constexpr double kFromDegree[4] = {-60.0, 33.0, -95.0, -75.0};
constexpr double kToDegree[4] = {60.0, 40.0, -80.0, -55.0};

}  // namespace

Joints joints_at(double step) {
  const double t = step / kSteps;
  const double eased = t - std::sin(2.0 * 3.141592653589793 * t) / (8.0 * 3.141592653589793);  // slower at both ends, 50 deg/s in the middle
  Joints joints{};
  for (int j = 0; j < 4; ++j) joints.angle[j] = (kFromDegree[j] + (kToDegree[j] - kFromDegree[j]) * eased) * kRadPerDegree;
  return joints;
}

sk_reach_box box_of_step(int step) {
  const Joints from = joints_at(step), to = joints_at(step + 1);
  sk_reach_box box{};
  for (int j = 0; j < 4; ++j) {
    box.low_urad[j] = static_cast<std::int32_t>(std::floor(std::fmin(from.angle[j], to.angle[j]) * 1e6));
    box.high_urad[j] = static_cast<std::int32_t>(std::ceil(std::fmax(from.angle[j], to.angle[j]) * 1e6));
  }
  return box;
}

Vec3 part_point(const berm_parameters& parameters, const berm_part& part, const Joints& joints, double x_m, double z_m, double y_m) {
  double r = parameters.boom_pin_x_mm * 1e-3, z = parameters.boom_pin_z_mm * 1e-3, elevation = joints.angle[1];
  if (part.link >= 2) {
    r += parameters.boom_length_mm * 1e-3 * std::cos(elevation);
    z += parameters.boom_length_mm * 1e-3 * std::sin(elevation);
    elevation += joints.angle[2];
  }
  if (part.link >= 3) {
    r += parameters.stick_length_mm * 1e-3 * std::cos(elevation);
    z += parameters.stick_length_mm * 1e-3 * std::sin(elevation);
    elevation += joints.angle[3];
  }
  const double c = std::cos(elevation), s = std::sin(elevation);
  r += x_m * c - z_m * s;
  z += x_m * s + z_m * c;
  const double swing_c = std::cos(joints.angle[0]), swing_s = std::sin(joints.angle[0]);
  return {r * swing_c - y_m * swing_s, r * swing_s + y_m * swing_c, z};
}

}  // namespace berm::bench
