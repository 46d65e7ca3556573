// What the app knows of the site, metres and radians; filled from the site file (app/machine_loader.hpp). Base frame.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace berm::app {

struct DigZone { double x_low = 0.0, y_low = 0.0, x_high = 0.0, y_high = 0.0, floor = 0.0, ceiling = 0.0; };

// Of the shape that digs are to leave: a rectangle with a level, which may slope. Of several that meet the later one counts.
struct GoalPart {
  double x_low = 0.0, y_low = 0.0, x_high = 0.0, y_high = 0.0;
  double level = 0.0;             // z at its middle
  double slope_x = 0.0, slope_y = 0.0;  // rise over run
};

struct TruckPlace {               // where trucks park
  double x = 0.0, y = 0.0;        // about the middle of the bed
  double yaw = 0.0;               // of the bed's long axis, either way round, from base x
  double target_kg = 0.0;
};

struct TruckZone { double x_low = 0.0, y_low = 0.0, x_high = 0.0, y_high = 0.0, ceiling = 0.0; };
struct GroundZone { double x_low = 0.0, y_low = 0.0, x_high = 0.0, y_high = 0.0, pass_over = 0.0; };  // lower ground

struct TruckBed {                 // inside of a recognised bed
  double centre_x = 0.0, centre_y = 0.0;
  double yaw = 0.0;               // of the long axis, from base x
  double length = 0.0, width = 0.0, height = 0.0;
  double wall_top = 0.0;          // z of the highest place of the walls' tops: what passes over them passes over that
  double rise_along = 0.0, rise_across = 0.0;  // rise over run of the plane of the tops, and of the floor, along the bed and to its left: the truck stands on sloping ground
  double end_deviation = 0.0;     // standard deviation of either end along the bed, as the recogniser says
  // Along the bed from its centre: how far the site's truck zone holds it. The kernel lets nothing pass over what is beyond, the cab above all.
  double zone_low = -std::numeric_limits<double>::infinity(), zone_high = std::numeric_limits<double>::infinity();
  double ceiling = std::numeric_limits<double>::infinity();  // z: over a load that stands higher the kernel lets nothing pass either

  // z of the plane of the tops, so far from the middle along the bed and to its left.
  double top_at(double u, double v) const { return wall_top + rise_along * u + rise_across * v - 0.5 * (std::fabs(rise_along) * length + std::fabs(rise_across) * width); }
};

struct SiteModel {
  std::vector<DigZone> dig_zones;
  TruckPlace place;
  std::vector<TruckZone> truck_zones;
  double pass_over = std::numeric_limits<double>::infinity();  // z: over what stands higher the kernel lets nothing pass, but in the zones
  std::vector<GroundZone> ground_zones;
  std::optional<TruckBed> bed;    // of the truck that was recognised, while it is there
  bool truck_admitted = false;    // one stands there by the spotter's word whose bed is not known any more
  double dig_swing_left = 0.0, dig_swing_right = 0.0;  // bearings between which the app digs; left > right
  double dig_radius_start = 0.0, dig_radius_end = 0.0; // of the tip, start > end
  double dig_floor = -std::numeric_limits<double>::infinity();  // z of the ground that digs leave
  std::vector<GoalPart> goal;     // where it is none of these: dig_floor
  double bench_height = std::numeric_limits<double>::infinity();  // a higher face is taken from the top, bench by bench
};

inline double middle_of_digs(const SiteModel& site) { return 0.5 * (site.dig_swing_left + site.dig_swing_right); }

}  // namespace berm::app
