#include "app/sequencer.hpp"

#include <algorithm>
#include <cmath>

#include "app/motion_guard.hpp"
#include "motion/script_tempo.hpp"

namespace berm::app {

namespace {

constexpr double script_period = 0.02;            // s; the paper has 0.1 (4.4), and each rule that waits for a crossing then comes half of that late
constexpr double skyline_period = 0.5;
constexpr double most_brake_share = 0.9;          // of the largest acceleration of the swing: no landing is planned harder
constexpr double slow_for_long = 3.0;                // s

}  // namespace

const char* Sequencer::phase_name(std::uint16_t phase) {
  static constexpr const char* names[BERM_PHASE_COUNT] = {"idle", "dig", "lift", "swing to truck", "dump", "swing to dig", "wait"};
  return names[phase];
}

Sequencer::Sequencer(const MachineModel& machine, const SiteModel& site, int trucks, const ScriptSet& scripts, TruckFinder& finder, const ProgressLog& log)
    : scripts_(scripts), machine_(machine), scale_(scale_of(machine)), stall_(scale_.load), heaped_(machine.bucket_payload_kg), site_(site), dig_floor_(machine_, site_), log_(log), trucks_(trucks), ground_(site_), arm_(machine_), brakes_(most_brake_share * machine.joint[swing].acceleration_max), joint_watch_(machine_), scanners_(machine_), look_(machine_, site_, finder), recovery_(machine_), look_ahead_(machine_, scripts_),
      load_check_(scale_.load), reach_again_(machine_), fill_(site.place.target_kg, full_bucket_kg()), pour_(machine.bucket_payload_kg) {
  scanners_.begin_full_sweep();
}

void Sequencer::enter(Stage stage, const Observation& o) {
  called_for_truck_ = false;
  if (look_ahead_.slows()) tell_change(o, {});
  look_ahead_.begin();
  stage_ = stage;
  stage_s_ = o.time_s;
}

void Sequencer::enter_phase(std::uint16_t phase, const Observation& o) {
  if (phase == phase_) return;
  phase_ = phase;
  log_.event("phase", {{"time_s", o.time_s}, {"phase", phase_name(phase)}, {"truck", truck_}, {"pass", pass_ + 1}});
}

void Sequencer::look(const Observation& o) {
  if (skyline_ && o.time_s - skyline_s_ < skyline_period) return;
  site_.truck_admitted = bed_slipped_ && o.truck_parked;
  skyline_.emplace(machine_, site_, kernel_map_.ground(KernelMap::Unseen::blocked), Skyline::OverHigh::refused);
  skyline_s_ = o.time_s;
}

void Sequencer::begin_script(const Script& script) {
  if (const std::string wrong = goal_out_of_range(machine_, script); !wrong.empty()) log_.event("script_goal", {{"goal", wrong}});
  script_ = script;
  script_.start();
  reach_again_.end();
  ahead_pass_.reset();
  script_s_ = -1.0;
}

void Sequencer::begin_approach(const Observation& o, bool lower) {
  goal_kg_ = next_goal_kg(o, middle_of_digs(site_));
  plan_next_dig(o, 0.0);
  if (!approach_dig(o, site_.bed->wall_top, lower)) miss_approach(o);
}

// To the dig that was planned, over what is so high. False where there is no way.
bool Sequencer::approach_dig(const Observation& o, double top, bool lower) {
  std::optional<PlanePoint> entry;
  if (lower) entry = PlanePoint{dig_.drag.front().r, dig_.drag.front().z};
  const auto script = approach_script(scripts_, machine_, {o.angle, dig_.bearing, top, entry, brings_load_});
  if (!script) return false;
  begin_script(*script);
  task_.next_bearing = dig_.bearing;
  enter(Stage::approach, o);
  return true;
}

void Sequencer::hear(const Observation& o) {
  constexpr std::uint64_t most = 100;  // cycles: beyond any dead time
  const int cycles = static_cast<int>(std::min(o.cycle > heard_cycle_ ? o.cycle - heard_cycle_ : 1, most));
  heard_cycle_ = o.cycle;
  arm_.heard(o.commanded, o.permitted_low, o.permitted_high, cycles);
  slow_down_.step(o, arm_, machine_.cycle, phase_name(phase_), log_);
  watch_joints(o);
}

// What was dug may be more than the weighing has seen yet.
double Sequencer::carried_kg() const { return holds_nothing_ ? 0.0 : std::max(recent_.kg(), goal_kg_); }

void Sequencer::watch_joints(const Observation& o) {
  const bool digs = stage_ == Stage::dig || stage_ == Stage::curl;
  joint_watch_.step(o, {carried_kg(), !holds_nothing_, !digs, comes_down() && script_.running() ? std::optional(script_.goals()) : std::nullopt}, log_);
  arm_.carries(carried_kg());
  arm_.limit(joint_watch_.paces(!holds_nothing_));
}

// By what the kernel lets out and what look-ahead has slowed.
Joints Sequencer::tempos() const {
  if (reach_again_.active()) return {1.0, 1.0, 1.0, 1.0};
  Joints shares = arm_.shares();
  shares[swing] *= look_ahead_.shares().swing;
  return tempos_of(script_, shares);
}

void Sequencer::plan_landing(const Observation& o) {
  // Full it lands near the truck, whose cab the kernel wants room to: there a harder landing would be stopped.
  if (look_ahead_.slows()) brakes_.forget();
  else if (o.running() && holds_nothing_ && comes_down()) brakes_.step(o.time_s, o.velocity[swing], arm_.swing_deceleration());
  arm_.brake_swing(holds_nothing_ ? brakes_.known() : 0.0);
}

Joints Sequencer::run_script(const Observation& o, std::uint32_t events) {
  if (o.time_s - script_s_ >= script_period - 1e-6) {
    script_.evaluate(o.angle, events);
    script_s_ = o.time_s;
  }
  foresee(o, events);
  return arm_.toward(stage_ == Stage::pass ? pass_goals(o) : script_.goals(), look_ahead_.shares().of(script_.paces()), tempos(), o.angle, o.velocity);
}

// A load that is poured in part: meanwhile the arm keeps its lip over the bed's middle, and on the way back the bucket holds the rest level.
Joints Sequencer::pass_goals(const Observation& o) {
  Joints goals = script_.goals();
  if (reach_again_.active()) return reach_again_.goals(goals, poses_.carry, o.angle, swing_stands_at_goal(o));
  if (load_check_.pours_part() && script_.of(bucket).reached(RuleMark::opens)) {
    const Joints pose = part_pose(machine_, task_, poses_, forward(machine_, o.angle).bucket_attitude);
    for (const Joint j : {boom, stick}) goals[j] = pose[j];
  }
  if (load_check_.keeps_rest() && !script_.of(swing).at_last()) goals[bucket] = level_bucket(machine_, goals[boom] + goals[stick]);
  return goals;
}

bool Sequencer::swing_stands_at_goal(const Observation& o) const {
  constexpr double arrived = radians(1.5), still = radians(0.8);  // rad/s
  return std::fabs(script_.goals()[swing] - o.angle[swing]) < arrived && std::fabs(o.velocity[swing]) < still;
}

Joints Sequencer::approach(const Observation& o) {
  enter_phase(BERM_PHASE_SWING_TO_DIG, o);
  const Joints command = run_script(o, event_none);
  const Joints goals = script_.goals();
  const bool near = std::equal(goals.begin(), goals.end(), o.angle.begin(), [](double g, double a) { return std::fabs(g - a) < radians(4.0); });
  if (script_.at_last() && near) enter(Stage::settle, o);
  return command;
}

Joints Sequencer::settle(const Observation& o) {
  const Joints goals = script_.goals();
  if (swing_stands_at_goal(o) && site_.bed) begin_dig(o);
  return arm_.toward(goals, script_.paces(), tempos(), o.angle, o.velocity);
}

Joints Sequencer::plan(const Observation& o) {
  switch (stage_) {
    case Stage::survey:
      if (scanners_.full_sweep_done()) end_survey(o);
      return {};
    case Stage::wait_truck:
      if (o.truck_parked) {
        log_.event("truck", {{"truck", truck_}, {"time_s", o.time_s}});
        if (presence_.gone() != TruckPresence::Gone::no) expect_another_truck();
        presence_.begin();
        waits_raised_ = false;
        if (!go_look_on_the_way(o)) begin_look(o);
        return {};
      }
      return waits_raised_ ? run_script(o, event_none) : Joints{};
    case Stage::go_look: return go_look(o);
    case Stage::look: return look_for_truck(o);
    case Stage::approach:
    case Stage::settle:
      if (looks_on_the_way()) look_on_the_way(o);
      return stage_ == Stage::approach ? approach(o) : stage_ == Stage::settle ? settle(o) : Joints{};
    case Stage::dig: return dig(o);
    case Stage::curl: return curl(o);
    case Stage::pass: return pass(o);
    case Stage::leave_bed: return leave_bed(o);
    case Stage::horn:
    case Stage::wait_leave: return {};  // follow_truck
    case Stage::raise_for_move: return raise_for_move(o);
    case Stage::ask_move:
    case Stage::being_moved:  // await_move
    case Stage::exhausted:
    case Stage::finished: return {};
  }
  return {};
}

void Sequencer::log_held(const Observation& o, const Joints& wanted) const {
  const auto blocking = skyline_->blocking(preview(machine_, o.angle, wanted));
  if (!blocking) return;
  const bool placed = blocking->of_ground(), unseen = blocking->unseen();
  nlohmann::ordered_json fields{{"time_s", o.time_s}, {"by", blocking->name()}};
  if (placed) fields.update({{"bearing_deg", degrees(blocking->bearing)}, {"distance_m", blocking->distance}});
  if (placed && !unseen) fields["height_m"] = blocking->height;
  log_.event("held", fields);
}

// Through the guard. What the guard holds back for long is looked at again; if that does not help the kernel decides, at creep speed.
Joints Sequencer::slowed(const Observation& o, const Joints& wanted) {
  constexpr double look_after = 1.0;
  // A bucket comes down into a dig until it is slowed before the zone's floor, and goes on meanwhile as it came.
  const Joints then = stage_ == Stage::dig ? arm_.taken_up(o.angle, o.velocity) : arm_.predicted(o.angle, o.velocity);
  const Joints allowed = guarded(machine_, *skyline_, then, wanted);
  if (allowed != wanted) guard_account_.slowed(skyline_->blocking(preview(machine_, then, wanted)), machine_.cycle);
  const double held_before = hold_.seconds();
  const bool by_script = stage_ != Stage::dig && stage_ != Stage::curl;
  hold_.step(o.time_s, o.angle, cut_short(o.angle, wanted, allowed, by_script ? std::optional(script_.goals()) : std::nullopt));
  if (looked_ && hold_.seconds() < held_before) {
    log_.event("released", {{"time_s", o.time_s}, {"held_s", held_before}});
    looked_ = false;
  } else if (hold_.seconds() > look_after && !looked_) {
    log_held(o, wanted);
    scanners_.begin_full_sweep();
    looked_ = true;
  }
  return hold_.given_up() ? crept(machine_, wanted) : allowed;
}

// Not of the truck: that stays, and the plan goes round it.
bool Sequencer::too_high_stands() const {
  const auto at = recovery_.too_high();
  return at && !at_truck(site_, at->x, at->y) && kernel_map_.ground(KernelMap::Unseen::level)(at->x, at->y) > pass_over_limit(site_, at->x, at->y);
}

// With what is round it: the kernel names one cell of what the implements hide.
bool Sequencer::unseen_lies_there() const {
  constexpr double around = 1.6, step = 0.2;  // m: a bucket and a half; less than a cell
  const auto at = recovery_.unseen();
  if (!at) return false;
  const CellGround ground = kernel_map_.ground(KernelMap::Unseen::blocked);
  for (double x = -around; x <= around; x += step)
    for (double y = -around; y <= around; y += step)
      if (!std::isfinite(ground(at->x + x, at->y + y))) return true;
  return false;
}

// While the operator trams the machine its stops are his, also where he left run on for it; when he has switched run on again they are as any other, but nothing is to move yet.
Recovery::Advice Sequencer::recover(const Observation& o) {
  const bool moved = stage_ == Stage::being_moved;
  if (moved && !(run_was_off_ && o.run_switch)) return {};
  Recovery::Advice advice = recovery_.step(o, log_, {too_high_stands(), unseen_lies_there()});
  if (moved) advice.velocity = {};
  return advice;
}

Answer Sequencer::step(const Observation& o) {
  recent_.add(o.payload_kg);
  look(o);
  hear(o);
  feel(o);
  plan_landing(o);
  follow_truck(o);
  Answer answer;
  const bool slipped = base_.step(o, kernel_map_.is_void());
  if (stage_ == Stage::ask_move || stage_ == Stage::being_moved) await_move(o);
  else if (slipped) note_slip(o);
  const Recovery::Advice advice = recover(o);
  restart_call_.step(o, log_);
  start_call_.step(o, log_);
  if (advice.rescan && stage_ != Stage::survey) scanners_.begin_full_sweep();  // a survey is one, and would have no end
  if (advice.resumed && slipped_) begin_anew_after_slip(o);
  else if (advice.resumed) go_on_with_script(o);
  if (advice.resumed && advice.moved && begins_anew_where_moved()) begin_dig_from_here(o);
  if (advice.resumed && (stage_ == Stage::go_look || stage_ == Stage::look)) begin_look(o);
  if (standing_.step(o, works() && o.running() && !advice.in_charge)) go_on_from_a_stand(o);
  if (advice.in_charge) {
    look_ahead_.rest();
    answer.velocity = advice.velocity;
    if (looks_on_the_way()) begin_look(o);
    else if (stage_ == Stage::look || stage_ == Stage::go_look) look_.stop(scanners_);
    if (stage_ == Stage::survey && scanners_.full_sweep_done()) end_survey(o);
  } else {
    const Joints wanted = plan(o);
    const bool moves = std::any_of(wanted.begin(), wanted.end(), [](double v) { return v != 0.0; });
    answer.velocity = moves ? slowed(o, wanted) : wanted;
  }
  watch_look(o);
  if (o.running())
    for (std::size_t j = 0; j < joints; ++j) answer.velocity[j] = std::clamp(answer.velocity[j], o.permitted_low[j], o.permitted_high[j]);
  arm_.asked(answer.velocity);
  const double truck_bearing = site_.bed ? std::atan2(site_.bed->centre_y, site_.bed->centre_x) : std::atan2(site_.place.y, site_.place.x);
  // A motion that is let out slowly for long: ground grows old on which the looks of its phase do not fall.
  const bool slowed_long = std::max(slow_down_.lasts_s(), look_ahead_.slows_for_s(o.time_s)) > slow_for_long;
  answer.pan = scanners_.step(stage_ == Stage::curl ? std::uint16_t{BERM_PHASE_LIFT} : phase_, task_.next_bearing, truck_bearing, o.angle[swing], o.velocity[swing], o.pan, slowed_long,
                              coming_swing(o));
  if (stage_ == Stage::pass && o.running() && swings()) scan_wait_.goes_on(scanners_.lead());
  answer.phase = phase_;
  answer.horn = sounds_full(o) || (stage_ == Stage::ask_move && sounds_move_back(o.time_s - stage_s_, back_m_));
  return answer;
}

}  // namespace berm::app
