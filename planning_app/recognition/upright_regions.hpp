// Upright planar regions of a sweep: scanlines to line segments, segments grouped with coplanar ones of other scanlines (stentz-1999, section 4.1).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "recognition/fans.hpp"

namespace berm::app {

// A run of returns of one fan, one above the other on an upright line. Metres.
struct UprightSegment {
  std::size_t fan = 0;
  Eigen::Vector2d at;         // in plan
  double low = 0.0, high = 0.0;
  int count = 0;              // of returns
};

// Segments on one upright plane. Metres; in plan the region goes from first to last.
struct UprightRegion {
  Eigen::Vector2d normal;     // in plan, unit, towards the sensor
  Eigen::Vector2d first, last;
  double low = 0.0, high = 0.0;  // the medians of its segments' ends
  int count = 0;                 // of returns
  std::vector<UprightSegment> segments;
};

// Marks their returns in the sweep.
std::vector<UprightSegment> upright_segments(FanSweep& sweep);

// The largest first. segments by rising fan. Linear in them: each is offered to the regions that grew within the last three fans.
std::vector<UprightRegion> upright_regions(const FanSweep& sweep, const std::vector<UprightSegment>& segments);

}  // namespace berm::app
