// Which classes of trucks a bed may be of, by every size that a sweep shows of it, and which of these it is said to be of.
#pragma once

#include <string>
#include <vector>

#include "recognition/bed_fit.hpp"
#include "recognition/bed_height.hpp"
#include "recognition/truck_ranges.hpp"

namespace berm::app {

// The classes that take in its opening, walls and rear, or would with a length that its deviation leaves open. The covariance is known.
TruckRangeSet classes_of(const FittedBed& fit, const TruckRangeSet& ranges);

// The same, but the length's deviation is found and asked only where no class takes the bed in as it is.
TruckRangeSet some_classes_of(const FittedBed& fit, const TruckRangeSet& ranges);

// Of these classes those whose walls' tops stand as high over the ground as returns beside the bed (depths_beside) lie below them.
TruckRangeSet standing_on(const std::vector<double>& beside, const TruckRangeSet& classes);

// Why a bed with such walls is none, a sentence; empty when a class has them, or nothing tells. classes: that take in all else.
std::string refusal_of_height(const BedHeight& height, const TruckRangeSet& classes);

// Of the classes of the told shape that whose ranges the sizes leave least, the first in the file among equals: what no ray tells apart has the name of the
// first. canopy: one is seen, so that a class with a canopy is before all others of the shape. classes: one at least.
const TruckRanges& class_told(const FittedBed& fit, const BedHeight& height, const TruckRangeSet& classes, bool canopy = false);

}  // namespace berm::app
