// Random places for a thing on the ground: in view of a scanner beside the arm, outside the own body, inside the map.
#pragma once

#include <cstdint>
#include <memory>

#include "figures.hpp"
#include "sweep.hpp"

namespace berm::kernel::test {

inline constexpr double kRounding = 0.006;       // m: ranges to 4 mm, points to 1 mm
inline constexpr std::int32_t kGroundMm = 6;     // the same on level ground
inline constexpr double kSwing = -15 * 3.14159265358979323846 / 180;  // what is panned to at 60 degrees lies in a corner of the map, 15 m away too

struct Placed {
  std::unique_ptr<Sweep> sweep;  // its scene holds the thing alone
  int scanner = 0;
  double pan = 0.0;        // of the thing's middle
  double half_angle = 0.0; // of its extent, from the head

  const Prism& thing() const { return sweep->scene.thing[0]; }
  // One sweep over the thing and two lines' distance beyond, in a drawn direction, with the mirror at a drawn angle.
  void pass(double rate, std::mt19937_64& random) const;
};

// A box, or nearly a cylinder, into which an upright cylinder of this diameter fits, its axis at this distance.
Placed draw_thing(const berm_parameters& parameters, double distance, double diameter, double z_low, double z_high, std::mt19937_64& random);

// The angle under which a convex footprint is seen; no footprint: 0.
double seen_under(const std::vector<Spot>& footprint, Spot from);

}  // namespace berm::kernel::test
