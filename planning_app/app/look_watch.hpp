// What a look round, or at a truck, waits for longer than one that goes well ever does: the operator is told what to look at, once each until something
// comes of it, and the look is begun anew.
#pragma once

#include <vector>

#include "app/observation.hpp"
#include "app/progress_log.hpp"

namespace berm::app {

enum class Awaited { nothing, left_pan, right_pan, both_pans, standstill, recogniser };

class LookWatch {
public:
  // s. A look round takes 9.2 s at most (both pans from one end to the other and back), one at a truck, with its answer and the other scanner's look at the
  // feet, 20 s; pans turn at their speed in dust, too, and while the kernel lets motions out slowly.
  static constexpr double patience = 30.0;
  // Once a cycle. True when the look is to be begun anew.
  bool step(const Observation& o, Awaited awaited, const ProgressLog& log);

private:
  std::vector<Awaited> told_;
  double since_s_ = -1.0;  // that something is awaited; negative: nothing is
};

}  // namespace berm::app
