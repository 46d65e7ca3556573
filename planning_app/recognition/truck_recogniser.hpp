// Truck recognition: one sweep of a scanner in, the opening of a truck's bed out, or why there is none (stentz-1999, section 4.1).
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "points/point_cloud.hpp"
#include "recognition/arriving_sweep.hpp"
#include "recognition/bed_fit.hpp"
#include "recognition/bed_search.hpp"
#include "recognition/level_planes.hpp"
#include "recognition/truck_ranges.hpp"

namespace berm::app {

// Frame of the points; metres, radians.
struct RecognisedTruck {
  bool found = false;
  std::string reason;                           // a sentence; empty when found
  std::string truck_class;                      // the one that fits best: class_told
  // On the inner top edge: front left, rear left, rear right, front right as seen towards the cab.
  std::array<Eigen::Vector3d, 4> corners{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  double yaw = 0.0;                             // of the bed's long axis, towards the cab
  double length = 0.0, width = 0.0;             // inside
  double height = 0.0;                          // from the floor to the walls' top: bed_height
  double height_deviation = 0.0;                // standard
  bool open_rear = false;
  Matrix12d covariance = Matrix12d::Zero();     // of x y z of the corners in turn; rank 8: four corners of one rectangle
  Matrix8d pose_covariance = Matrix8d::Zero();  // of middle x y z, yaw, pitch, roll, length, width
  BedPose pose;
  BedEvidence evidence;
  double cab = 0.0;                             // evidence of its cab
  LevelPlanes planes;                           // floor and canopy, where they are seen
  double milliseconds = 0.0;                    // of CPU, in one thread
};

// Of the scanlines that have arrived so far; milliseconds are of this call alone.
RecognisedTruck recognise_truck(ArrivingSweep& scanlines, const TruckRangeSet& ranges);

// Of a whole sweep, the same bits as when its scanlines had arrived one by one. points in measuring order; viewpoint: of the sensor in the middle of the
// sweep. Never throws for what the points are.
RecognisedTruck recognise_truck(std::span<const ScanPoint> points, const std::array<double, 3>& viewpoint, const TruckRangeSet& ranges);

}  // namespace berm::app
