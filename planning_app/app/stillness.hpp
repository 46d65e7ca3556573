// Since when no joint has got farther than a degree from where it was.
#pragma once

#include <cmath>
#include <limits>

#include "motion/angles.hpp"

namespace berm::app {

class Stillness {
public:
  static constexpr double about = radians(1.0);  // what a joint that stands sags or trembles by, at most

  void begin(double time_s, const Joints& angle) {
    since_s_ = time_s;
    from_ = angle;
  }
  // Once a cycle; begins anew where something has moved.
  void step(double time_s, const Joints& angle) {
    for (std::size_t j = 0; j < joints; ++j)
      if (!(std::fabs(wrapped(angle[j] - from_[j])) <= about)) return begin(time_s, angle);
  }
  double seconds(double time_s) const { return time_s - since_s_; }

private:
  static constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();  // before the first cycle
  Joints from_{nowhere, nowhere, nowhere, nowhere};
  double since_s_ = 0.0;
};

}  // namespace berm::app
