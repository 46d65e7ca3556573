// Whether the base has moved, by tilt, turn or slip, since the kernel last stopped the machine for good. From then on nothing that was seen is where it was, and by
// how far nobody knows.
#pragma once

#include "app/observation.hpp"

namespace berm::app {

class BaseWatch {
public:
  // Once a cycle. map_void: nothing stands in the copy of the kernel's map. True when the operator has reset such a stop: what is seen from now on holds.
  bool step(const Observation& o, bool map_void);

private:
  bool moved_ = false, latched_ = false;
};

}  // namespace berm::app
