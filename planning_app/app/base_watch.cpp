#include "app/base_watch.hpp"

#include <utility>

namespace berm::app {

bool BaseWatch::step(const Observation& o, bool map_void) {
  // A base that moves in another latched stop or a fault changes nothing in the published reason; but the kernel keeps its map void until the reset (SK-BM-11).
  const bool reset = latched_ && !o.latched;
  if (o.stop_reason == BERM_STOP_BASE_MOVED || (reset && map_void)) moved_ = true;
  latched_ = o.latched;
  // While it brakes or stands for it, and in a fault, the base may still be moving.
  if (o.kernel_state != BERM_STATE_STANDBY && o.kernel_state != BERM_STATE_RUN) return false;
  return std::exchange(moved_, false);
}

}  // namespace berm::app
