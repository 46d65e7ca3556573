#include "planning/truck_fill.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

void TruckFill::add_pass(double before_kg, double after_kg) {
  loaded_ += std::max(0.0, before_kg - after_kg);
  ++passes_;
}

int TruckFill::passes_left() const {
  constexpr double rounding = 1e-9;  // a truck of whole buckets takes no pass more
  return full() ? 0 : static_cast<int>(std::ceil(rest_kg() / full_bucket_ - rounding));
}

double TruckFill::next_goal_kg() const {
  const int passes = passes_left();
  return passes == 0 ? 0.0 : rest_kg() / passes;
}

double TruckFill::allowed_kg(double kg, double stays_kg) const {
  if (loaded_ + std::max(0.0, kg - stays_kg) <= most_share * target_) return kg;
  // A part: the bucket keeps more than sticks in it, and every kilogram that leaves it counts. No smaller than what a pass is worth: of a truck that is not
  // full there is room for that.
  return std::max({0.0, std::min(rest_kg(), worth_share * full_bucket_), part_share * target_ - loaded_});
}

bool TruckFill::must_weigh(double heaped_kg) const { return loaded_ + heaped_kg > most_share * target_; }

}  // namespace berm::app
