// A kernel that has started or was reset begins nothing before the run switch was switched off once: who left it on is told, once each time.
#pragma once

#include "app/observation.hpp"
#include "app/progress_log.hpp"

namespace berm::app {

class RestartCall {
public:
  void step(const Observation& o, const ProgressLog& log);

private:
  bool told_ = false;
  double since_s_ = -1.0;  // of what must be told; negative: nothing
};

}  // namespace berm::app
