// Scans of a recording of points: the plane and the angles of a scanline, found from its points and the scanner's place.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "gathering/deletion_volume.hpp"
#include "points/point_cloud.hpp"

namespace berm::app {

struct PlanarScan {
  Eigen::Isometry3d frame;           // as KinematicChain gives it
  std::vector<PolarReturn> returns;  // in rising angle
};

// origin: the optical centre in the points' frame, metres. before: the frame of the scanline before, whose angle 0 and side of the normal are kept.
// None when the beams spread less than 3 degrees (root mean square: the plane would not be certain), or lie more than 2 degrees off any plane.
std::optional<PlanarScan> fit_scan(std::span<const ScanPoint> points, const Eigen::Vector3d& origin, const Eigen::Isometry3d* before);

}  // namespace berm::app
