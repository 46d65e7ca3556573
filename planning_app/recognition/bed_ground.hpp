// The ground beside a bed: a truck's walls have their tops so far over it, and a pit's or a wall's foot does not.
#pragma once

#include <optional>
#include <vector>

#include "recognition/bed_model.hpp"
#include "recognition/fans.hpp"
#include "recognition/truck_ranges.hpp"

namespace berm::app {

// The median of depths beside a bed; nothing of few.
std::optional<double> ground_below(std::vector<double> depths);

constexpr double kGroundLeast = 0.02;  // share of the returns beside a bed

// How far below the plane of the walls' tops the returns within 2.5 m outside the walls lie, m; of every stride-th return.
std::vector<double> depths_beside(const FanSweep& sweep, const BedPose& pose, std::size_t stride = 1);

// Of these the share that lies as deep as the ground that a truck stands on; 1 with too few returns. On the near side the bench may be higher, so a small
// share tells enough.
double share_of_ground(const std::vector<double>& depths, const SizeRange& top_over_ground, std::size_t stride = 1);

// Whether what is seen beside the bed, beyond its far walls but not where its cab stands (cab_end 1: at +u), lies level with the walls' tops, and next to
// nothing of it where a truck's ground would be: a pit.
bool lies_in_level_ground(const FanSweep& sweep, const BedPose& pose, int cab_end);

}  // namespace berm::app
