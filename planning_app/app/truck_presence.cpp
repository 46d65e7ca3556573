#include "app/truck_presence.hpp"

namespace berm::app {

namespace {
constexpr double no_exchange_s = 2.0;  // of silence of the spotter: no truck drives off and another parks in so short a time
}

void TruckPresence::step(const Observation& o) {
  if (gone_ == Gone::left) return;
  if (o.truck_leaves) {
    gone_ = Gone::left;
    return;
  }
  if (o.truck_parked) {
    absent_since_s_ = -1.0;
    return;
  }
  if (absent_since_s_ < 0.0) absent_since_s_ = o.time_s;
  if (o.time_s - absent_since_s_ >= no_exchange_s) gone_ = Gone::unadmitted;
}

}  // namespace berm::app
