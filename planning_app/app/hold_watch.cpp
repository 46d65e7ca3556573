#include "app/hold_watch.hpp"

namespace berm::app {

void HoldWatch::step(double time_s, const Joints& angle, bool cut) {
  if (time_s - cut_s_ > gap) still_.begin(time_s, angle);
  else if (!given_up()) still_.step(time_s, angle);
  if (cut) cut_s_ = time_s;
  seconds_ = still_.seconds(time_s);
}

}  // namespace berm::app
