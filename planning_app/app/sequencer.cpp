#include "app/sequencer.hpp"

#include <algorithm>
#include <cmath>

#include "app/motion_guard.hpp"

namespace berm::app {

namespace {

constexpr double full_bucket_kg = 1560.0;         // what a pass is planned to bring at most
constexpr double loose_density = 1340.0;          // kg/m3
constexpr double swell = 1.10;
constexpr double cut_reserve = 1.12;              // the cut is planned larger than the goal; the weighing ends it
constexpr double script_period = 0.1;             // s
constexpr double skyline_period = 0.5;
constexpr double arrived = radians(1.5);
constexpr double still = radians(0.8);            // rad/s
constexpr double air_speed = 1.1, soil_speed = 0.75, curl_speed = 1.3;  // m/s of the tip
constexpr double stall_patience = 1.0;            // s
constexpr double horn_s = 1.0;
constexpr double bed_points_age = 12.0;           // s, for the bed map

double bucket_width(const MachineModel& machine) {
  double half = 0.0;
  for (const Prism& part : machine.parts)
    if (part.link == bucket) half = std::max(half, part.half_width);
  return 1.85 * half;  // the prism covers the bucket with some room
}

const char* phase_name(std::uint16_t phase) {
  static constexpr const char* names[BERM_PHASE_COUNT] = {"idle", "dig", "lift", "swing to truck", "dump", "swing to dig", "wait"};
  return names[phase];
}

}  // namespace

Sequencer::Sequencer(const MachineModel& machine, const SiteModel& site, int trucks, const ProgressLog& log)
    : machine_(machine), site_(site), log_(log), trucks_(trucks), bed_(site.truck), arm_(machine_), scanners_(machine_), recovery_(machine_),
      fill_(site.truck.target_kg) {
  scanners_.begin_full_sweep();
  dig_.bearing = site.dig_swing_right - radians(60.0);  // no dig before the first: nothing to stay away from
}

bool Sequencer::standing(const Observation& o) const {
  return std::all_of(o.velocity.begin(), o.velocity.end(), [](double v) { return std::fabs(v) < still; });
}

void Sequencer::enter(Stage stage, const Observation& o) {
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
  skyline_.emplace(machine_, site_, terrain_);
  skyline_s_ = o.time_s;
}

DigNeeds Sequencer::needs_for(double kg) const {
  DigNeeds needs;
  needs.volume = cut_reserve * std::max(300.0, kg) / loose_density / swell;
  needs.bucket_width = bucket_width(machine_);
  needs.bias = depth_bias_;
  return needs;
}

void Sequencer::plan_next_dig() {
  dig_ = choose_dig(site_, terrain_, needs_for(goal_kg_ > 0.0 ? goal_kg_ : full_bucket_kg), dig_.bearing);
}

void Sequencer::begin_approach(const Observation& o, bool lower) {
  goal_kg_ = fill_.next_goal_kg(full_bucket_kg);
  plan_next_dig();
  const auto script = approach_script(machine_, site_, {o.angle, dig_.bearing, {dig_.drag.front().r, dig_.drag.front().z}, lower});
  if (!script) {
    log_.event("unreachable", {{"time_s", o.time_s}, {"what", "start of the dig"}});
    return;
  }
  script_ = *script;
  script_.start();
  script_s_ = -1.0;
  task_.next_bearing = dig_.bearing;
  enter(Stage::approach, o);
}

Joints Sequencer::run_script(const Observation& o, std::uint32_t events) {
  if (o.time_s - script_s_ >= script_period - 1e-6) {
    script_.evaluate(o.angle, events);
    script_s_ = o.time_s;
  }
  return arm_.toward(script_.goals(), script_.paces(), o.angle, o.velocity);
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
  if (std::fabs(goals[swing] - o.angle[swing]) < arrived && std::fabs(o.velocity[swing]) < still) begin_dig(o);
  return arm_.toward(goals, script_.paces(), o.angle, o.velocity);
}

void Sequencer::begin_dig(const Observation& o) {
  goal_kg_ = fill_.next_goal_kg(full_bucket_kg);
  const DigNeeds needs = needs_for(goal_kg_);
  surface_.emplace(terrain_, o.angle[swing], needs.bucket_width);
  dig_ = plan_dig(site_, terrain_, needs, o.angle[swing]);
  const ArmPoints now = forward(machine_, o.angle);
  std::vector<DigWaypoint> way{{now.tip.r, now.tip.z, now.bucket_attitude}};
  way.insert(way.end(), dig_.drag.begin(), dig_.drag.end());
  auto path = DigPath::solve(machine_, way);
  if (!path) {
    log_.event("unreachable", {{"time_s", o.time_s}, {"what", "drag"}, {"bearing_deg", degrees(dig_.bearing)}});
    begin_approach(o, true);
    return;
  }
  log_.event("dig", {{"bearing_deg", degrees(dig_.bearing)}, {"depth_m", dig_.depth}, {"volume_m3", dig_.volume}, {"goal_kg", goal_kg_}, {"path_m", path->length()}});
  follower_.begin(std::move(*path));
  pass_began_s_ = pass_ == 0 || pass_began_s_ == 0.0 ? o.time_s : pass_began_s_;
  enter_phase(BERM_PHASE_DIG, o);
  enter(Stage::dig, o);
}

// The bucket's edge leaves the ground no higher than itself.
void Sequencer::cut_passage(const Observation& o) {
  const ArmPoints now = forward(machine_, o.angle);
  const double half = 0.45 * bucket_width(machine_);
  for (double across = -half; across <= half; across += 0.5 * TerrainMap::cell) {
    const double c = std::cos(o.angle[swing]), s = std::sin(o.angle[swing]);
    terrain_.lower_to(now.tip.r * c - across * s, now.tip.r * s + across * c, now.tip.z);
  }
}

// A drag that ended light goes deeper next time; one that stalled or was heavy long before its end, shallower.
void Sequencer::learn_depth(bool stalled, bool heavy) {
  constexpr double most = 0.5;
  const double share = goal_kg_ > 0.0 ? recent_.kg() / goal_kg_ : 1.0;
  if (stalled || (heavy && follower_.progress() < 0.6)) depth_bias_ -= 0.08;
  else if (share < 0.9) depth_bias_ += 0.4 * (0.95 - share);
  depth_bias_ = std::clamp(depth_bias_, -most, most);
}

Joints Sequencer::dig(const Observation& o) {
  const ArmPoints now = forward(machine_, o.angle);
  cut_passage(o);
  const bool in_soil = now.tip.z < surface_->at(now.tip.r) + 0.15;
  const bool heavy = recent_.kg() >= goal_kg_ && follower_.progress() > 0.3;
  const bool stalled = follower_.stalled_s() > stall_patience;
  if (follower_.finished() || heavy || stalled) {
    learn_depth(stalled, heavy);
    begin_curl(o);
  }
  return follower_.step(machine_, arm_, o.angle[swing], in_soil ? soil_speed : air_speed, o.angle, o.velocity);
}

void Sequencer::begin_curl(const Observation& o) {
  const ArmPoints now = forward(machine_, o.angle);
  const DigWaypoint from{now.tip.r, now.tip.z, now.bucket_attitude};
  const DigWaypoint to{now.tip.r - 0.05, now.tip.z + 0.45, radians(-174.0)};
  if (auto path = DigPath::solve(machine_, {from, to})) {
    begin_pass_search(o, path->at(path->length()));
    follower_.begin(std::move(*path));
  } else {
    begin_pass_search(o, o.angle);
    follower_.end();
  }
  enter(Stage::curl, o);
}

void Sequencer::begin_pass_search(const Observation& o, const Joints& lifted_from) {
  dump_ = choose_dump_point(bed_, 0.5 * bucket_width(machine_), o.time_s - bed_points_age);
  const double expected = fill_.loaded_kg() + (recent_.kg() > 0.0 ? recent_.kg() : goal_kg_);
  const bool more = expected < TruckFill::full_share * site_.truck.target_kg;
  const double here = o.angle[swing];
  dig_.bearing = here;
  plan_next_dig();
  task_ = PassTask{lifted_from, dump_.bearing, dump_.radius, dig_.bearing, {dig_.drag.front().r, dig_.drag.front().z}, more};
  task_.lifted_from[swing] = here;
  const auto poses = pass_poses(machine_, site_, task_);
  if (!poses) {
    log_.event("unreachable", {{"time_s", o.time_s}, {"what", "dump point"}, {"bearing_deg", degrees(dump_.bearing)}, {"radius_m", dump_.radius}});
    search_.reset();
    return;
  }
  poses_ = *poses;
  search_.emplace(machine_, Skyline(machine_, site_, terrain_), task_, poses_);
}

Joints Sequencer::curl(const Observation& o) {
  if (search_ && !search_->done()) search_->step();
  const bool curled = !follower_.active() || follower_.finished() || o.time_s - stage_s_ > 3.0 || forward(machine_, o.angle).bucket_attitude < radians(-168.0);
  if (curled && search_ && search_->done()) {
    script_ = pass_script(task_, poses_, search_->thresholds());
    script_.start();
    script_s_ = -1.0;
    emptied_ = false;
    open_since_s_ = -1.0;
    before_.reset();
    after_.reset();
    log_.event("script", {{"swing_start_boom_deg", degrees(search_->thresholds().swing_start_boom)}, {"lower_offset_deg", degrees(search_->thresholds().lower_offset)},
                          {"truck_bearing_deg", degrees(dump_.bearing)}, {"bed_observed", dump_.observed}, {"clear", search_->clear()}, {"model_seconds", search_->seconds()}});
    enter(Stage::pass, o);
    return pass(o);
  }
  if (!follower_.active()) return {};
  return follower_.step(machine_, arm_, o.angle[swing], curl_speed, o.angle, o.velocity);
}

std::uint32_t Sequencer::pass_events(const Observation& o) {
  constexpr double open_at_least = 0.25, open_at_most = 2.0, empty_share = 0.06;
  const bool opening = script_.of(bucket).active() >= 2;
  if (!opening || emptied_) return emptied_ ? event_emptied : event_none;
  if (open_since_s_ < 0.0 && o.angle[bucket] > poses_.dump[bucket] - radians(30.0)) open_since_s_ = o.time_s;
  if (open_since_s_ < 0.0) return event_none;
  const double open = o.time_s - open_since_s_;
  const bool light = o.payload_kg >= 0.0 && recent_.kg() < empty_share * full_bucket_kg;
  emptied_ = (open > open_at_least && (light || o.payload_kg < 0.0)) || open > open_at_most;
  return emptied_ ? event_emptied : event_none;
}

Joints Sequencer::pass(const Observation& o) {
  const Joints command = run_script(o, pass_events(o));
  const int swing_rule = script_.of(swing).active();
  if (swing_rule == 0) enter_phase(BERM_PHASE_LIFT, o);
  else if (swing_rule >= 2) enter_phase(BERM_PHASE_SWING_TO_DIG, o);
  else enter_phase(script_.of(bucket).active() >= 2 ? BERM_PHASE_DUMP : BERM_PHASE_SWING_TO_TRUCK, o);
  if (phase_ == BERM_PHASE_SWING_TO_TRUCK) before_.add(o.payload_kg);
  if (phase_ == BERM_PHASE_SWING_TO_DIG) after_.add(o.payload_kg);
  const Joints goals = script_.goals();
  const bool near = std::equal(goals.begin(), goals.end(), o.angle.begin(), [](double g, double a) { return std::fabs(g - a) < radians(4.0); });
  if (script_.at_last() && near) end_pass(o);
  return command;
}

void Sequencer::end_pass(const Observation& o) {
  const bool weighed = before_.known() && after_.known();
  const double before = weighed ? before_.kg() : goal_kg_, after = weighed ? after_.kg() : 0.0;
  const double had = fill_.loaded_kg();
  fill_.add_pass(before, after);
  const double payload = fill_.loaded_kg() - had;
  bed_.note_dump(dump_.u, payload);
  ++pass_;
  log_.event("pass", {{"pass", pass_}, {"truck", truck_}, {"seconds", o.time_s - pass_began_s_}, {"payload_kg", payload}, {"loaded_kg", fill_.loaded_kg()},
                      {"dump_u_m", dump_.u}, {"dig_bearing_deg", degrees(task_.lifted_from[swing])}, {"time_s", o.time_s}});
  pass_began_s_ = o.time_s;
  if (!fill_.full()) {
    if (task_.lower_at_end) enter(Stage::settle, o);
    else begin_approach(o, true);  // it weighed less than expected
    return;
  }
  log_.event("truck_full", {{"truck", truck_}, {"payload_kg", fill_.loaded_kg()}, {"target_kg", site_.truck.target_kg}, {"passes", fill_.passes()},
                            {"seconds", o.time_s - truck_began_s_}});
  enter_phase(BERM_PHASE_WAIT, o);
  enter(Stage::horn, o);
}

Joints Sequencer::plan(const Observation& o) {
  switch (stage_) {
    case Stage::survey:
      if (scanners_.full_sweep_done()) enter(Stage::wait_truck, o);
      return {};
    case Stage::wait_truck:
      if (o.truck_parked) {
        log_.event("truck", {{"truck", truck_}, {"time_s", o.time_s}});
        fill_ = TruckFill(site_.truck.target_kg);
        bed_.clear();
        pass_ = 0;
        pass_began_s_ = truck_began_s_ = o.time_s;
        begin_approach(o, true);
      }
      return {};
    case Stage::approach: return approach(o);
    case Stage::settle: return settle(o);
    case Stage::dig: return dig(o);
    case Stage::curl: return curl(o);
    case Stage::pass: return pass(o);
    case Stage::horn:
      if (o.time_s - stage_s_ >= horn_s) {
        if (truck_ == trucks_) {
          log_.event("finished", {{"time_s", o.time_s}, {"trucks", trucks_}});
          enter(Stage::finished, o);
        } else {
          enter(Stage::wait_leave, o);
        }
      }
      return {};
    case Stage::wait_leave:
      if (!o.truck_parked) {
        ++truck_;
        enter(Stage::wait_truck, o);
      }
      return {};
    case Stage::finished: return {};
  }
  return {};
}

Answer Sequencer::step(const Observation& o) {
  recent_.add(o.payload_kg);
  look(o);
  Answer answer;
  const Recovery::Advice advice = recovery_.step(o, log_);
  if (advice.rescan) scanners_.begin_full_sweep();
  if (advice.resumed && advice.moved && (stage_ == Stage::dig || stage_ == Stage::settle || stage_ == Stage::approach)) begin_approach(o, true);
  if (advice.in_charge) {
    answer.velocity = advice.velocity;
    if (stage_ == Stage::survey && scanners_.full_sweep_done()) enter(Stage::wait_truck, o);
  } else {
    const Joints wanted = plan(o);
    const bool moves = std::any_of(wanted.begin(), wanted.end(), [](double v) { return v != 0.0; });
    answer.velocity = moves ? guarded(machine_, *skyline_, arm_.predicted(o.angle, o.velocity), wanted) : wanted;
  }
  arm_.sent(answer.velocity);
  const double truck_bearing = std::atan2(site_.truck.centre_y, site_.truck.centre_x);
  const bool lifts_soon = stage_ == Stage::curl || (stage_ == Stage::dig && follower_.progress() > 0.6);
  answer.pan = scanners_.step(lifts_soon ? std::uint16_t{BERM_PHASE_LIFT} : phase_, task_.next_bearing, truck_bearing, o.angle[swing], o.velocity[swing], o.pan);
  answer.phase = phase_;
  answer.horn = stage_ == Stage::horn;
  return answer;
}

}  // namespace berm::app
