// A pose moved while its evidence grows: where the fit, which follows slopes, stands in a hollow of its own.
#pragma once

#include "recognition/bed_evidence.hpp"
#include "recognition/truck_ranges.hpp"

namespace berm::app {

// Moves walls, height and angles, one at a time, by first_step (m, at the bed's ends) and then halves of it; the ends by no more than 0.2 m, and the
// width no farther than 0.08 m beyond widths.
BedPose refined(const BedPose& start, const PackedRays& rays, const SizeRange& widths, double first_step, int halvings);

// The height and the tilts, of a few about those of the start, that agree best with the rays: one region tells the height of its own top, and not how
// the bed leans away from it.
BedPose levelled(const BedPose& start, const PackedRays& rays);

}  // namespace berm::app
