// The sequencer's side of the sensor motion planner: when the next swing begins, and that it waits for the scanner that leads it.
#include <algorithm>
#include <cmath>

#include "app/sequencer.hpp"

namespace berm::app {

bool Sequencer::swings() const { return phase_ == BERM_PHASE_SWING_TO_TRUCK || phase_ == BERM_PHASE_SWING_TO_DIG; }

// Back: the swing from the truck to the next dig is what comes, or goes on.
bool Sequencer::swings_back() const { return phase_ == BERM_PHASE_DUMP || phase_ == BERM_PHASE_SWING_TO_DIG; }

SwingForecast::Work Sequencer::work_before_swing() const {
  using Work = SwingForecast::Work;
  if (stage_ == Stage::dig) return Work::digs;
  const bool lifts = stage_ == Stage::curl || (stage_ == Stage::pass && !script_.of(swing).reached(RuleMark::leaves));
  return !lifts ? Work::other : awaits_scan_ ? Work::waits : Work::lifts;
}

ComingSwing Sequencer::coming_swing(const Observation& o) {
  const double done = stage_ == Stage::dig ? std::clamp(std::max(follower_.progress(), dug_share_), 0.0, 1.0) : 0.0;
  ComingSwing coming;
  coming.begins_in_s = swing_forecast_.step(o.time_s, work_before_swing(), done);
  // Over the bed the arm reaches out when the swing is slow, over the dig while it is still fast.
  coming.reach_m = std::max(reach_of(machine_, swings_back() ? poses_.hover : poses_.carry), swings() ? reach_of(machine_, o.angle) : 0.0);
  return coming;
}

std::uint32_t Sequencer::scan_event(const Observation& o, std::uint32_t events) {
  awaits_scan_ = script_.of(swing).waits_only_for(event_scanned, o.angle, events);
  const bool scanned = scan_wait_.step(o.time_s, scanners_.lead(), awaits_scan_, swings_back() ? "to dig" : "to truck", log_);
  awaits_scan_ = awaits_scan_ && !scanned;
  return scanned ? event_scanned : event_none;
}

void Sequencer::note_swing_began(const Observation& o, bool left_before, bool returned_before) {
  const bool leaves = script_.of(swing).reached(RuleMark::leaves), returns = script_.of(swing).reached(RuleMark::returns);
  if (leaves == left_before && returns == returned_before) return;
  scan_wait_.swing_began(o.time_s, scanners_.lead(), returns ? "to dig" : "to truck", log_);
}

}  // namespace berm::app
