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
  if (stays_kg > 0.0) return kg > stays_kg ? stays_kg + allowed_kg(kg - stays_kg) : kg;
  if (loaded_ + kg > most_share * target_) return std::max(0.0, part_share * target_ - loaded_);
  return kg;
}

bool TruckFill::must_weigh(double heaped_kg) const { return loaded_ + heaped_kg > most_share * target_; }

}  // namespace berm::app
