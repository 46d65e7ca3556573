#include "app/standing_watch.hpp"

namespace berm::app {

bool StandingWatch::step(const Observation& o, bool works) {
  if (works) still_.step(o.time_s, o.angle);
  else still_.begin(o.time_s, o.angle);
  if (still_.seconds(o.time_s) < patience) return false;
  still_.begin(o.time_s, o.angle);
  return true;
}

}  // namespace berm::app
