#include "planning/sticking_soil.hpp"

#include <algorithm>

#include "motion/angles.hpp"

namespace berm::app {

void StickingSoil::learn(double before_kg, double after_kg) {
  constexpr double least_kg = 300.0;  // of a handful the share says little
  constexpr double weight = 0.6;      // of the newest: soil changes with the weather
  constexpr double more = radians(13.0), less = radians(2.0), most = radians(38.0);
  in_bucket_ = std::max(0.0, after_kg);
  if (before_kg < least_kg) return;
  const double seen = std::clamp(after_kg / before_kg, 0.0, 1.0);
  share_ = (1.0 - weight) * share_ + weight * seen;
  open_farther_ = std::clamp(open_farther_ + (seen > noticed ? more : -less), 0.0, most);
}

}  // namespace berm::app
