// The sweep of one part of the implements in the swing plane (r forward, z up, mm), by its support function.
#ifndef BERM_KERNEL_GEOMETRY_PART_SWEEP_HPP
#define BERM_KERNEL_GEOMETRY_PART_SWEEP_HPP

#include "config/parameter_block.h"
#include "core/reach_box.h"

namespace berm::kernel {

struct Direction {
  double psi;  // rad
  double r, z; // cos psi, sin psi
};
Direction direction_of(double psi) noexcept;

// The arc { radius (cos t, sin t) : low <= t <= high }.
class Arc {
public:
  Arc() noexcept = default;
  Arc(double radius, double low, double high) noexcept;

  // The exact maximum of the scalar product with the direction over the arc: radius where the arc passes the direction, else the better end.
  double support(const Direction& direction) const noexcept;

private:
  double radius_ = 0.0, low_ = 0.0, width_ = 0.0;
  double low_r_ = 0.0, low_z_ = 0.0, high_r_ = 0.0, high_z_ = 0.0;
};

// A point of a part is  pin + boom e(a1) + stick e(a2) + R(a) v  with the links' absolute elevations a1 (boom), a2 = a1 + stick angle and so
// on, and v in the part's polygon; the links before the part's own enter only. Over the reach box every absolute elevation lies in the sum
// of the joints' intervals. Taking these intervals as independent enlarges the set, and the support function of a Minkowski sum is the sum
// of the support functions; so support() bounds the sweep from above in every direction, and is itself the support function of a convex set.
class PartSweep {
public:
  // False, and nothing changed, where part, link, vertex count or intervals are malformed. The swing interval is not read.
  bool set(const berm_parameters& parameters, const sk_reach_box& box, int part) noexcept;

  double support(const Direction& direction) const noexcept; // mm
  double elevation_mid() const noexcept { return elevation_mid_; }
  double half_width_mm() const noexcept { return half_width_mm_; }
  int link() const noexcept { return link_; }

private:
  double pin_r_ = 0.0, pin_z_ = 0.0, elevation_mid_ = 0.0, half_width_mm_ = 0.0;
  int link_ = 0, chain_count_ = 0, vertex_count_ = 0;
  Arc chain_[2];
  Arc vertex_[BERM_PART_VERTICES];
};

} // namespace berm::kernel
#endif
