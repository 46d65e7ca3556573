// The plane of an upright region as its returns have it. The walls of a truck that stands aslant lean by some degrees, and a region is upright by how it
// grows; a search for a bed goes by the regions and finds pitch and roll itself.
#pragma once

#include <Eigen/Core>

#include "recognition/upright_regions.hpp"

namespace berm::app {

struct RegionPlane {
  Eigen::Vector3d normal, at;  // unit, towards the sensor; the middle of the returns
};

// Least squares of the returns of its segments, of which those far from the plane are left out. A region too low to tell how it leans stays near the upright.
RegionPlane plane_of(const FanSweep& sweep, const UprightRegion& region);

}  // namespace berm::app
