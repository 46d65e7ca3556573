#include "app/move_bearing.hpp"

#include <algorithm>
#include <cmath>

#include "motion/reach_preview.hpp"

namespace berm::app {

namespace {

// How near a line comes to the edges of cells that lie along x: from one distance across to another. 0: it crosses one.
double to_edge(double from, double to, double cell) {
  const double low = std::min(from, to) / cell, high = std::max(from, to) / cell;
  return std::floor(low) != std::floor(high) ? 0.0 : cell * std::min(low - std::floor(low), std::ceil(high) - high);
}

// Of all sides, beyond the machine's own body.
double least_to_edge(const MachineModel& machine, const Joints& pose, double bearing, double cell) {
  double least = cell;
  for (const Prism& part : machine.parts) {
    const Extent extent = extent_of(machine, part, pose);
    const double near = std::max(extent.near, machine.own_body_radius);
    if (near >= extent.far) continue;
    for (const double side : {-part.half_width, part.half_width})
      least = std::min(least, to_edge(side + near * std::sin(bearing), side + extent.far * std::sin(bearing), cell));
  }
  return least;
}

}  // namespace

double move_bearing(const MachineModel& machine, const Joints& pose, double middle, double cell) {
  constexpr double beside_most = radians(3.0), step = radians(0.25);
  constexpr double gain = 1e-6;  // m: of two that are as good the nearer to the middle
  double best = middle, most = least_to_edge(machine, pose, middle, cell);
  for (double beside = step; beside < beside_most + 0.5 * step; beside += step)
    for (const double bearing : {middle + beside, middle - beside})
      if (const double least = least_to_edge(machine, pose, bearing, cell); least > most + gain) {
        most = least;
        best = bearing;
      }
  return best;
}

}  // namespace berm::app
