// The bed to load that a recognised truck has: its size, where it stands, and how it tilts.
#pragma once

#include "planning/site_model.hpp"
#include "recognition/truck_recogniser.hpp"

namespace berm::app {

// truck: one that was found. What the site says of the place is not set.
TruckBed recognised_bed(const RecognisedTruck& truck);

}  // namespace berm::app
