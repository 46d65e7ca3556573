// A scene's scanlines to the recogniser in order of their arrival: which answer stands, and how long after the last scanline that truly shows the truck.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "truck_world/trial.hpp"

namespace berm::truck_world {

// Milliseconds. One thread takes the scanlines and asks when the recogniser's rule says so, in its own measured CPU time; a scanline arrives at the end
// of its turn of the mirror, and waits while the thread has more to do.
struct Arrival {
  Trial trial;                      // of the answer that stands
  bool early = false;               // it stood before the sweep's end
  double after_last_scanline = 0.0; // from the arrival of the last scanline with a return from the truck to the answer; below 0: the answer was first
  std::vector<double> scanlines;    // what each scanline took that was taken in
  int asks = 0;
  double asking = 0.0;              // what all asks took
};

// Of a panning scanner's scene.
Arrival take_as_it_arrives(const Scene& scene, const app::TruckRangeSet& ranges);

// Counts and percentiles, by the keys of TRUCK_WORLD.md.
nlohmann::ordered_json summary(const std::vector<Arrival>& arrivals);

}  // namespace berm::truck_world
