// The shape of the ground that a dig is planned to leave: what the bucket's shell passes is gone, and what then stands too steep has slid. With it how the
// bucket leaves the soil, for that shapes the ground as well.
#pragma once

#include <array>
#include <vector>

#include "planning/cut_model.hpp"

namespace berm::app {

constexpr double curled = radians(-174.0);  // absolute bucket angle with the mouth up, at the end of the way out

// Along a bearing, r and z, m, from the start of the dig inward.
using DigShape = std::vector<std::array<double, 2>>;

// How high the bank that the bucket drags towards, half a metre nearer to the machine than its tip, stands over the tip, m.
double bank_over(const SurfaceProfile& surface, const ArmPoints& now);

// A tip's way out of the soil from where it is to above the surface, with the bucket curled (stentz-1999, Figure 14, begins there). Straight up, for what
// lies over the bucket falls into it and what lies inward would be pushed, and curled so that the shell goes no deeper, for soil under it holds a curl up
// more than all else; then up on, and inward a little, to where the bucket can be curled wholly: low and far out the arm does not reach that. Planned
// with, and where the boom is going; the joints themselves move each by itself.
std::vector<DigWaypoint> way_out(const MachineModel& machine, const SurfaceProfile& surface, const ArmPoints& now);

// Where the bucket has passed the ground is no higher than after: over its width along the bearing.
void lower_ground(DigGround& ground, double bearing, double bucket_width, const SurfaceProfile& after);

// What a dig along the path will leave, when the drag ends where the bucket holds the volume (bank m3, by the cut model) and goes its way out from there: from
// start_r inward to as far as the ground is changed, all at rest. ground: as it is believed to be before the dig.
DigShape shape_after(const MachineModel& machine, DigGround ground, double bearing, double bucket_width, const DigPath& path, double volume, double start_r);

}  // namespace berm::app
