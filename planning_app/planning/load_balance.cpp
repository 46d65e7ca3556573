#include "planning/load_balance.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

namespace {

// The moment nearest to zero that the rest can bring it to.
double least_moment(double moment, double rest_kg, double low, double high) {
  const double lowest = moment + rest_kg * low, highest = moment + rest_kg * high;
  return lowest > 0.0 ? lowest : highest < 0.0 ? -highest : 0.0;
}

}  // namespace

double least_final_offset(const LoadMoment& load, double rest_kg, const BedArea& area) {
  const double kg = load.kg + std::max(0.0, rest_kg);
  if (kg <= 0.0) return 0.0;
  return std::hypot(least_moment(load.u_kgm, std::max(0.0, rest_kg), area.u_low, area.u_high),
                    least_moment(load.v_kgm, std::max(0.0, rest_kg), area.v_low, area.v_high)) / kg;
}

}  // namespace berm::app
