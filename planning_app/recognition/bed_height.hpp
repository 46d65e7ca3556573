// How high the walls of a bed stand over its floor, by whatever shows either; and how well that is known.
#pragma once

#include <vector>

#include "recognition/bed_fit.hpp"
#include "recognition/truck_ranges.hpp"

namespace berm::app {

struct BedHeight {
  double height = 0.0;     // m, from the floor, of a half pipe from its lowest line, to the walls' top
  double deviation = 0.0;  // m, standard; some 0.2 where neither floor nor foot is seen
  double beyond = 0.0;     // how likely no class has the height. Up to kHardlyNone all else is of the classes' heights, above kLikelyNone of the others, between of all
  double half_pipe = 0.0;  // how likely the bed is a half pipe
};
constexpr double kHardlyNone = 0.1, kLikelyNone = 0.9;

// fit: a bed; rays: those near it, down to 2.5 m below its tops; classes: those that take in its other sizes. Every height is weighed, those that no class allows as rare ones, by where
// rays begin to pass below the outer faces that the sensor sees; by how a half pipe's side draws in; and by what lies deepest within and on inner faces, for nothing lies deeper
// than the floor, and a bed without load shows it. A load may lie as flat as a floor, and what carries the bed be flush with its walls, so that none of
// these must be there: then the classes are all that is known. A half pipe is thought of only where a class is one. flatness: of the level plane that is matched as the floor, how much
// likelier that is steel than soil, a logarithm (level_planes); 0 where none is: so much rarer is a load that lies as flat.
BedHeight bed_height(const FittedBed& fit, const std::vector<Ray>& rays, const TruckRangeSet& classes, double flatness = 0.0);

}  // namespace berm::app
