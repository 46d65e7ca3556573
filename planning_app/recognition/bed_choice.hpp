// Which of the beds that were verified is the truck's.
#pragma once

#include <string>
#include <vector>

#include "recognition/bed_fit.hpp"
#include "recognition/bed_search.hpp"
#include "recognition/level_planes.hpp"
#include "recognition/truck_ranges.hpp"

namespace berm::app {

struct VerifiedBed {
  BedInterpretation interpretation;
  FittedBed fit;
  LevelPlanes planes;   // its floor and canopy
  std::string refusal;  // empty: it is a bed
  bool polished = false;
  double agreed = 0.0;      // evidence of the bed as its walls were moved when it was polished: a fit may lose some of it
  bool ends_moved = false;  // its ends were looked for elsewhere
  bool of_refused = false;  // one end of it was, and what had another there was refused
};

// What decides between beds: evidence that moves of its walls came to counts, for a fit may lose a part of it. What closes the bed, an end's outer face and the cab, counts for no more than there
// being one: from before a truck its cab's front has as many returns as all of the bed, and agrees with it as the bed's front wall.
double decides(const VerifiedBed& v);

// The bed with the most evidence; with none, of those refused the one most like a bed, whatever stands beyond its ends. A bed that is only a part of something that agrees with the rays
// much better than bed and cab do, and is none, is none either: a container. A bed and its cab taken for one long bed are no better than both.
// all: one at least.
const VerifiedBed& choose(const std::vector<VerifiedBed>& all, const TruckRangeSet& ranges);

// Whether it goes on beyond the bed's cab end for as long as a cab, where there is evidence of one that the bed's own sides do not explain: bed and cab taken for one.
bool is_bed_with_cab(const BedPose& longer, const BedInterpretation& i);

// What its walls' moves can add to an interpretation does not make it better than a bed that was found, nor something of which that is but a part.
bool may_be_chosen(const BedInterpretation& i, const std::vector<VerifiedBed>& all);

// Whether a fit from another end went back to where the bed was: there is nothing new to be polished.
bool comes_back(const BedPose& to, const BedPose& from);

}  // namespace berm::app
