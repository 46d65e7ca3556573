// A recognised bed at the place where trucks park.
#pragma once

#include "planning/site_model.hpp"

namespace berm::app {

// Sets zone_low, zone_high and ceiling by the site's truck zones; without any the bed may be passed over everywhere.
void limit_to_zones(TruckBed& bed, const std::vector<TruckZone>& zones);

// Whether the bed's middle lies in a truck zone, or the site has none.
bool stands_in_zone(const TruckBed& bed, const std::vector<TruckZone>& zones);

}  // namespace berm::app
