// Which rays of a sensor on the upper body must come back: they point down far enough to meet ground, and the own machine is not close before the
// sensor.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "config/parameter_block.h"

namespace berm::kernel {

class SightLine {
 public:
  enum Kind : std::uint8_t {
    kOpen,       // need not come back
    kExpected,
    kOverTracks  // expected, unless the tracks are close below (over_tracks)
  };
  static constexpr double kDownSine = 0.17364817766693033;  // of 10 degrees
  static constexpr double kNearM = 0.6;  // own parts nearer than this may be met where an echo counts as one on the window

  static constexpr double kSwungM = 0.05;  // what 50 degrees a second make of 30 ms at 1.9 m from the axis

  explicit SightLine(const berm_parameters& parameters);

  // Upper body's frame, m; direction of length 1. The upper body is taken for a box as wide as its tail and as long as the own body; a ray
  // that leaves away from the axis does not meet it, for the sensor stands on its rim.
  Kind of(const Eigen::Vector3d& head, const Eigen::Vector3d& direction) const;
  // Whether the tracks may be close below: a box as wide as the tail and as long as the own body, up to the upper body's underside, and as much larger as
  // the sensor may be elsewhere than the measured swing has it: that is some milliseconds old, and interpolated.
  bool over_tracks(const Eigen::Vector3d& head, const Eigen::Vector3d& direction, double swing_cosine, double swing_sine) const;

 private:
  bool meets(const Eigen::Vector3d& head, const Eigen::Vector3d& direction, double top, double aside) const;

  double half_length_, half_width_, underside_, top_;
};

}  // namespace berm::kernel
