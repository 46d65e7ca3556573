// The sequencer where the plan goes no farther: a script that stands, a dig or a truck that is out of reach. None of them is a dead end without a word.
#include "app/sequencer.hpp"

namespace berm::app {

namespace {

constexpr int most_tries = 3;  // to begin anew; then the operator is told

}  // namespace

// Whether the plan is to move the machine now, and waits for nobody.
bool Sequencer::works() const { return stage_ == Stage::go_look || stage_ == Stage::pass || stage_ == Stage::leave_bed || stage_ == Stage::curl || digs_or_comes_to_dig(); }

// What the stage waits for that is no motion. In INIT, and in a fault, a scanner may well be silent: of that others tell.
Awaited Sequencer::awaited_of_look(const Observation& o) const {
  if (o.kernel_state == BERM_STATE_INIT || o.latched) return Awaited::nothing;
  if (stage_ == Stage::look) return look_.awaits(o, scanners_);
  if (stage_ != Stage::survey) return Awaited::nothing;
  const bool left = scanners_.swept(0), right = scanners_.swept(1);
  return left && right ? Awaited::nothing : left ? Awaited::right_pan : right ? Awaited::left_pan : Awaited::both_pans;
}

// A survey asks both pans for their whole range all the time: there is nothing to begin anew.
void Sequencer::watch_look(const Observation& o) {
  if (look_watch_.step(o, awaited_of_look(o), log_) && stage_ == Stage::look) look_.begin(o, scanners_);
}

bool Sequencer::digs_or_comes_to_dig() const { return stage_ == Stage::dig || stage_ == Stage::settle || stage_ == Stage::approach; }

// Whether a swing is on its way that ends over the dig, or has ended there.
bool Sequencer::comes_down() const { return stage_ == Stage::pass || stage_ == Stage::leave_bed || stage_ == Stage::approach || stage_ == Stage::settle; }

// Whether what was in the bucket, or a part of it, is in the truck and not booked yet.
bool Sequencer::has_poured() const { return stage_ == Stage::pass && pours_; }

// The work is begun anew from where the implements are: high and folded, back to the dig. What helped once may help again, but somebody has to know.
void Sequencer::go_on_from_a_stand(const Observation& o) {
  nlohmann::ordered_json fields{{"time_s", o.time_s}, {"phase", phase_name(phase_)}, {"stood_s", StandingWatch::patience}, {"pass", pass_ + 1}};
  const bool scripted = stage_ == Stage::go_look || stage_ == Stage::approach || stage_ == Stage::pass || stage_ == Stage::leave_bed;
  for (const Joint j : {swing, boom, stick, bucket}) {
    const JointScript& script = script_.of(j);
    if (scripted && script.running() && !script.at_last()) fields["waits"][joint_names[j]] = script.rules()[static_cast<std::size_t>(script.active()) + 1].name;
  }
  log_.event("stands", fields);
  if (++stands_ == most_tries)
    log_.event("operator_needed", {{"time_s", o.time_s}, {"reason", "work stands"}, {"stopped_s", most_tries * StandingWatch::patience},
                                   {"advice", "the app has begun the work anew and stands again: lift the implements by hand; if it stands after that, end the app, check its scripts and start it anew"}});
  if (stage_ == Stage::go_look || looks_on_the_way()) {
    begin_look(o);
    return;
  }
  begin_dig_from_here(o);
}

// High and folded to the next dig, wherever the implements are.
void Sequencer::begin_dig_from_here(const Observation& o) {
  const bool poured = has_poured() || stage_ == Stage::leave_bed;
  take_load_back(o);
  if (poured) go_on_after_pass(o, false);
  else begin_approach(o, true);
}

// A pass on its way to the truck goes on where it is. One on its way back may be lowering already: where the stop's mending has carried it there is
// no dig.
bool Sequencer::begins_anew_where_moved() const {
  return digs_or_comes_to_dig() || stage_ == Stage::leave_bed || (stage_ == Stage::pass && script_.of(swing).reached(RuleMark::returns));
}

void Sequencer::go_on_with_script(const Observation& o) {
  script_.interrupted();
  if (stage_ != Stage::pass || emptied_) return;
  reach_again_.resumed(script_, o.angle);
  if (!reach_again_.active()) return;
  open_since_s_ = -1.0;
  log_.event("reaches_again", {{"time_s", o.time_s}, {"aside_deg", degrees(o.angle[swing] - script_.goals()[swing])}});
}

// Where it had begun to pour, that counts as poured.
void Sequencer::take_load_back(const Observation& o) {
  if (has_poured()) book_pass(o);
  keep_load();
}

// What is in the bucket goes back to the face.
void Sequencer::keep_load() {
  brings_load_ = brings_load_ || (!holds_nothing_ && (stage_ == Stage::dig || stage_ == Stage::curl || stage_ == Stage::pass));
  search_.reset();
}

// Either the implements cannot be raised over this truck, or the soil is out of reach.
void Sequencer::miss_approach(const Observation& o) {
  if (!approach_script(scripts_, machine_, {o.angle, dig_.bearing, site_.bed->wall_top, std::nullopt, brings_load_})) {
    log_.event("unreachable", {{"time_s", o.time_s}, {"what", "height of the truck"}, {"height_m", site_.bed->wall_top}});
    refuse_truck(o);
    return;
  }
  log_.event("unreachable", {{"time_s", o.time_s}, {"what", "start of the dig"}});
  part_filled_ = true;
  begin_move_back(o, "the start of the next dig is out of the bucket's reach");
}

// Once or twice another way to the dig may do; then the machine stands wrong.
void Sequencer::miss_dig(const Observation& o) {
  log_.event("unreachable", {{"time_s", o.time_s}, {"what", "drag"}, {"bearing_deg", degrees(dig_.bearing)}});
  if (++missed_digs_ < most_tries) {
    begin_approach(o, true);
    return;
  }
  part_filled_ = true;
  begin_move_back(o, "the soil before the machine is out of the bucket's reach");
}

// The truck is where no dump can be made. It is looked at again: that it parks anew nobody has to say.
void Sequencer::refuse_truck(const Observation& o) {
  if (refused_truck_ != truck_)
    log_.event("operator_needed", {{"time_s", o.time_s}, {"reason", "truck out of reach"}, {"x_m", site_.bed->centre_x}, {"y_m", site_.bed->centre_y}, {"height_m", site_.bed->wall_top},
                                   {"stopped_s", 0.0}, {"advice", "the bucket cannot be brought over the truck's bed: have it park anew, where trucks park"}});
  refused_truck_ = truck_;
  log_.event("truck_lost", {{"time_s", o.time_s}, {"truck", truck_}, {"why", "out of reach"}, {"loaded_kg", fill_.loaded_kg()}, {"target_kg", site_.place.target_kg}});
  enter_phase(BERM_PHASE_WAIT, o);
  keep_load();  // what was poured before the way to the next dig was sought is booked
  part_filled_ = true;
  forget_bed();
  wait_raised(o);
}

}  // namespace berm::app
