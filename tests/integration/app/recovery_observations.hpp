// What the kernel's state says to the app while the machine stands on the bench, stopped or permitted to move.
#pragma once

#include "app/observation.hpp"

namespace berm::app_bench {

inline app::Observation stopped(double time_s, std::uint8_t reason) {
  app::Observation o;
  o.time_s = time_s;
  o.kernel_state = BERM_STATE_STOPPED;
  o.stop_reason = reason;
  o.latched = reason == BERM_STOP_OPERATOR;
  o.angle = {app::radians(60.0), app::radians(30.0), app::radians(-90.0), app::radians(-100.0)};
  o.blocked_bearing = app::radians(75.0);
  return o;
}

inline app::Observation permitted(double time_s) {
  app::Observation o = stopped(time_s, BERM_STOP_NONE);
  o.kernel_state = BERM_STATE_RUN;
  return o;
}

}  // namespace berm::app_bench
