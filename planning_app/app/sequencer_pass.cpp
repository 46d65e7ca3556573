// A pass from the lifted bucket until over the next dig: when the bucket may open and has emptied, what it brought, and what comes after it.
#include <algorithm>
#include <cmath>

#include "app/sequencer.hpp"
#include "app/slow_pour.hpp"
#include "motion/bucket_weight.hpp"

namespace berm::app {

namespace {

constexpr double poor_share = 0.1;                // a pass that brings less of its goal found nothing
constexpr int most_poor_passes = 4;               // in a row; then there is nothing left to dig from here
constexpr std::size_t least_swung = 50;           // cycles of pressures that weigh a bucket on its way at any tilt
constexpr double resting = radians(-165.0);       // bucket: before this tilt nothing slides

}  // namespace

// In the bed's frame, a way along the swing back from over the dump point, m at a distance from the swing axis.
BedPoint Sequencer::along_way_back(double way, double radius) const {
  const double bearing = task_.truck_bearing + std::copysign(way / radius, task_.next_bearing - task_.truck_bearing);
  return to_bed(*site_.bed, radius * std::cos(bearing), radius * std::sin(bearing));
}

bool Sequencer::over_bed_on_way_back(double way) const {
  constexpr double lip_beyond = 0.9;  // m beyond the dump point, of the opened bucket's
  const BedPoint there = along_way_back(way, task_.dump_radius + lip_beyond * scale_.bucket);
  return std::fabs(there.u) + 0.5 * bucket_width(machine_) < 0.5 * site_.bed->length && std::fabs(there.v) < 0.5 * site_.bed->width;
}

// Whether the way back is over the bed until the bucket has run out.
bool Sequencer::runs_out_over_bed() const {
  constexpr double trails = 1.1;  // m
  return over_bed_on_way_back(trails * scale_.arm);
}

// By the kernel, for longer than a joint takes to speed up.
bool Sequencer::let_out_slowly() const {
  constexpr double slow = 0.5, for_s = 1.0;
  const Joints shares = arm_.shares();
  return slow_down_.lasts_s() > for_s && *std::min_element(shares.begin(), shares.end()) < slow;
}

bool Sequencer::waits_with_pour(const Observation& o) const {
  return !emptied_ && let_out_slowly() && lip_still_comes(share_beside(machine_, *site_.bed, o.angle, 0.5 * bucket_width(machine_)), script_.goals(), o.angle, o.velocity);
}

// Whether what is poured comes onto a heap, off whose sides it slides over the walls.
bool Sequencer::pours_onto_heap() const {
  constexpr double heaps_from = 0.6;  // of the truck's load
  return fill_.loaded_kg() > heaps_from * fill_.target_kg();
}

// Of its load, what may still be in the bucket when the swing turns round.
double Sequencer::share_that_may_trail() const {
  constexpr double over_bed = 0.52, over_heap = 0.42, beyond = 0.22;
  constexpr double less = 0.12;  // besides what sticks, which lets go late and all at once
  const double share = !runs_out_over_bed() ? beyond : pours_onto_heap() ? over_heap : over_bed;
  const double trails = sticking_.sticks() ? share - less + sticking_.share() : share;
  if (!let_out_slowly()) return trails;
  constexpr double step = 0.1, farthest = 4.0;  // m
  double way = 0.0;
  while (way < farthest && over_bed_on_way_back(way + step)) way += step;
  return std::min(trails, share_run_out_over(machine_, way / task_.dump_radius) + sticking_.share());
}

// Where the middle of what this pass brought lies: what runs out over the way back is 0.10 m off in the mean.
BedPoint Sequencer::lies_at(double payload_kg) const {
  constexpr double trails = 0.10;
  const BedPoint at = landing(*site_.bed, dump_.at, payload_kg, scale_);
  if (load_check_.keeps_rest() || !runs_out_over_bed()) return at;
  const BedPoint from = along_way_back(0.0, task_.dump_radius), to = along_way_back(trails * scale_.arm, task_.dump_radius);
  return {at.u + to.u - from.u, at.v + to.v - from.v};
}

std::uint32_t Sequencer::pass_events(const Observation& o) {
  constexpr double open_at_least = 0.25, open_at_most = 2.0;
  const bool opening = script_.of(bucket).reached(RuleMark::opens);
  const std::uint32_t weighed = load_check_.weighed() ? event_weighed : event_none;
  if (reach_again_.active()) return weighed;
  if (!opening || emptied_) return emptied_ ? event_emptied | event_empties | weighed : weighed;
  if (load_check_.pours_part()) return weighed;
  if (load_check_.keeps_rest()) {
    emptied_ = true;
    script_.interrupted();  // a part may have been poured without the bucket rising to where the arm goes on
    return event_emptied | event_empties | weighed;
  }
  if (open_since_s_ < 0.0 && o.angle[bucket] > poses_.dump[bucket] - radians(30.0)) open_since_s_ = o.time_s;
  // Much of what was in it is gone, and the bucket opens on: known only where it was weighed on the way.
  const bool empties = o.payload_kg >= 0.0 && recent_.kg() < share_that_may_trail() * lifted_kg();
  const std::uint32_t so_far = empties ? event_empties | weighed : weighed;
  if (open_since_s_ < 0.0) return so_far;
  // The load needs an open bucket, not time: while the bucket is slowed on its way the clock is too.
  const bool on_its_way = o.angle[bucket] < poses_.dump[bucket] - radians(8.0);
  if (on_its_way) open_since_s_ += (1.0 - arm_.shares()[bucket] * tempos()[bucket]) * machine_.cycle;
  const double open = o.time_s - open_since_s_;
  const double stays_kg = sticking_.stays_kg(lifted_kg());
  const bool light = o.payload_kg >= 0.0 && recent_.kg() < empty_share * full_bucket_kg() + stays_kg;
  emptied_ = (open > open_at_least && (light || o.payload_kg < 0.0)) || open > open_at_most;
  return emptied_ ? event_emptied | event_empties | weighed : so_far;
}

// Until the load slides, also when the bucket begins to open.
bool Sequencer::carries_level(const Observation& o) const {
  return (phase_ == BERM_PHASE_SWING_TO_TRUCK || phase_ == BERM_PHASE_DUMP) && forward(machine_, o.angle).bucket_attitude < resting;
}

// What is in it by the cylinders' pressures; negative: unknown.
double Sequencer::pressed_kg(const Observation& o) const {
  return weight_.known(o.angle) ? weight_in_bucket(machine_, o.angle, holding_moments(machine_, o.pressure), weight_.of(o.angle)) : -1.0;
}

void Sequencer::watch_pour(const Observation& o, double kg) {
  if (reach_again_.active()) pour_.pause(pours_);
  else if (!emptied_) pour_.step({kg, carries_level(o), share_beside(machine_, *site_.bed, o.angle, bucket_width(machine_) / 2.0)});
}

// The on-board weighing is blind for a while after the soil, at times until the load slides, and then seen for a few readings only: the pressures say it too.
// A bucket that is never held level, so that it may be losing soil, is weighed by them as it swings.
std::optional<double> Sequencer::weighed_kg() const {
  if (!before_.known() && load_check_.lifted_kg() >= 0.0) return load_check_.lifted_kg();
  if (!pour_.carried_known()) {
    if (before_.known()) return before_.kg();
    return swung_.count() >= least_swung ? std::optional(swung_.kg()) : std::nullopt;
  }
  return before_.known() ? 0.5 * (before_.kg() + pour_.carried_kg()) : pour_.carried_kg();
}

Joints Sequencer::pass(const Observation& o) {
  const auto opens = [this] { return script_.of(bucket).reached(RuleMark::opens) && !reach_again_.active(); };
  const double by_pressures = pressed_kg(o);
  const LoadCheck::Lifted lifted{.time_s = o.time_s,
                                 .payload_kg = o.payload_kg,
                                 .attitude = forward(machine_, o.angle).bucket_attitude,
                                 .over_bed = opens(),
                                 .stays_kg = sticking_.stays_kg(std::max(0.0, o.payload_kg >= 0.0 ? o.payload_kg : by_pressures)),
                                 .lifts = !script_.of(swing).reached(RuleMark::leaves),
                                 .pressed_kg = by_pressures,
                                 .carried_kg = pour_.carried_known() ? pour_.carried_kg() : -1.0,
                                 .beside_kg = filled_.known() ? pour_.beside_kg() : 0.0};
  const double tilt = load_check_.step(lifted, fill_, log_);
  const std::uint32_t events = pass_events(o);
  const bool left_before = script_.of(swing).reached(RuleMark::leaves), returned_before = script_.of(swing).reached(RuleMark::returns);
  Joints command = run_script(o, events | scan_event(o, events));
  note_swing_began(o, left_before, returned_before);
  if (tilt >= 0.0) command[bucket] = tilt;
  if (opens() && waits_with_pour(o)) command[bucket] = std::min(command[bucket], 0.0);
  if (!script_.of(swing).reached(RuleMark::leaves)) enter_phase(BERM_PHASE_LIFT, o);
  else if (script_.of(swing).reached(RuleMark::returns)) enter_phase(BERM_PHASE_SWING_TO_DIG, o);
  else enter_phase(opens() ? BERM_PHASE_DUMP : BERM_PHASE_SWING_TO_TRUCK, o);
  // On the way at any tilt: some buckets are never seen level, and one that nothing has weighed is booked by its goal, up to 200 kg too low. Not what a stop
  // amid the pour has left in it.
  pours_ = pours_ || (phase_ == BERM_PHASE_DUMP && !carries_level(o));
  if (!pours_ && (phase_ == BERM_PHASE_SWING_TO_TRUCK || carries_level(o))) before_.add(o.payload_kg);
  if (phase_ == BERM_PHASE_SWING_TO_TRUCK) swung_.add(by_pressures);
  watch_pour(o, by_pressures);
  if (emptied_ && !(load_check_.keeps_rest() && script_.of(swing).at_last())) after_.add(o.payload_kg);  // what it keeps it lets go over the dig
  const Joints goals = script_.goals();
  // The boom may be higher yet: the drag's way down begins from where it is.
  constexpr Joints close{radians(4.0), radians(10.0), radians(4.0), radians(5.0)};
  bool near = true;
  for (std::size_t j = 0; j < joints; ++j) near = near && std::fabs(goals[j] - o.angle[j]) < close[j];
  if (script_.at_last() && near) end_pass(o);
  return command;
}

// Of what was poured on the load as it was seen before the dump.
double Sequencer::over_walls_kg(double poured_kg) {
  return dump_.over_walls ? dump_.over_walls->falls(lies_at(poured_kg), poured_kg) : 0.0;
}

// What this pass brought, into the truck's books.
void Sequencer::book_pass(const Observation& o) {
  const std::optional<double> seen = weighed_kg();
  const double carried = seen.value_or(0.0);
  const bool weighed = carried > 0.0 && after_.known();
  // A bucket that nothing has weighed is taken for no less than the dig's force says: else the truck would be overloaded.
  const double unweighed_kg = filled_.known() ? std::max(goal_kg_, std::min(heaped_.kg(), filled_.kg())) : goal_kg_;
  // A part leaves the rest in it, and stops may have kept a bucket whose swing had turned round from opening on: what is in it then is not in the truck.
  const double unpoured_kg = load_check_.keeps_rest() ? load_check_.rest_kg() : !emptied_ && o.payload_kg >= 0.0 ? recent_.kg() : 0.0;
  const double before = seen.value_or(unweighed_kg), after = after_.known() ? left_in_bucket(after_.kg()) : std::max(unpoured_kg, sticking_.stays_kg(carried));
  // Before a bucket came back empty from over a bed, what the implements weigh out there is extrapolated.
  const double beside_kg = filled_.known() ? pour_.booked_beside_kg(pours_onto_heap()) : 0.0;
  const double had = fill_.loaded_kg(), over_kg = over_walls_kg(before - beside_kg - after);
  fill_.add_pass(before - beside_kg - over_kg, after);
  const double payload = fill_.loaded_kg() - had;
  if (weighed) {
    const double lifted = std::max(before, load_check_.lifted_kg()), brought_along = sticking_.left_kg();
    learn_yield(lifted, brought_along);
    learn_heaped(o, lifted);
    filled_.learn(lifted - brought_along, heaped_.kg() - brought_along);
    if (!load_check_.keeps_rest()) sticking_.learn(lifted, after);
    if (sticking_.sticks())
      log_.event("sticking", {{"time_s", o.time_s}, {"stays_kg", after}, {"share", sticking_.share()}, {"open_farther_deg", degrees(sticking_.open_farther())}});
  }
  poor_passes_ = payload < poor_share * goal_kg_ ? poor_passes_ + 1 : 0;
  face_yield_.add(payload / goal_kg_);
  loaded_here_kg_ += payload;
  dumps_.push_back({lies_at(payload), payload});
  bed_->note_dump(dumps_.back().at, payload);
  ++pass_;
  log_.event("pass", {{"pass", pass_}, {"truck", truck_}, {"seconds", o.time_s - pass_began_s_}, {"payload_kg", payload}, {"loaded_kg", fill_.loaded_kg()}, {"carried_kg", carried}, {"beside_kg", beside_kg}, {"over_walls_kg", over_kg},
                      {"dump_u_m", dump_.at.u}, {"dump_v_m", dump_.at.v}, {"dig_bearing_deg", degrees(task_.lifted_from[swing])}, {"time_s", o.time_s}});
  pass_began_s_ = o.time_s;
}

void Sequencer::end_pass(const Observation& o) {
  stands_ = 0;
  book_pass(o);
  go_on_after_pass(o, task_.lower_at_end);
}

// lowered: over the next dig.
void Sequencer::go_on_after_pass(const Observation& o, bool lowered) {
  const bool poor = (poor_passes_ >= most_poor_passes || face_yield_.poor()) && !fill_.full();
  if (!poor && !fill_.full() && more_fits(o)) {
    if (lowered) enter(Stage::settle, o);
    else begin_approach(o, true);  // it weighed less than expected
    return;
  }
  // Nobody is told to drive off, and the machine is not trammed, under a bucket that a stop has left over the bed.
  if (!back_from_bed(o) && begin_leave_bed(o)) return;
  if (poor) {
    part_filled_ = true;
    begin_move_back(o, "the last passes found too little");
    return;
  }
  log_.event("truck_full", {{"time_s", o.time_s}, {"truck", truck_}, {"payload_kg", fill_.loaded_kg()}, {"target_kg", site_.place.target_kg}, {"passes", fill_.passes()},
                            {"seconds", o.time_s - truck_began_s_}});
  enter_phase(BERM_PHASE_WAIT, o);
  enter(Stage::horn, o);
}

bool Sequencer::back_from_bed(const Observation& o) const {
  constexpr double near = radians(15.0);
  return std::fabs(wrapped(o.angle[swing] - task_.next_bearing)) < near;
}

// Raised, to where the pass was to end. False where there is no way.
bool Sequencer::begin_leave_bed(const Observation& o) {
  const auto script = approach_script(scripts_, machine_, {o.angle, task_.next_bearing, site_.bed->wall_top, std::nullopt, brings_load_});
  if (!script) return false;
  begin_script(*script);
  enter(Stage::leave_bed, o);
  return true;
}

Joints Sequencer::leave_bed(const Observation& o) {
  enter_phase(BERM_PHASE_SWING_TO_DIG, o);
  const Joints command = run_script(o, event_none);
  if (script_.at_last() && back_from_bed(o)) go_on_after_pass(o, false);
  return command;
}

}  // namespace berm::app
