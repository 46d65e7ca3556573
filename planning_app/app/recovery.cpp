#include "app/recovery.hpp"

#include <algorithm>
#include <cmath>

#include "app/operator_advice.hpp"
#include "motion/arm_kinematics.hpp"

namespace berm::app {

namespace {

constexpr double patience = 2.5;        // s before a retreat
constexpr double rescan_after = 0.5;    // s
constexpr double rescan_every = 6.0;    // s; the kernel's map forgets, and who stood in the way may have left
constexpr double one_way = 4.0;         // s of creeping in one direction before the next is tried
constexpr double call_after = 30.0;     // s: two rounds of creeping and four of looking have not helped
constexpr double call_after_intruder = 38.0;  // s: of whoever came and left the kernel knows by then that he did
constexpr double again_within = 1.5;    // s of motion; a stop after less is the same trouble
constexpr double same_place = 1.0;      // m; a stop at the same place
constexpr double same_within = 30.0;    // s after the last is the same trouble too
constexpr double back_after = 9.0, back_every = 20.0;  // s of trouble
constexpr double back_by = radians(20.0), back_speed = radians(8.0), back_longest = 6.0;  // the width of a bucket and of a person at 6 m; 1/s; s
constexpr double under_implements = radians(15.0);  // a bucket's half width and a cell at 4 m
constexpr double swing_moves = radians(3.5);          // 1/s: faster than any creeping
constexpr double back_looks = 9.5;      // s: two sweeps, for the kernel's map forgets with the second
constexpr double shortest_pause = 0.5, longest_pause = 4.0;  // s between attempts
constexpr double looks_for = 25.0;      // s of trouble in which what is too high is waited for; then it is tried again, and the operator called
constexpr double map_age = 0.6;         // s: by then what the kernel stopped for is in the app's copy of its map, if it is still there
constexpr double retreat_for = 1.0;     // s
constexpr double retreat_longest = 12.0;  // s, from what was not seen: the boom comes up by half a radian, and both scanners sweep twice
constexpr double wavering = 1.0;        // s in which standing was permitted; less puts a retreat off no longer
constexpr double creep_share = 0.9;
constexpr double farther = radians(5.0);     // than a joint sags or creeps while it should stand
constexpr double range_room = radians(8.0);

// Of what the implements' own motion led to.
bool by_ground(std::uint8_t reason) {
  return (BERM_STOP_HAS_CELL(reason) && reason != BERM_STOP_INTRUDER) || reason == BERM_STOP_JOINT_RANGE;
}

// What another look may end: the same, an intruder, who is waited for wherever the implements are, a direction that was not seen for too long,
// and dust.
bool by_place(std::uint8_t reason) {
  return by_ground(reason) || reason == BERM_STOP_INTRUDER || reason == BERM_STOP_SEPARATION || reason == BERM_STOP_DUST;
}

// By the reset of a stop that latches the ground would have been seen too long ago. Not where the kernel's map is void until then, nor where he is sent to the
// sensors' heads.
bool grows_old(const Observation& o) {
  return o.latched && o.stop_reason != BERM_STOP_BASE_MOVED && o.stop_reason != BERM_STOP_SENSOR_BLOCKED && o.stop_reason != BERM_STOP_SCANNER_SILENT;
}

nlohmann::ordered_json with_place(const Observation& o, nlohmann::ordered_json fields) {
  if (o.has_place()) fields.update({{"x_m", o.blocked_x}, {"y_m", o.blocked_y}, {"height_m", o.blocked_height}});
  return fields;
}

}  // namespace

Joints Recovery::retreat(const Observation& o, double blocked_s) const {
  Joints v{};
  if (o.stop_reason == BERM_STOP_JOINT_RANGE) {
    for (std::size_t j = 0; j < joints; ++j) {
      const JointLimits& limits = machine_.joint[j];
      if (o.angle[j] > limits.high - range_room) v[j] = -creep_share * limits.creep_velocity;
      if (o.angle[j] < limits.low + range_room) v[j] = creep_share * limits.creep_velocity;
    }
    return v;
  }
  // Up first; then away from the blocking cell; then the bucket curled.
  const int way = static_cast<int>(blocked_s / one_way) % 3;
  if (way == 0) v[boom] = creep_share * machine_.joint[boom].creep_velocity;
  if (way == 1) v[swing] = std::copysign(creep_share * machine_.joint[swing].creep_velocity, wrapped(o.angle[swing] - o.blocked_bearing));
  if (way == 2) v[bucket] = -creep_share * machine_.joint[bucket].creep_velocity;
  return short_of_range(v, o);
}

// A retreat that goes on for seconds is not to end in another stop.
Joints Recovery::short_of_range(Joints v, const Observation& o) const {
  for (std::size_t j = 0; j < joints; ++j)
    if ((v[j] > 0.0 && o.angle[j] > machine_.joint[j].high - range_room) || (v[j] < 0.0 && o.angle[j] < machine_.joint[j].low + range_room)) v[j] = 0.0;
  return v;
}

bool Recovery::moved_by_hand(const Observation& o) const {
  for (std::size_t j = 0; j < joints; ++j)
    if (std::fabs(wrapped(o.angle[j] - stopped_at_[j])) > farther) return true;
  return false;
}

// Motion is permitted, and the retreat that led to that is used.
bool Recovery::retreating(const Observation& o) const {
  const bool goes_on = unseen_at_ && in_map_.unseen && retreat_ != Joints{};
  return !handed_back_ && back_ == Back::none && moved_ && o.time_s - running_s_ < (goes_on ? retreat_longest : retreat_for);
}

// What a person must do, each advice once a trouble: what keeps the machine may become another thing meanwhile. What may end by itself is given its time,
// whatever it is: nothing that stays goes untold. True when the call was made just now.
bool Recovery::call_operator(const Observation& o, const ProgressLog& log) {
  // Whoever is seen in dust, and ground that it hides, may be none when it has settled: a map that is learned anew in it is empty.
  const bool in_dust = o.held_by_dust && !o.latched;
  const std::uint8_t reason = in_dust ? static_cast<std::uint8_t>(BERM_STOP_DUST) : o.stop_reason;
  const double after = reason == BERM_STOP_INTRUDER ? call_after_intruder : call_after, from_s = in_dust ? since_s_ : std::max({since_s_, dust_s_, by_ground(reason) ? other_s_ : -1.0});
  if (!(o.latched || (reason != BERM_STOP_NONE && o.time_s - from_s > after))) return false;
  std::string advice = operator_advice(reason);
  if (reason == BERM_STOP_SENSOR_BLOCKED && blocked_eyes_ != 0) advice = eye_names(blocked_eyes_) + ": " + advice;
  if (std::find(told_.begin(), told_.end(), advice) != told_.end()) return false;
  told_.push_back(advice);
  waits_for_reset_ = o.latched;
  nlohmann::ordered_json fields{{"time_s", o.time_s}, {"reason", stop_reason_name(reason)}, {"stopped_s", o.time_s - since_s_}};
  if (!o.latched && !in_dust) fields = with_place(o, std::move(fields));
  fields["advice"] = advice;
  log.event("operator_needed", fields);
  return true;
}

// A stop soon after the last one goes on with the same trouble: its clock runs on, and the next attempt waits longer.
void Recovery::begin_stop(const Observation& o, const ProgressLog& log) {
  const bool here = o.has_place() && std::hypot(o.blocked_x - blocked_x_, o.blocked_y - blocked_y_) < same_place;
  const bool again = since_s_ >= 0.0 && (!handed_back_ || o.time_s - handed_back_s_ < (here ? same_within : again_within));
  const bool in_retreat = retreating(o), moved_in_it = in_retreat && retreat_ != Joints{};
  const bool wavers = !handed_back_ && !moved_in_it && o.time_s - running_s_ < wavering;
  stopped_ = true;
  if (!wavers) stop_s_ = o.time_s;
  stopped_at_ = o.angle;
  if (in_retreat) retreat_ = o.stop_reason == BERM_STOP_JOINT_RANGE ? retreat(o, 0.0) : Joints{};  // it led nowhere: not the same again
  pause_s_ = again ? std::clamp(2.0 * pause_s_, shortest_pause, longest_pause) : 0.0;
  if (!again) {
    since_s_ = o.time_s;
    next_rescan_s_ = since_s_ + rescan_after;
    next_back_s_ = since_s_ + back_after;
    dust_s_ = other_s_ = -1.0;
    told_.clear();
    blocked_eyes_ = 0;
    waits_for_reset_ = false;
    moved_ = false;
    over_high_ = false;
    unseen_at_.reset();
    back_way_ = 0.0;
  }
  back_ = Back::none;
  handed_back_ = false;
  if (o.kernel_state == BERM_STATE_STOPPING || o.kernel_state == BERM_STATE_STOPPED || o.kernel_state == BERM_STATE_FAULT)
    log.event("stopped", with_place(o, {{"time_s", o.time_s}, {"reason", stop_reason_name(o.stop_reason)}}));
}

// By the newest reason: dust or a person may have stopped it, and then the ground keeps it.
void Recovery::kept_by_ground(const Observation& o) {
  const bool unseen = o.stop_reason == BERM_STOP_STALE_GROUND || o.stop_reason == BERM_STOP_UNKNOWN_GROUND;
  if (unseen && !o.has_place() && !unseen_at_) {  // while the machine stands the kernel may name none: what the bucket hides
    const Point tip = in_base(forward(machine_, o.angle).tip, o.angle[swing]);
    unseen_at_ = Place{tip.x, tip.y};
  }
  if (!o.has_place()) return;
  blocked_x_ = o.blocked_x;
  blocked_y_ = o.blocked_y;
  over_high_ = o.stop_reason == BERM_STOP_OVERPASS;
  unseen_at_ = unseen ? std::optional(Place{blocked_x_, blocked_y_}) : std::nullopt;
  back_way_ = way_back(o);
}

// Of what lies under the implements the bearing says nothing: the way they came was clear, and the other may lead over a cab.
double Recovery::way_back(const Observation& o) const {
  const double off = wrapped(o.angle[swing] - o.blocked_bearing);
  return came_ != 0.0 && std::fabs(off) < under_implements ? -came_ : std::copysign(1.0, off);
}

// Away from what blocked, then a look from there. True while it goes on.
bool Recovery::swing_back(const Observation& o, Advice& advice) {
  if (back_ == Back::none) {
    if (back_way_ == 0.0 || o.time_s < next_back_s_) return false;
    back_ = Back::swings;
    back_from_ = o.angle[swing];
    back_began_s_ = o.time_s;
    next_back_s_ = o.time_s + back_every;
    moved_ = true;
  }
  if (back_ == Back::swings) {
    advice.velocity = {};
    if (std::fabs(o.angle[swing] - back_from_) < back_by && o.time_s - back_began_s_ < back_longest) {
      advice.velocity[swing] = back_way_ * back_speed;
      return true;
    }
    back_ = Back::looks;
    back_began_s_ = o.time_s;
    advice.rescan = true;
  }
  return o.time_s - back_began_s_ < back_looks;
}

// The kernel permits motion: the retreat that it permits is used for a moment, then what is due of the pause is waited for.
Recovery::Advice Recovery::running(const Observation& o, const ProgressLog& log) {
  Advice advice;
  if (stopped_) {
    stopped_ = false;
    running_s_ = o.time_s;
    if (!moved_ && moved_by_hand(o)) {
      moved_ = true;
      retreat_ = {};
    }
  }
  if (handed_back_) {
    if (std::fabs(o.velocity[swing]) > swing_moves) came_ = std::copysign(1.0, o.velocity[swing]);
    return advice;
  }
  advice.in_charge = true;
  const double ran = o.time_s - running_s_;
  if (retreating(o)) {
    advice.velocity = short_of_range(retreat_, o);
    if (unseen_at_) look_again(o, advice);
  } else if (unseen_at_ && !in_map_.unseen && moved_) {
    hand_back(o, log, advice);
  } else if (ran < (over_high_ ? std::max(pause_s_, map_age) : pause_s_) || swing_back(o, advice)) {
    return advice;
  } else if (over_high_ && in_map_.too_high && o.time_s - since_s_ < looks_for) {
    look_again(o, advice);
  } else {
    hand_back(o, log, advice);
  }
  return advice;
}

void Recovery::hand_back(const Observation& o, const ProgressLog& log, Advice& advice) {
  log.event("resumed", {{"time_s", o.time_s}, {"stopped_s", o.time_s - since_s_}});
  handed_back_ = true;
  handed_back_s_ = o.time_s;
  advice = {false, {}, false, true, moved_, false};
  moved_ = false;
  back_ = Back::none;
}

void Recovery::look_again(const Observation& o, Advice& advice) {
  if (o.time_s <= next_rescan_s_) return;
  advice.rescan = true;
  next_rescan_s_ = o.time_s + rescan_every;
}

Recovery::Advice Recovery::step(const Observation& o, const ProgressLog& log, const PlaceInMap& in_map) {
  in_map_ = in_map;
  if (o.running()) return running(o, log);
  Advice advice;
  advice.in_charge = true;
  if (!stopped_) begin_stop(o, log);
  if (o.kernel_state == BERM_STATE_STOPPING) stopped_at_ = o.angle;
  if (by_ground(o.stop_reason)) kept_by_ground(o);
  if (waits_for_reset_ && !o.latched) {  // he has reset, and what keeps the machine now is another trouble
    told_.clear();
    blocked_eyes_ = 0;
    waits_for_reset_ = false;
    since_s_ = o.time_s;
  }
  blocked_eyes_ |= o.blocked_eyes;
  if (o.held_by_dust) dust_s_ = o.time_s;
  if (!by_ground(o.stop_reason)) other_s_ = o.time_s;
  if (o.held_by_dust || !by_ground(o.stop_reason)) next_back_s_ = std::max(next_back_s_, o.time_s + back_after);
  advice.operator_called = call_operator(o, log);
  if (grows_old(o)) look_again(o, advice);
  if (!by_place(o.stop_reason)) return advice;
  const double blocked = o.time_s - stop_s_;  // with no more than moments in which standing was permitted
  look_again(o, advice);
  if (blocked > patience && by_ground(o.stop_reason)) {
    advice.velocity = retreat_ = retreat(o, o.time_s - std::max(other_s_, stop_s_ + patience));
    moved_ = true;
  }
  return advice;
}

}  // namespace berm::app
