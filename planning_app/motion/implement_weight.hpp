// The moments with which the cylinders hold the empty implements, learned from their pressures while the bucket is empty and in the air: no
// masses need to be known, and soil that sticks to the bucket is tare.
#pragma once

#include <array>

#include "motion/machine_model.hpp"

namespace berm::app {

struct SidePressures { double bottom_kpa = 0.0, rod_kpa = 0.0; };
using CylinderPressures = std::array<SidePressures, 3>;  // boom, stick, bucket
using Moments = std::array<double, 3>;                   // N m about the pins of boom, stick and bucket, positive in the sense of growing joint angles

Moments holding_moments(const MachineModel& machine, const CylinderPressures& pressure);

// Each link's own share (the moment of a pin less that of the next pin outward) is a cosine and a sine of its elevation: two numbers a link, by
// least squares that forgets.
class ImplementWeight {
public:
  // The bucket is empty and touches nothing. dt: seconds since the last call.
  void learn(const Joints& angle, const Moments& held, double dt);
  // Whether the poses seen so far say anything about this one.
  bool known(const Joints& angle) const;
  Moments of(const Joints& angle) const;

private:
  struct Link { double cc = 0.0, cs = 0.0, ss = 0.0, cm = 0.0, sm = 0.0, seconds = 0.0; };  // sums, in seconds
  std::array<Link, 3> link_;
};

}  // namespace berm::app
