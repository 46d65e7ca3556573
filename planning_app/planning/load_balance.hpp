// Where a load's centre lies over the axles, and whether what is still to come can bring it to the bed's middle.
#pragma once

#include "planning/skyline.hpp"

namespace berm::app {

// Mass and its first moments about the bed's middle.
struct LoadMoment {
  double kg = 0.0, u_kgm = 0.0, v_kgm = 0.0;

  void add(const BedPoint& at, double mass_kg) {
    kg += mass_kg;
    u_kgm += mass_kg * at.u;
    v_kgm += mass_kg * at.v;
  }
  BedPoint centre() const { return kg > 0.0 ? BedPoint{u_kgm / kg, v_kgm / kg} : BedPoint{}; }
};

struct BedArea { double u_low = 0.0, u_high = 0.0, v_low = 0.0, v_high = 0.0; };

// How far from the bed's middle, m, the centre of the whole load must end at least when rest_kg more are dumped anywhere within the area.
double least_final_offset(const LoadMoment& load, double rest_kg, const BedArea& area);

}  // namespace berm::app
