#include "app/restart_call.hpp"

namespace berm::app {

namespace {
constexpr double about_to = 3.0;  // s: who has just pressed reset may have his hand at the switch
}

void RestartCall::step(const Observation& o, const ProgressLog& log) {
  if (!(o.release_awaited && o.run_switch)) {
    told_ = false;
    since_s_ = -1.0;
    return;
  }
  if (since_s_ < 0.0) since_s_ = o.time_s;
  if (told_ || o.time_s - since_s_ < about_to) return;
  told_ = true;
  log.event("operator_needed", {{"time_s", o.time_s}, {"reason", "run switch left on"}, {"advice", "look whether the machine may start, then switch run off and on again"}});
}

}  // namespace berm::app
