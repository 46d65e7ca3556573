// Whether the machine stands though it is the plan's turn to move it: a script that waits for what never comes.
#pragma once

#include "app/observation.hpp"
#include "app/stillness.hpp"

namespace berm::app {

class StandingWatch {
public:
  static constexpr double patience = 20.0;  // s: longer than the guard holds a motion back, and than any pouring, weighing or landing takes

  // Once a cycle. works: the kernel permits motion, and the plan is to move the machine and waits for nobody. True when nothing has moved for so long, and
  // again each time that it has not.
  bool step(const Observation& o, bool works);

private:
  Stillness still_;
};

}  // namespace berm::app
