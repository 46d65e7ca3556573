// What a beam of the tests meets: level ground and upright prisms, by ray casting of its own. Base frame, metres.
#pragma once

#include <array>
#include <optional>
#include <vector>

namespace berm::kernel::test {

struct Spot {
  double x = 0.0, y = 0.0;
};

// A convex footprint, counter-clockwise, from z_low to z_high.
struct Prism {
  std::vector<Spot> footprint;
  double z_low = 0.0, z_high = 0.0;
  bool returns = true;  // false: swallows the light
};

// Contains an upright cylinder of this diameter, and little more.
Prism cylinder_around(Spot centre, double diameter, double height);
// along: its length in the direction yaw; across: its width.
Prism box(Spot centre, double yaw, double along, double across, double z_low, double z_high);
// The part of the footprint in a rectangle; empty where they do not meet.
std::vector<Spot> clipped(const std::vector<Spot>& footprint, Spot low, Spot high);

struct Beam {
  std::array<double, 3> from{}, along{};  // along: a unit vector
};

struct Scene {
  double ground_z = 0.0;
  std::vector<Prism> thing;

  // Range of the nearest surface; none where there is none, or where it returns nothing.
  std::optional<double> range(const Beam& beam) const;
};

}  // namespace berm::kernel::test
