#include "app/standing_watch.hpp"

#include <cmath>

namespace berm::app {

bool StandingWatch::step(const Observation& o, bool works) {
  constexpr double about = radians(1.0);
  bool moved = since_s_ < 0.0;
  for (std::size_t j = 0; j < joints; ++j) moved = moved || std::fabs(wrapped(o.angle[j] - from_[j])) > about;
  if (moved || !works) {
    from_ = o.angle;
    since_s_ = works ? o.time_s : -1.0;
    return false;
  }
  if (o.time_s - since_s_ < patience) return false;
  since_s_ = o.time_s;
  return true;
}

}  // namespace berm::app
