#include "app/move_bearing.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/arm_kinematics.hpp"

namespace berm::app {

namespace {

// How near a line comes to the edges of cells that lie along x: from one distance across to another. 0: it crosses one.
double to_edge(double from, double to, double cell) {
  const double low = std::min(from, to) / cell, high = std::max(from, to) / cell;
  return std::floor(low) != std::floor(high) ? 0.0 : cell * std::min(low - std::floor(low), std::ceil(high) - high);
}

struct Strip { double near, far, half_width; };  // distances from the swing axis, m

// What the parts cover from above, beyond the machine's own body.
std::vector<Strip> strips(const MachineModel& machine, const Joints& pose) {
  const ArmPoints arm = forward(machine, pose);
  std::vector<Strip> all;
  for (const Prism& part : machine.parts) {
    const PlanePoint pin = part.link == boom ? arm.boom_pin : part.link == stick ? arm.stick_pin : arm.bucket_pin;
    const double attitude = part.link == boom ? pose[boom] : part.link == stick ? arm.stick_attitude : arm.bucket_attitude;
    Strip strip{INFINITY, -INFINITY, part.half_width};
    for (const auto& [along, left] : part.outline) {
      const double r = pin.r + along * std::cos(attitude) - left * std::sin(attitude);
      strip.near = std::min(strip.near, r);
      strip.far = std::max(strip.far, r);
    }
    strip.near = std::max(strip.near, machine.own_body_radius);
    if (strip.near < strip.far) all.push_back(strip);
  }
  return all;
}

double least_to_edge(const std::vector<Strip>& strips, double bearing, double cell) {
  double least = cell;
  for (const Strip& strip : strips)
    for (const double side : {-strip.half_width, strip.half_width})
      least = std::min(least, to_edge(side + strip.near * std::sin(bearing), side + strip.far * std::sin(bearing), cell));
  return least;
}

}  // namespace

double move_bearing(const MachineModel& machine, const Joints& pose, double middle, double cell) {
  constexpr double beside_most = radians(3.0), step = radians(0.25);
  constexpr double gain = 1e-6;  // m: of two that are as good the nearer to the middle
  const std::vector<Strip> under = strips(machine, pose);
  double best = middle, most = least_to_edge(under, middle, cell);
  for (double beside = step; beside < beside_most + 0.5 * step; beside += step)
    for (const double bearing : {middle + beside, middle - beside})
      if (const double least = least_to_edge(under, bearing, cell); least > most + gain) {
        most = least;
        best = bearing;
      }
  return best;
}

}  // namespace berm::app
