// The refined dig planner (stentz-1999, 4.2, Figure 13): how deep to dig within a region, by a forward model of each candidate over the ground as it is believed
// to be (dig_candidate.hpp), and what that costs.
#pragma once

#include <optional>
#include <vector>

#include "motion/dig_path.hpp"
#include "planning/cut_model.hpp"
#include "planning/dig_floor.hpp"
#include "planning/dig_ground.hpp"
#include "planning/site_model.hpp"

namespace berm::app {

struct DigPlan {
  double bearing = 0.0;             // swing angle
  double depth = 0.0;               // greatest vertical depth under the surface, m
  double volume = 0.0;              // bank volume the forward model expects, m3
  double cost = 0.0;                // s: what it lacks of the wanted volume, and its energy
  double start_height = 0.0;        // surface where the tip enters, z
  std::vector<DigWaypoint> drag;    // from above the entry to the end with the bucket curled
  double energy = 0.0;              // J, at the bucket
  double dig_seconds = 0.0;         // drag and way out, by what the joints can
  double swing_seconds = 0.0;       // to where it will be dumped, and back
  double price() const { return cost + dig_seconds + swing_seconds; }
  int candidates = 0;               // that were looked at
};

struct DigNeeds {
  double volume = 1.1;              // bank m3 wanted
  double bucket_width = 1.1;        // m
  double deepest = 1.0;             // most vertical depth under the surface, m
  double dump_beyond = 0.0;         // rad: by how much the bucket swings farther back from the last dump than from the bed's middle, in the sense of the swing there
  double effort = 135e3;            // J that cutting the wanted volume takes half a metre under the surface
  double payload = 0.0;             // kg that the wanted volume weighs: the joints answer accordingly
  std::optional<double> dump_bearing = std::nullopt;  // about where it will be dumped
};

// What a region leaves open.
struct DigBounds {
  double bearing = 0.0;
  double floor = 0.0;               // z: the tip stays above
  double end_radius = 0.0;          // of the tip: the drag goes no farther inward
};

// The dig within the bounds that brings the wanted volume, or as much as there is and arm and zones permit.
DigPlan plan_dig(const MachineModel& machine, const SiteModel& site, const DigFloor& floor, const DigGround& ground, const DigNeeds& needs, const DigBounds& bounds);

}  // namespace berm::app
