#include "planning/truck_fill.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

void TruckFill::add_pass(double before_kg, double after_kg) {
  loaded_ += std::max(0.0, before_kg - after_kg);
  ++passes_;
}

double TruckFill::next_goal_kg(double full_bucket_kg) const {
  const double left = target_ - loaded_;
  if (left <= 0.0) return 0.0;
  const double passes = std::ceil(left / full_bucket_kg);
  return std::min(left / passes, overload_share * target_ - loaded_);
}

}  // namespace berm::app
