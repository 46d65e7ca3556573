// How far the implements can reach from the swing axis over a reach box; chooses the row of the braking table.
#ifndef BERM_KERNEL_GEOMETRY_REACH_HPP
#define BERM_KERNEL_GEOMETRY_REACH_HPP

#include <algorithm>
#include <cmath>

#include "geometry/part_sweep.hpp"

namespace berm::kernel {

// Upper bound, rounded up, of every implement point's distance from the swing axis; -1 where parameters or box are malformed. Reads the
// intervals of boom, stick and bucket only, so it can be asked before the swing's interval is known.
inline int32_t max_reach_mm(const berm_parameters& parameters, const sk_reach_box& box) noexcept {
  constexpr double pi = 3.141592653589793;
  constexpr double rounding_mm = 1e-3; // of the sums in double, which are good to 1e-9 mm
  if (parameters.parts < 1 || parameters.parts > BERM_PARTS) return -1;
  double reach_mm = 0.0;
  for (int part = 0; part < parameters.parts; ++part) {
    PartSweep sweep;
    if (!sweep.set(parameters, box, part)) return -1;
    const double forward = std::max(sweep.support(direction_of(0.0)), sweep.support(direction_of(pi)));
    reach_mm = std::max(reach_mm, std::hypot(forward, sweep.half_width_mm()));
  }
  reach_mm = std::ceil(reach_mm + rounding_mm);
  return reach_mm <= SK_COORD_MAX_MM ? static_cast<int32_t>(reach_mm) : -1;
}

} // namespace berm::kernel
#endif
