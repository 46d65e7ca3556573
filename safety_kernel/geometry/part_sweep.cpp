#include "geometry/part_sweep.hpp"

#include <algorithm>
#include <cmath>

namespace berm::kernel {
namespace {

constexpr double two_pi = 6.283185307179586;
constexpr double rad_per_urad = 1e-6;
constexpr int32_t angle_max_urad = 20000000; // keeps sums of three in int32 and the reduction modulo 2 pi exact to 1e-14

} // namespace

Direction direction_of(double psi) noexcept { return {psi, std::cos(psi), std::sin(psi)}; }

Arc::Arc(double radius, double low, double high) noexcept
    : radius_(radius), low_(low), width_(high - low), low_r_(radius * std::cos(low)), low_z_(radius * std::sin(low)),
      high_r_(radius * std::cos(high)), high_z_(radius * std::sin(high)) {}

double Arc::support(const Direction& direction) const noexcept {
  const double turned = direction.psi - low_;
  const double from_low = turned - two_pi * std::floor(turned / two_pi); // 0..2 pi
  if (from_low <= width_) return radius_;
  return std::max(low_r_ * direction.r + low_z_ * direction.z, high_r_ * direction.r + high_z_ * direction.z);
}

bool PartSweep::set(const berm_parameters& parameters, const sk_reach_box& box, int part) noexcept {
  if (part < 0 || part >= BERM_PARTS) return false;
  const berm_part& shape = parameters.part[part];
  if (shape.link < 1 || shape.link > 3 || shape.vertices < 1 || shape.vertices > BERM_PART_VERTICES || shape.half_width_mm < 0) return false;
  for (int joint = 1; joint <= shape.link; ++joint)
    if (box.low_urad[joint] > box.high_urad[joint] || box.low_urad[joint] < -angle_max_urad || box.high_urad[joint] > angle_max_urad) return false;

  pin_r_ = parameters.boom_pin_x_mm;
  pin_z_ = parameters.boom_pin_z_mm;
  half_width_mm_ = shape.half_width_mm;
  link_ = shape.link;
  chain_count_ = shape.link - 1;
  vertex_count_ = shape.vertices;

  const double length_mm[2] = {static_cast<double>(parameters.boom_length_mm), static_cast<double>(parameters.stick_length_mm)};
  int32_t low_urad = 0, high_urad = 0;
  for (int joint = 1; joint <= shape.link; ++joint) {
    low_urad += box.low_urad[joint];
    high_urad += box.high_urad[joint];
    if (joint < shape.link) chain_[joint - 1] = Arc(length_mm[joint - 1], low_urad * rad_per_urad, high_urad * rad_per_urad);
  }
  const double low = low_urad * rad_per_urad, high = high_urad * rad_per_urad;
  elevation_mid_ = 0.5 * (low + high);
  for (int i = 0; i < vertex_count_; ++i) {
    const double x = shape.vertex_mm[i][0], z = shape.vertex_mm[i][1];
    const double argument = std::atan2(z, x);
    vertex_[i] = Arc(std::hypot(x, z), low + argument, high + argument);
  }
  return true;
}

double PartSweep::support(const Direction& direction) const noexcept {
  double sum = pin_r_ * direction.r + pin_z_ * direction.z;
  for (int i = 0; i < chain_count_; ++i) sum += chain_[i].support(direction);
  double farthest = vertex_[0].support(direction);
  for (int i = 1; i < vertex_count_; ++i) farthest = std::max(farthest, vertex_[i].support(direction));
  return sum + farthest;
}

} // namespace berm::kernel
