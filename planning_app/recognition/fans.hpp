// A sweep of a panning scanner as fans: each scanline with the place of the sensor that measured it.
// Frame: the points' own, z up, origin on the axis about which a machine may have swung meanwhile. Metres, radians, seconds.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "points/point_cloud.hpp"

namespace berm::app {

struct FanReturn {
  Eigen::Vector3d at;
  std::uint32_t fan;      // of FanSweep::heads
  bool upright = false;   // of an upright segment (upright_regions)
};

// Where a ray goes: its unit direction in plan, and how much it rises with every metre of that.
struct FanDirection {
  Eigen::Vector2d level;
  double slope;
};

// The upright plane in which the rays of a fan go: in plan its normal, unit, and the most that a ray's direction has along it.
struct FanPlan {
  Eigen::Vector2d normal;
  double spread;
};

struct FanSweep {
  std::vector<Eigen::Vector3d> heads;    // of each fan: where the sensor was
  std::vector<FanPlan> plans;            // of each fan
  std::vector<std::size_t> begin;        // of each fan in returns, and the end of the last
  std::vector<FanReturn> returns;        // in measuring order
  std::vector<FanDirection> directions;  // of the rays to each return
  double swing_rate = 0.0;               // rad/s, as found
  double step = 0.0;                     // rad between neighbouring fans, the median
  std::string reason;                    // why the sweep cannot be used; empty when it can

  [[nodiscard]] std::span<const FanReturn> of(std::size_t fan) const { return {returns.data() + begin[fan], begin[fan + 1] - begin[fan]}; }
};

// points in measuring order; viewpoint: of the sensor in the middle of the sweep. The fans are upright planes through the sensor; with the machine
// swinging the sensor moves on a circle about the frame's z axis, and angle and rate are found from the fans' planes by least squares. Scanlines with
// fewer than 8 returns within 30 m are left out. On failure only reason is set.
FanSweep make_fans(const std::vector<ScanPoint>& points, const std::array<double, 3>& viewpoint);

// Every second, third ... fan of a sweep whose fans lie closer than a degree, so that they lie about a degree apart: what a search for a truck needs, and
// what its weights of evidence are meant for. Nothing is marked upright yet.
FanSweep thinned(const FanSweep& sweep);

}  // namespace berm::app
