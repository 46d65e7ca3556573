// The coarse dig planner (stentz-1999, 4.2, Figures 11 and 12): the face in regions, columns from left to right and benches from the top down. What a
// region bounds the refined planner (dig_point.hpp) plans.
#pragma once

#include <vector>

#include "planning/dig_point.hpp"

namespace berm::app {

// The site's own bearings; those beside them; all with a drag that ends nearer to the machine. Later ones where those before yield too little.
enum class RegionReach { site, beside, nearer };
const char* reach_name(RegionReach reach);

struct DigRegion {
  int bench = 0;            // from the top, 1 first; 0: none
  int column = 0;           // from the left, 1 first
  RegionReach reach = RegionReach::site;
  DigBounds bounds;
};

struct RegionDig {
  DigRegion region;
  DigPlan plan;
  int candidates = 0;       // that the refined planner looked at in all of them
  int left = 0;             // regions that were looked at before and yield too little: dug out
};

// All regions of a site in the order in which they are worked: of every reach the upper bench first. The benches are equally high, none higher than the
// site's bench_height, from the ground that the machine stands on down to the floor of the digs; a column has none under the goal there.
std::vector<DigRegion> dig_regions(const MachineModel& machine, const SiteModel& site, const DigFloor& floor, const DigNeeds& needs);

// The next dig after one in the region `last`. A lower bench, and another reach, is worked when no column before yields three quarters of the wanted
// volume; of a bench the column that costs least: by the refined planner, and by the order, for to the left costs, and beside the last cut. Always
// gives a plan; where nothing yields enough, the cheapest there is.
RegionDig next_dig(const MachineModel& machine, const SiteModel& site, const DigFloor& floor, const DigGround& ground, const DigNeeds& needs, const DigRegion& last);

}  // namespace berm::app
