#include "app/hold_watch.hpp"

#include <cmath>

#include "motion/angles.hpp"

namespace berm::app {

void HoldWatch::step(double time_s, const Joints& angle, bool cut) {
  bool anew = time_s - cut_s_ > gap;
  for (std::size_t j = 0; j < joints && !given_up(); ++j) anew = anew || std::fabs(wrapped(angle[j] - from_[j])) > about;
  if (cut) cut_s_ = time_s;
  if (anew) {
    since_s_ = time_s;
    from_ = angle;
  }
  seconds_ = time_s - since_s_;
}

}  // namespace berm::app
