// Whether the truck that is worked on still stands there, by what the spotter says. Followed in every cycle: while the kernel keeps the machine one truck may
// leave and the next park, and whoever looked only when free to move would take the second for the first.
#pragma once

#include "app/observation.hpp"

namespace berm::app {

class TruckPresence {
public:
  enum class Gone { no, left, unadmitted };  // left: as the spotter said; unadmitted: he no longer says that it stands there, nor that it left

  // The truck that stands there now is the one that is meant.
  void begin() { *this = TruckPresence{}; }
  // Once a cycle.
  void step(const Observation& o);
  Gone gone() const { return gone_; }

private:
  Gone gone_ = Gone::no;
  double absent_since_s_ = -1.0;
};

}  // namespace berm::app
