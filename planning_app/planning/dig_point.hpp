// Where and how deep to dig next: a forward model of the cut along each bearing, over the observed terrain.
#pragma once

#include <vector>

#include "motion/dig_path.hpp"
#include "planning/cut_model.hpp"
#include "planning/site_model.hpp"
#include "planning/dig_ground.hpp"

namespace berm::app {

struct DigPlan {
  double bearing = 0.0;             // swing angle
  double depth = 0.0;               // greatest vertical depth under the surface, m
  double volume = 0.0;              // bank volume the forward model expects, m3
  double end_radius = 0.0;          // of the tip
  double start_height = 0.0;        // surface where the tip enters, z
  std::vector<DigWaypoint> drag;    // from above the entry to the end with the bucket curled
};

struct DigNeeds {
  double volume = 1.1;              // bank m3 wanted
  double bucket_width = 1.1;        // m
  double deepest = 1.0;             // most vertical depth under the surface, m
  double floor_guard = 0.75;        // the tip stays this far above the dig zone's floor
};

// First between the site's bearings; where these no longer yield enough, beside them and nearer the machine, inside the dig zone.
// Bearings stand from left to right; the one after the last is preferred, then the one that yields the wanted volume with the least depth.
// Always gives a plan; where nothing yields enough, the best there is.
DigPlan choose_dig(const MachineModel& machine, const SiteModel& site, const DigGround& ground, const DigNeeds& needs, double last_bearing);

// The tip stays above this height: the highest floor of the dig zones and the guard over it.
double lowest_tip(const SiteModel& site, double floor_guard);

// The dig along one bearing.
DigPlan plan_dig(const MachineModel& machine, const SiteModel& site, const DigGround& ground, const DigNeeds& needs, double bearing);

}  // namespace berm::app
