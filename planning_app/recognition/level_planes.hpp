// The last two levels of the interpretation tree: which level region is the floor of a bed whose sides and ends are matched, and which its canopy (stentz-1999, section 4.1; Grimson, 1990).
// Each may be absent, for a load hides the floor and most trucks have no canopy.
#pragma once

#include <optional>
#include <vector>

#include "recognition/bed_model.hpp"
#include "recognition/level_regions.hpp"
#include "recognition/truck_ranges.hpp"

namespace berm::app {

// Metres, in the bed's frame.
struct FloorPlane {
  double depth = 0.0;      // below the plane of the tops, in the bed's middle
  double flatness = 0.0;   // how much likelier its returns lie so near to one plane on a floor than on soil, logarithm
  int count = 0;           // of returns
  double spread = 0.0, noise = 0.0;  // as the region's
};
struct CanopyPlane {
  int end = 1;             // beyond which it is: 1: +u
  double length = 0.0;     // from the end wall's outer face to where its returns end
  double rise = 0.0;       // over run, from the bed
  int count = 0;           // of returns
  double spread = 0.0, noise = 0.0;  // as the region's
};

struct LevelPlanes {
  std::optional<FloorPlane> floor;
  std::optional<CanopyPlane> canopy;
  double worth = 0.0;      // of the matches, in rays, less what absence costs
  int tried = 0;           // of matches, at both levels
};

// The best of all matches of the regions to floor and canopy. Depth first: the floor or none, then the canopy or none; each is held against the sides and ends and against what was matched before it.
// ground: how deep the ground lies below the tops, where that is known.
LevelPlanes match_level_planes(const BedPose& pose, const std::vector<LevelRegion>& regions, const TruckRangeSet& ranges, std::optional<double> ground = {});

}  // namespace berm::app
