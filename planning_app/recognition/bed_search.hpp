// Interpretation of upright regions as faces of a bed: a tree over the roles that a region may have, pruned at every level by the classes' ranges
// (stentz-1999, section 4.1; Grimson, 1990), and the refinement of the best interpretations against the rays.
#pragma once

#include <vector>

#include "recognition/bed_model.hpp"
#include "recognition/truck_ranges.hpp"
#include "recognition/upright_regions.hpp"

namespace berm::app {

struct BedInterpretation {
  BedPose pose;
  BedEvidence evidence;
  std::vector<Ray> rays;  // that come near the bed
};

// The best interpretations by their evidence, at most kInterpretations, the best first.
constexpr std::size_t kInterpretations = 4;
std::vector<BedInterpretation> interpret(const FanSweep& sweep, const std::vector<UprightRegion>& regions, const TruckRangeSet& ranges);

// Rays of the sweep that come to within 0.6 m of the bed's walls or opening, down to so many metres below the walls' tops.
std::vector<Ray> rays_near(const FanSweep& sweep, const BedPose& pose, double below = 1.1);

}  // namespace berm::app
