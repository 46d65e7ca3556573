// How high the walls of a bed stand over its floor, by whatever shows either; and how well that is known.
#pragma once

#include <vector>

#include "recognition/bed_fit.hpp"
#include "recognition/truck_ranges.hpp"

namespace berm::app {

struct BedHeight {
  double height = 0.0;     // m, from the floor, of a half pipe from its lowest line, to the walls' top
  double deviation = 0.0;  // m, standard; some 0.2 where neither floor nor foot is seen
};

// fit: a bed with the sizes of a class; rays: those near it, down to 2.5 m below its tops. What the classes of its sizes allow is weighed by three things: where
// rays begin to pass below the outer faces that the sensor sees; how a half pipe's side draws in; and what lies deepest within, for nothing lies deeper
// than the floor, and a bed without load shows it. A load may lie as flat as a floor, and what carries the bed be flush with its walls, so that none of
// the three must be there.
BedHeight bed_height(const FittedBed& fit, const std::vector<Ray>& rays, const TruckRangeSet& ranges);

}  // namespace berm::app
