// Strips between the sides of a bed that an upright region may bound: as the outer or inner face of a side or of an end (the first levels of the
// interpretation tree of stentz-1999, section 4.1; their ends come later).
#pragma once

#include <vector>

#include "recognition/bed_ends.hpp"
#include "recognition/truck_ranges.hpp"
#include "recognition/upright_regions.hpp"

namespace berm::app {

std::vector<BedStrip> strips_of(const UprightRegion& region, const TruckRangeSet& ranges);

// Strips as wide as the widest bed that end on the region, taken for the inner face of an end of which no more than a strip's breadth at either side is out of sight: from behind an open end rays graze
// the sides, and sides too near together would let many of them through. sensor: in plan, m; none of a region that is seen aslant, from where the sides hide an end.
std::vector<BedStrip> strips_within(const UprightRegion& region, const TruckRangeSet& ranges, const Eigen::Vector2d& sensor);

// Strips behind the region, taken for the front of a cab, of several heights: from there the cab hides the bed's end wall, and as that end it agrees with more rays
// than a bed of which little is seen.
std::vector<BedStrip> strips_behind(const UprightRegion& region, const TruckRangeSet& ranges);

// Of two regions that may be both sides of one bed: the outer face of the near one and the inner face of the far one, or the inner faces of both. Their
// distance is the width, their tops give height, roll and pitch.
std::vector<BedStrip> strips_of(const UprightRegion& a, const UprightRegion& b, const TruckRangeSet& ranges);

}  // namespace berm::app
