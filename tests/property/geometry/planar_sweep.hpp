// The true sweep of a part over a reach box: which points of space some position of the joints brings it to. The swing plane's part is painted pose by
// pose on a fine grid, with forward kinematics of the tests' own (complex numbers); the swing is exact.
#ifndef BERM_TESTS_GEOMETRY_PLANAR_SWEEP_HPP
#define BERM_TESTS_GEOMETRY_PLANAR_SWEEP_HPP

#include <complex>
#include <cstdint>
#include <vector>

#include "config/parameter_block.h"
#include "core/reach_box.h"

namespace berm::kernel::test {

class PlanarSweep {
public:
  // Neighbouring poses are at most step_mm apart at the part's farthest corner; the ends of the intervals are among them. What lies between two poses and in
  // neither is left out: at most 0.3 step_mm at corners, next to nothing along edges. So the sweep is rather too small than too large.
  PlanarSweep(const berm_parameters& parameters, const sk_reach_box& box, int part, double step_mm = 30.0);

  // Whether the part comes to the point at some swing angle of the box (mm, base frame).
  bool contains(double x, double y, double z) const;

private:
  static constexpr double cell_mm = 10.0, origin_mm = -13000.0;
  static constexpr int cells = 2600, words = (cells + 63) / 64;

  void paint(const std::vector<std::complex<double>>& polygon);
  bool any(double r_low, double r_high, double z) const;

  double swing_low_, swing_high_, half_width_mm_;
  std::vector<uint64_t> bit_; // [z][r]; a cell is painted where its centre is in the part
};

} // namespace berm::kernel::test
#endif
