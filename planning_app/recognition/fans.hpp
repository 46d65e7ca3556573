// A sweep of a panning scanner as fans: each scanline with the place of the sensor that measured it.
// Frame: the points' own, z up, origin on the axis about which a machine may have swung meanwhile. Metres, radians, seconds.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "points/point_cloud.hpp"

namespace berm::app {

// As the scanner's points have it, in single precision: a sweep of some 40,000 returns is read again and again, and memory that is touched for the
// first time costs more than what is done there.
struct FanReturn {
  Eigen::Vector3f place;
  bool upright = false;   // of an upright segment (upright_regions)
  [[nodiscard]] Eigen::Vector3d at() const { return place.cast<double>(); }
};

// Where rays go: their unit directions in plan, and how much they rise with every metre of that. Of all returns, side by side for lanes.hpp.
struct FanDirections {
  std::vector<float> x, y, slope;
  [[nodiscard]] std::size_t size() const { return slope.size(); }
  void resize(std::size_t size) { x.resize(size), y.resize(size), slope.resize(size); }
  void reserve(std::size_t size) { x.reserve(size), y.reserve(size), slope.reserve(size); }
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
  FanDirections directions;              // of the rays to each return
  double swing_rate = 0.0;               // rad/s, as found
  double step = 0.0;                     // rad between neighbouring fans, the median
  std::string reason;                    // why the sweep cannot be used; empty when it can

  [[nodiscard]] std::span<const FanReturn> of(std::size_t fan) const { return {returns.data() + begin[fan], begin[fan + 1] - begin[fan]}; }
};

// The upright plane of a scanline's returns, and when it was measured.
struct FanPlane {
  Eigen::Vector2d normal;  // horizontal, unit
  double offset, time;
  double turned = 0.0;     // rad, by which the machine was told to have swung by then
};

// A head at the viewpoint after a turn about the frame's z axis.
Eigen::Vector3d head_turned(const Eigen::Vector3d& head, double angle);

// How the sensor moved on a circle about the frame's z axis: at a time it stands at the viewpoint turned by this angle, besides what was told. Radians, seconds.
struct SwingOfHead {
  double angle = 0.0, rate = 0.0;  // in the middle; rad/s
  double middle = 0.0;             // the planes' mean time
  std::string reason;              // why the scanlines are no fans through it; empty when they are
  [[nodiscard]] double at(double time) const { return angle + rate * (time - middle); }
  [[nodiscard]] bool stands() const { return angle == 0.0 && rate == 0.0; }
};

// Adds a scanline (points of one, in measuring order) as the next fan, seen from the head. None, and nothing added, where it has fewer than 8 returns within
// 30 m or they lie too near to one another to tell a plane.
std::optional<FanPlane> append_fan(FanSweep& sweep, std::span<const ScanPoint> scanline, const Eigen::Vector3d& head);

// Angle and rate by least squares; where the head stands, or turned as it was told, both are exactly 0.
SwingOfHead swing_of_head(const std::vector<FanPlane>& planes, const Eigen::Vector3d& head);

// Puts the heads of a sweep, whose fans have these planes, where the swing had them, and finds their rays' directions again.
void place_heads(FanSweep& sweep, const std::vector<FanPlane>& planes, const Eigen::Vector3d& head, const SwingOfHead& swing);

// From a fan to the next, rad, counter-clockwise from above; and the median of such without their sense, 0 of none.
double turn_between(const FanPlane& one, const FanPlane& next);
double median_of(std::vector<double> steps);

// points in measuring order; viewpoint: of the sensor in the middle of the sweep. The fans are upright planes through the sensor; with the machine
// swinging the sensor moves on a circle about the frame's z axis, and angle and rate are found from the fans' planes. On failure only reason is set.
FanSweep make_fans(std::span<const ScanPoint> points, const std::array<double, 3>& viewpoint);

// Every which fan of a sweep with this step is kept, so that the kept lie about a degree apart: what a search for a truck needs, and what its weights of
// evidence are meant for.
std::size_t thinning(double step);
void append_thinned(FanSweep& out, const FanSweep& sweep, std::size_t fan);
// All fans that are kept. Nothing is marked upright yet.
FanSweep thinned(const FanSweep& sweep);

// Hands on the points of each scanline by itself: neighbours with the same number.
template <typename Take>
void visit_scanlines(std::span<const ScanPoint> points, const Take& take) {
  for (std::size_t i = 0; i < points.size();) {
    std::size_t end = i;
    while (end < points.size() && points[end].scanline == points[i].scanline) ++end;
    take(points.subspan(i, end - i));
    i = end;
  }
}

}  // namespace berm::app
