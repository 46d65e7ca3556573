// The ground that a person or vehicle covers, and its place against the kernel's safety region. Base frame, metres, radians.
#pragma once

#include "core/monitor_histogram.h"
#include "core/monitor_rules.h"
#include "io/space_watch.hpp"
#include "plant/oracle/oracle.hpp"
#include "plant/process/world_config.hpp"
#include "plant/world/world.hpp"

namespace berm::watch {

struct Footprint {
  double x = 0.0, y = 0.0, yaw = 0.0;
  double radius = 0.0;                // of a person: a disc
  double length = 0.0, width = 0.0;   // of a vehicle: a rectangle with its length along the yaw; 0 for a person
};

Footprint footprint_of(const plant::MoverConfig& shape, double x, double y, double yaw);
// From a point to the footprint; 0 within it.
double distance(const Footprint& footprint, double x, double y);
// Whether it shares a point with the axis-aligned square that begins at (x, y).
bool meets_square(const Footprint& footprint, double x, double y, double side);
// Of the smallest circle about its middle that holds it.
double outer_radius(const Footprint& footprint);

// The cells in which the kernel now tells of somebody: by heights, or by free space, which watches a part of the truck zones as well.
struct Region {
  const sk_monitor_rules* rules = nullptr;
  const kernel::SpaceWatch* space = nullptr;  // null: not kept

  bool watched(int iy, int ix) const { return rules->watched[iy][ix] != 0 || (space != nullptr && space->kept() && space->watched(iy, ix)); }
};

// Whether the cell that holds a point is watched; no cell of the map is not.
bool watched_at(const Region& region, double x, double y);
// Whether the footprint covers some part of a watched cell.
bool meets_region(const Footprint& footprint, const Region& region);
// What one of the kernel's monitors holds: heights, or histograms where it compares with those.
struct Held {
  const sk_monitor* heights = nullptr;               // null: there is no such monitor
  const sk_monitor_histogram* histograms = nullptr;  // not null: heights are empty

  bool somebody(int iy, int ix) const;
};

// Whether a watched cell with its middle no farther from the footprint than within holds somebody.
bool somebody_near(const Footprint& footprint, double within, const Held& held, const sk_monitor_rules& rules);

// The person or vehicle as a body of the oracle's, standing at (x, y, z).
plant::oracle::Body body_of(const plant::MoverConfig& shape, const plant::MoverPose& pose);

}  // namespace berm::watch
