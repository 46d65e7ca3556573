// Other places for the ends of a bed that was found: a fit, and moves of its walls, go no farther than its own hollow, and a bed whose front lies in its cab, or whose end is taken for
// somewhere before a heap, agrees with nearly as many rays as the true one.
#pragma once

#include <vector>

#include "recognition/bed_model.hpp"
#include "recognition/fans.hpp"
#include "recognition/truck_ranges.hpp"

namespace berm::app {

// Beds with one end of the given one elsewhere along its sides, by 0.2 to 1.5 m, where the evidence, with no more than enough of it for an end's outer face, has a peak
// that comes to this share of that of the given bed at least: the best two of each end.
// lengths: of the bed, inside, m; worth: the share.
std::vector<BedPose> other_ends(const FanSweep& sweep, const BedPose& pose, const SizeRange& lengths, double worth);

}  // namespace berm::app
