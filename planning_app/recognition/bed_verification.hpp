// The rules by which what is most like a bed is one, or none: what a truck's bed must show, as far as the sweep can show it.
#pragma once

#include <string>

#include "recognition/bed_fit.hpp"
#include "recognition/bed_search.hpp"
#include "recognition/truck_ranges.hpp"

namespace berm::app {

constexpr double kCabOwn = 40.0;  // evidence of a cab that the bed's sides, were they longer, would not explain

// Why the bed is none, a sentence; empty when it is one. The interpretation's pose and evidence are those of the fit, whose covariance is found where a rule asks for it.
// of_refused: the bed has another end than one that was refused.
std::string refusal(const FanSweep& sweep, const BedInterpretation& i, FittedBed& fit, const TruckRangeSet& ranges, bool of_refused = false);

}  // namespace berm::app
