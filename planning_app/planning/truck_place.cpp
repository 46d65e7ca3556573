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

}  // namespace

void limit_to_zones(TruckBed& bed, const std::vector<TruckZone>& zones) {
  if (zones.empty()) return;
  bed.zone_low = -zone_reach(bed, zones, -1.0);
  bed.zone_high = zone_reach(bed, zones, 1.0);
}

bool stands_in_zone(const TruckBed& bed, const std::vector<TruckZone>& zones) { return zones.empty() || in_any(zones, bed.centre_x, bed.centre_y); }

}  // namespace berm::app
