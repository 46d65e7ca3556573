// The sequencer and the trucks: waiting for one, looking where it stands and how large it is, and what follows when it leaves, full or not.
#include <algorithm>
#include <cmath>

#include "app/sequencer.hpp"

namespace berm::app {

namespace {

constexpr double horn_s = 1.0, horn_again_s = 30.0;
constexpr double full_leaves_within_s = 90.0, next_comes_within_s = 300.0;  // then the operator is told

}  // namespace

std::optional<Script> Sequencer::raised(const Observation& o, double bearing) const {
  return approach_script(scripts_, machine_, {o.angle, bearing, over_heaps, std::nullopt, brings_load_});
}

// Raised, to where the scanner on the truck's side sees the whole place, for a look in a stop.
void Sequencer::begin_look(const Observation& o) {
  look_.stop(scanners_);
  const auto script = raised(o, look_.bearing());
  if (!script) {
    log_.event("unreachable", {{"time_s", o.time_s}, {"what", "where the truck is looked for"}});
    log_.event("operator_needed", {{"time_s", o.time_s}, {"reason", "machine file"}, {"stopped_s", 0.0},
                                   {"advice", "the implements cannot be raised as the app needs it: check the machine file, and start the app anew"}});
    enter(Stage::exhausted, o);
    return;
  }
  begin_script(*script);
  enter(Stage::go_look, o);
}

// Between two trucks: a bucket that stays low hides the ground round it until that is too old to move over.
void Sequencer::raise_to_wait(const Observation& o, double bearing) {
  const auto script = raised(o, bearing);
  waits_raised_ = script.has_value();
  if (script) begin_script(*script);
}

void Sequencer::wait_raised(const Observation& o) {
  raise_to_wait(o, bearing_on_the_way(o).value_or(o.angle[swing]));
  enter(Stage::wait_truck, o);
}

// After a bench move the next truck is waited for as after a full one.
void Sequencer::end_survey(const Observation& o) {
  if (after_survey_ == Stage::wait_truck && !o.truck_parked && truck_ > 1) wait_raised(o);
  else enter(after_survey_, o);
}

// Over a dig zone, high: from where the next truck will be seen, and none passes there.
std::optional<double> Sequencer::bearing_on_the_way(const Observation& o) const {
  const auto pose = raised_pose(machine_, over_heaps, brings_load_);
  return pose ? look_.bearing_on_the_way(o.angle[swing], reach_of(machine_, *pose)) : std::nullopt;
}

Joints Sequencer::go_look(const Observation& o) {
  enter_phase(BERM_PHASE_WAIT, o);
  const Joints command = run_script(o, event_none);
  if (look_.on_the_way()) {
    if (const auto bed = look_.step(o, scanners_, truck_, log_)) begin_truck(o, *bed);
    else if (look_.missed() || (look_.way_is_free(o, scanners_) && !approach_dig(o, over_heaps, true))) begin_look(o);
  } else if (script_.at_last() && swing_stands_at_goal(o)) {
    look_.begin(o, scanners_);
    enter(Stage::look, o);
  }
  return command;
}

Joints Sequencer::look_for_truck(const Observation& o) {
  if (const auto bed = look_.step(o, scanners_, truck_, log_)) begin_truck(o, *bed);
  return {};
}

// Not the first truck after a start, for nothing was learned yet of how the machine answers; nor one whose books go on, for what is in its bed has to be seen
// before a dig's goal can be told.
bool Sequencer::go_look_on_the_way(const Observation& o) {
  if (truck_ == 1 || part_filled_ || brings_load_) return false;
  const auto bearing = bearing_on_the_way(o);
  const auto script = bearing ? raised(o, *bearing) : std::nullopt;
  if (!script) return false;
  begin_books(o);
  goal_kg_ = fill_.next_goal_kg();
  plan_next_dig(o, 0.0);
  look_.begin_on_the_way(o, scanners_, *bearing, dig_.bearing);
  begin_script(*script);
  enter(Stage::go_look, o);
  return true;
}

bool Sequencer::looks_on_the_way() const { return look_.on_the_way() && (stage_ == Stage::approach || stage_ == Stage::settle); }

void Sequencer::look_on_the_way(const Observation& o) {
  if (const auto bed = look_.step(o, scanners_, truck_, log_)) take_bed(o, *bed);
  else if (look_.missed()) begin_look(o);
}

void Sequencer::begin_books(const Observation& o) {
  fill_ = TruckFill(site_.place.target_kg, full_bucket_kg());
  dumps_.clear();
  pass_ = 0;
  truck_began_s_ = pass_began_s_ = o.time_s;
}

void Sequencer::take_bed(const Observation& o, const TruckBed& bed) {
  site_.bed = bed;
  bed_slipped_ = false;
  bed_.emplace(bed, scale_);
  const std::vector<ScanPoint>& seen = look_.sweep().points();
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const ScanPoint& p = seen[i];
    if (!look_.sweep().flagged(i)) bed_->insert(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z), p.time_s);
  }
  skyline_.reset();
  ahead_.reset();
  look(o);
  stands_ = 0;
}

void Sequencer::begin_truck(const Observation& o, const TruckBed& bed) {
  take_bed(o, bed);
  const bool goes_on = part_filled_;
  if (goes_on) {
    for (const Dump& dump : dumps_) bed_->note_dump(dump.at, dump.kg);
  } else {
    begin_books(o);
  }
  part_filled_ = false;
  pass_began_s_ = o.time_s;
  if (goes_on && fill_.full()) go_on_after_pass(o, false);  // by the pass with which it was left
  else begin_approach(o, true);
}

// Again while the full truck stands there: a driver may not have heard it, or could not leave then.
bool Sequencer::sounds_full(const Observation& o) const {
  const double since_s = o.time_s - stage_s_;
  if (stage_ == Stage::horn) return since_s < horn_s;
  return stage_ == Stage::wait_leave && since_s >= horn_again_s && std::fmod(since_s, horn_again_s) < horn_s;
}

void Sequencer::finish(const Observation& o) {
  log_.event("finished", {{"time_s", o.time_s}, {"trucks", trucks_}});
  enter(Stage::finished, o);
}

void Sequencer::forget_bed() {
  site_.bed.reset();
  bed_.reset();
  bed_slipped_ = false;
}

void Sequencer::expect_another_truck() {
  look_.another_truck();
  refused_truck_ = 0;
}

void Sequencer::next_truck(const Observation& o) {
  forget_bed();
  part_filled_ = false;
  ++truck_;
  if (face_too_poor_for_a_truck()) begin_move_back(o, "what is left within reach does not fill the next truck");
  else wait_raised(o);
}

// What is in the bucket goes back to the face. A truck that is no longer admitted but was not seen to leave is looked at again, and its books go on.
void Sequencer::leave_truck(const Observation& o) {
  const bool left = presence_.gone() == TruckPresence::Gone::left;
  if (looks_on_the_way()) look_.stop(scanners_);
  take_load_back(o);
  log_.event("truck_lost", {{"time_s", o.time_s}, {"truck", truck_}, {"why", left ? "left" : "no longer admitted"}, {"loaded_kg", fill_.loaded_kg()}, {"target_kg", site_.place.target_kg}});
  enter_phase(BERM_PHASE_WAIT, o);
  if (left && truck_ == trucks_) {
    finish(o);
  } else if (left) {
    next_truck(o);
  } else {
    part_filled_ = true;
    forget_bed();
    wait_raised(o);
  }
}

void Sequencer::follow_truck(const Observation& o) {
  presence_.step(o);
  call_for_truck(o);
  const bool gone = presence_.gone() != TruckPresence::Gone::no, left = presence_.gone() == TruckPresence::Gone::left;
  switch (stage_) {
    case Stage::go_look:
    case Stage::look:
      if (!gone && o.truck_parked) return;  // nothing is known of it yet: any silence ends the look
      look_.stop(scanners_);
      if (left && part_filled_) leave_truck(o);
      else enter(Stage::wait_truck, o);
      return;
    case Stage::wait_truck:  // one that is admitted no longer, and now said to have left
      if (left && part_filled_) leave_truck(o);
      return;
    case Stage::approach:
    case Stage::settle:
    case Stage::dig:
    case Stage::curl:
    case Stage::pass:
    case Stage::leave_bed:
      if (gone) leave_truck(o);
      return;
    case Stage::horn:
      if (o.time_s - stage_s_ < horn_s) return;
      if (truck_ == trucks_) finish(o);
      else enter(Stage::wait_leave, o);
      return;
    case Stage::wait_leave:
      if (gone) next_truck(o);
      return;
    case Stage::survey:
    case Stage::raise_for_move:
    case Stage::ask_move:
    case Stage::being_moved:
    case Stage::exhausted:
    case Stage::finished: return;
  }
}

void Sequencer::call_for_truck(const Observation& o) {
  const double since_s = o.time_s - stage_s_;
  const bool stays = stage_ == Stage::wait_leave && since_s > full_leaves_within_s, none = stage_ == Stage::wait_truck && since_s > next_comes_within_s;
  if (called_for_truck_ || !(stays || none)) return;
  called_for_truck_ = true;
  log_.event("operator_needed", {{"time_s", o.time_s}, {"reason", stays ? "truck stays" : "no truck comes"}, {"stopped_s", since_s},
                                 {"advice", stays ? "the truck is full: send it off, and have the spotter say that it leaves"
                                                  : "have a truck come, and the spotter say that it stands there"}});
}

}  // namespace berm::app
