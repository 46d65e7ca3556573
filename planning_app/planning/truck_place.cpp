#include "planning/truck_place.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

namespace {

bool in_any(const std::vector<TruckZone>& zones, double x, double y) {
  return std::any_of(zones.begin(), zones.end(), [&](const TruckZone& z) { return x >= z.x_low && x <= z.x_high && y >= z.y_low && y <= z.y_high; });
}

// How far from the bed's centre, to this side along it, the zones hold its centre line: to the centimetre, no farther than a truck is long.
double zone_reach(const TruckBed& bed, const std::vector<TruckZone>& zones, double side) {
  constexpr double step = 0.01, longest = 15.0;
  const double c = side * std::cos(bed.yaw), s = side * std::sin(bed.yaw);
  double reach = 0.0;
  while (reach < longest && in_any(zones, bed.centre_x + (reach + step) * c, bed.centre_y + (reach + step) * s)) reach += step;
  return reach;
}

// The least of what the zones allow along the bed's centre line.
double lowest_ceiling(const TruckBed& bed, const std::vector<TruckZone>& zones) {
  constexpr double step = 0.1;
  const double c = std::cos(bed.yaw), s = std::sin(bed.yaw), low = std::max(bed.zone_low, -0.5 * bed.length), high = std::min(bed.zone_high, 0.5 * bed.length);
  double lowest = std::numeric_limits<double>::infinity();
  for (double u = low; u <= high; u += step) {
    double here = -std::numeric_limits<double>::infinity();
    for (const TruckZone& z : zones)
      if (in_any({z}, bed.centre_x + u * c, bed.centre_y + u * s)) here = std::max(here, z.ceiling);
    if (std::isfinite(here)) lowest = std::min(lowest, here);
  }
  return lowest;
}

}  // namespace

void limit_to_zones(TruckBed& bed, const std::vector<TruckZone>& zones) {
  if (zones.empty()) return;
  bed.zone_low = -zone_reach(bed, zones, -1.0);
  bed.zone_high = zone_reach(bed, zones, 1.0);
  bed.ceiling = lowest_ceiling(bed, zones);
}

bool stands_in_zone(const TruckBed& bed, const std::vector<TruckZone>& zones) { return zones.empty() || in_any(zones, bed.centre_x, bed.centre_y); }

}  // namespace berm::app
