#include "perception/projection_check.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

double ProjectionCheck::Disagreement::distance() const { return std::hypot(here[0] - kernel[0], here[1] - kernel[1], here[2] - kernel[2]); }

void ProjectionCheck::compare(std::size_t scanner, double time_s, const std::array<double, 3>& here, const std::int32_t (&kernel_mm)[3]) {
  if (kernel_mm[0] == 0 && kernel_mm[1] == 0 && kernel_mm[2] == 0) return;
  if (std::any_of(here.begin(), here.end(), [](double v) { return std::fabs(v) > farthest; })) return;
  ++compared_;
  const std::array<double, 3> kernel{kernel_mm[0] * 1e-3, kernel_mm[1] * 1e-3, kernel_mm[2] * 1e-3};
  const auto apart = [&](std::size_t axis) { return std::fabs(here[axis] - kernel[axis]) > tolerance; };
  if (!apart(0) && !apart(1) && !apart(2)) return;
  ++disagreeing_;
  if (!first_) first_ = Disagreement{scanner, time_s, here, kernel};
}

}  // namespace berm::app
