// What the classes of trucks say of the height of a bed's walls, before any return does: of a box's and of a half pipe's.
#pragma once

#include "recognition/depth_weights.hpp"
#include "recognition/truck_ranges.hpp"

namespace berm::app {

// Together the densities of every height: those that a class of this shape has, those that its slack leaves open, and those that no class allows. The
// last two are possible, and rare.
struct ClassHeights {
  DepthWeights within{}, in_slack{}, beyond{};
  [[nodiscard]] bool any() const;  // a class has this shape
};

// ranges: the classes that take in the bed's other sizes. width: of the bed; what is less deep than half of it is no half pipe.
ClassHeights class_heights(const TruckRangeSet& ranges, bool half_pipe, double width);

}  // namespace berm::app
