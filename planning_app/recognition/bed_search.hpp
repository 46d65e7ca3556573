// Interpretation of upright regions as faces of a bed: a tree over the roles that a region may have, pruned at every level by the classes' ranges
// (stentz-1999, section 4.1; Grimson, 1990). Level by level: the region, its role and the height of its top (region_strips), the ends and where the
// cab stands (bed_ends), then a fit of the best, and their ends again.
#pragma once

#include <vector>

#include "recognition/bed_ends.hpp"
#include "recognition/bed_evidence.hpp"
#include "recognition/rays_of_sweep.hpp"
#include "recognition/truck_ranges.hpp"
#include "recognition/upright_regions.hpp"

namespace berm::app {

struct BedInterpretation {
  BedPose pose;
  BedEvidence evidence;
  std::vector<Ray> rays;  // that come near the bed
  double cab = 0.0;       // evidence of the cab, not in that of the bed; half of what longer sides of the bed would explain
  double cab_seen = 0.0;  // the same of all that a cab explains
  double cab_to_front = 0.0;  // as cab, of a cab of any length; where it was asked for
  int cab_end = 0;        // 1: at +u
  [[nodiscard]] double whole() const;
};

// Beds of which the largest regions may be faces, before any fit.
std::vector<BedEnds> rough_beds(const FanSweep& sweep, const std::vector<UprightRegion>& regions, const TruckRangeSet& ranges);

// Of these the best interpretations by their evidence with the cab, at most kInterpretations, the best first. None begins where one
// was refused, and what is weak is weak beside the others that remain: a container does not keep the truck beside it from being looked at.
constexpr std::size_t kInterpretations = 6;
std::vector<BedInterpretation> interpret(const FanSweep& sweep, const std::vector<BedEnds>& rough_ones, const TruckRangeSet& ranges,
                                         const std::vector<BedPose>& refused);

// Moves the walls of one of them while its evidence grows; the fit stands in a hollow of its own.
void move_walls(const FanSweep& sweep, BedInterpretation& interpretation, const TruckRangeSet& ranges);

// Whether two beds are nearly one.
bool alike(const BedPose& a, const BedPose& b);

// The evidence for the pose as it is: of the bed, and of a cab beyond the end where there is more of it, or opposite an open end.
// to_front: of a cab of any length as well, which takes more rays. canopy_end: beyond which its canopy is, where one is matched, and so its cab; 0: none.
void weigh_whole(const FanSweep& sweep, BedInterpretation& interpretation, bool to_front = false, int canopy_end = 0);

// Returns that lie where the sides would go on beyond the ends: in the plane of the far side's inner face beyond either end, of the near side's outer face
// beyond the end without a cab. A truck has none there, a container that is taken for a shorter bed has.
int sides_beyond(const FanSweep& sweep, const BedPose& pose, int cab_end);

// The length at which the bed's sides, taken for something longer than every class of trucks, agree better with the rays than bed and cab (its evidence);
// 0 when they do not.
double longer_length(const FanSweep& sweep, const BedPose& pose, const TruckRangeSet& ranges, double cab);

}  // namespace berm::app
