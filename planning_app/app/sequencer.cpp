#include "app/sequencer.hpp"

#include <algorithm>
#include <cmath>

#include "app/motion_guard.hpp"

namespace berm::app {

namespace {

constexpr double full_bucket_kg = 1560.0;         // what a pass is planned to bring at most
constexpr double heaped_kg = 1600.0;              // what the bucket holds
constexpr double bank_density = 1474.0;           // kg/m3, where nothing was learned yet
constexpr double cut_reserve = 1.05;              // the cut is planned larger than the goal; the estimate ends it
constexpr double script_period = 0.1;             // s
constexpr double skyline_period = 0.5;
constexpr double arrived = radians(1.5);
constexpr double still = radians(0.8);            // rad/s
constexpr double air_speed = 1.1, soil_speed = 1.3, curl_speed = 1.5;  // m/s of the tip
constexpr double stall_patience = 1.0;            // s
constexpr double curled = radians(-174.0);        // absolute bucket angle with the mouth up
constexpr double near_truck = radians(20.0);      // either side of the dump's bearing
constexpr double poor_share = 0.1;                // a pass that brings less of its goal found nothing
constexpr int most_poor_passes = 4;               // in a row; then there is nothing left to dig from here
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
  skyline_.emplace(machine_, site_, kernel_map_.ground(KernelMap::Unseen::blocked));
  skyline_s_ = o.time_s;
}

DigNeeds Sequencer::needs_for(double kg) const {
  DigNeeds needs;
  needs.volume = cut_reserve * std::max(300.0, kg) / (yield_ * bank_density);
  needs.bucket_width = bucket_width(machine_);
  return needs;
}

void Sequencer::plan_next_dig() {
  dig_ = choose_dig(machine_, site_, terrain_, needs_for(goal_kg_ > 0.0 ? goal_kg_ : full_bucket_kg), dig_.bearing);
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
  cut_.emplace(machine_, SurfaceProfile(terrain_, o.angle[swing], needs.bucket_width), needs.bucket_width);
  SiteModel here = site_;
  here.dig_radius_end = dig_.end_radius;
  dig_ = plan_dig(machine_, here, terrain_, needs, o.angle[swing]);
  const ArmPoints now = forward(machine_, o.angle);
  std::vector<DigWaypoint> way{{now.tip.r, now.tip.z, now.bucket_attitude}};
  way.insert(way.end(), dig_.drag.begin(), dig_.drag.end());
  auto path = DigPath::solve(machine_, way);
  if (!path) {
    log_.event("unreachable", {{"time_s", o.time_s}, {"what", "drag"}, {"bearing_deg", degrees(dig_.bearing)}});
    begin_approach(o, true);
    return;
  }
  log_.event("dig", {{"bearing_deg", degrees(dig_.bearing)}, {"depth_m", dig_.depth}, {"volume_m3", dig_.volume}, {"goal_kg", goal_kg_}, {"yield", yield_}, {"path_m", path->length()}});
  follower_.begin(std::move(*path));
  pass_began_s_ = pass_ == 0 || pass_began_s_ == 0.0 ? o.time_s : pass_began_s_;
  enter_phase(BERM_PHASE_DIG, o);
  enter(Stage::dig, o);
}

// Where the bucket has passed the ground is no higher than its shell was.
void Sequencer::note_cut(const Observation& o) {
  const SurfaceProfile before(terrain_, o.angle[swing], bucket_width(machine_)), &after = cut_->surface();
  const double half = 0.45 * bucket_width(machine_), c = std::cos(o.angle[swing]), s = std::sin(o.angle[swing]);
  for (double r = SurfaceProfile::first; r < SurfaceProfile::last; r += 0.5 * TerrainMap::cell) {
    if (after.at(r) > before.at(r) - 0.02) continue;
    for (double across = -half; across <= half; across += 0.5 * TerrainMap::cell) terrain_.lower_to(r * c - across * s, r * s + across * c, after.at(r));
  }
}

// What the cut model's cubic metre weighed in the bucket. A full bucket says only that there was at least so much.
void Sequencer::learn_yield(double weighed_kg) {
  constexpr double weight = 0.5, least = 0.5, most = 1.8, full_share = 0.97;
  const double modelled = cut_ ? cut_->volume() * bank_density : 0.0;
  if (modelled < 200.0) return;
  const double seen = weighed_kg / modelled;
  if (weighed_kg > full_share * heaped_kg && seen < yield_) return;
  yield_ = std::clamp((1.0 - weight) * yield_ + weight * seen, least, most);
}

Joints Sequencer::dig(const Observation& o) {
  const ArmPoints now = forward(machine_, o.angle);
  cut_->reach(o.angle);
  const bool in_soil = now.tip.z < cut_->surface().at(now.tip.r) + 0.15;
  // The weighing is blind while the bucket is in the soil: the cut model tells what is in it.
  const bool heavy = cut_->volume() * bank_density * yield_ >= goal_kg_;
  const bool stalled = follower_.stalled_s() > stall_patience;
  if (follower_.finished() || heavy || stalled) {
    begin_curl(o);
  }
  return follower_.step(machine_, arm_, o.angle[swing], in_soil ? soil_speed : air_speed, o.angle, o.velocity);
}

// Out of the soil by the shortest way on which the bucket can curl: inward until the curled bucket is within reach, up to just over the
// surface, then curled.
void Sequencer::begin_curl(const Observation& o) {
  constexpr double curled_within = 6.35, over_surface = 0.15, lift = 0.45;
  const ArmPoints now = forward(machine_, o.angle);
  const double r = std::min(now.tip.r - 0.05, curled_within);
  const double z = std::max(now.tip.z, cut_->surface().at(r) + over_surface);
  const double halfway = std::min(now.bucket_attitude, 0.5 * (now.bucket_attitude + curled));
  const std::vector<DigWaypoint> way{{now.tip.r, now.tip.z, now.bucket_attitude}, {r, z, halfway}, {r - 0.05, z + lift, curled}};
  if (auto path = DigPath::solve(machine_, way)) {
    begin_pass_search(o, path->at(path->length()));
    follower_.begin(std::move(*path));
  } else {
    begin_pass_search(o, o.angle);
    follower_.end();
  }
  trimming_ = trimmed_ = false;
  enter(Stage::curl, o);
}

void Sequencer::begin_pass_search(const Observation& o, const Joints& lifted_from) {
  dump_ = choose_dump_point(bed_, 0.5 * bucket_width(machine_), o.time_s - bed_points_age);
  const double expected = fill_.loaded_kg() + goal_kg_;
  const bool more = expected < TruckFill::full_share * site_.truck.target_kg;
  const double here = o.angle[swing];
  dig_.bearing = here;
  plan_next_dig();
  task_ = PassTask{lifted_from, dump_.bearing, dump_.radius, dig_.bearing, {dig_.drag.front().r, dig_.drag.front().z}, site_.truck.wall_top, more};
  task_.lifted_from[swing] = here;
  const Skyline skyline(machine_, site_, kernel_map_.ground(KernelMap::Unseen::level));
  task_.truck_top = skyline.highest(dump_.bearing - near_truck, dump_.bearing + near_truck, 4.2, 8.6);
  const auto poses = pass_poses(machine_, site_, task_);
  if (!poses) {
    log_.event("unreachable", {{"time_s", o.time_s}, {"what", "dump point"}, {"bearing_deg", degrees(dump_.bearing)}, {"radius_m", dump_.radius}});
    search_.reset();
    return;
  }
  poses_ = *poses;
  search_.emplace(machine_, skyline, task_, poses_);
}

Joints Sequencer::curl(const Observation& o) {
  if (search_ && !search_->done()) search_->step();
  if (cut_) cut_->reach(o.angle);
  if (trimming_) return trim(o);
  const bool done = !follower_.active() || follower_.finished() || o.time_s - stage_s_ > 5.0 || forward(machine_, o.angle).bucket_attitude < curled + radians(6.0);
  if (done && !trimmed_ && recent_.kg() > TruckFill::trim_share * site_.truck.target_kg - fill_.loaded_kg()) {
    log_.event("trim", {{"time_s", o.time_s}, {"payload_kg", recent_.kg()}, {"loaded_kg", fill_.loaded_kg()}});
    trimming_ = trimmed_ = true;
    trim_since_s_ = o.time_s;
    return {};
  }
  if (done && search_ && search_->done()) {
    note_cut(o);
    script_ = pass_script(machine_, task_, poses_, search_->thresholds());
    script_.start();
    script_s_ = -1.0;
    emptied_ = false;
    open_since_s_ = -1.0;
    before_.reset();
    after_.reset();
    log_.event("script", {{"swing_start_boom_deg", degrees(search_->thresholds().swing_start_boom)}, {"hover_offset_deg", degrees(search_->thresholds().hover_offset)},
                          {"truck_bearing_deg", degrees(dump_.bearing)}, {"bed_observed", dump_.observed}, {"clear", search_->clear()}, {"model_seconds", search_->seconds()}});
    enter(Stage::pass, o);
    return pass(o);
  }
  if (!follower_.active()) return {};
  return follower_.step(machine_, arm_, o.angle[swing], curl_speed, o.angle, o.velocity);
}

// The last bucket would overload the truck: over the dig, lets go of what is too much, tilt by tilt, then curls again.
Joints Sequencer::trim(const Observation& o) {
  constexpr double tilt_rate = radians(12.0), longest_s = 12.0, steepest = radians(-75.0);
  const double goal = site_.truck.target_kg - fill_.loaded_kg();
  const double attitude = forward(machine_, o.angle).bucket_attitude;
  if (recent_.kg() <= goal || o.time_s - trim_since_s_ > longest_s || attitude > steepest) {
    trimming_ = false;
    follower_.end();
    return {};
  }
  return {0.0, 0.0, 0.0, tilt_rate};
}

std::uint32_t Sequencer::pass_events(const Observation& o) {
  constexpr double open_at_least = 0.25, open_at_most = 2.0, empty_share = 0.05;
  const bool opening = script_.of(bucket).active() >= opening_rule;
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
  else enter_phase(script_.of(bucket).active() >= opening_rule ? BERM_PHASE_DUMP : BERM_PHASE_SWING_TO_TRUCK, o);
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
  if (weighed) learn_yield(before);
  poor_passes_ = payload < poor_share * goal_kg_ ? poor_passes_ + 1 : 0;
  bed_.note_dump(dump_.u, payload);
  ++pass_;
  log_.event("pass", {{"pass", pass_}, {"truck", truck_}, {"seconds", o.time_s - pass_began_s_}, {"payload_kg", payload}, {"loaded_kg", fill_.loaded_kg()},
                      {"dump_u_m", dump_.u}, {"dig_bearing_deg", degrees(task_.lifted_from[swing])}, {"time_s", o.time_s}});
  pass_began_s_ = o.time_s;
  if (poor_passes_ >= most_poor_passes && !fill_.full()) {
    log_.event("face_exhausted", {{"time_s", o.time_s}, {"truck", truck_}, {"loaded_kg", fill_.loaded_kg()}});
    enter_phase(BERM_PHASE_WAIT, o);
    enter(Stage::exhausted, o);
    return;
  }
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
    case Stage::exhausted:
    case Stage::finished: return {};
  }
  return {};
}

void Sequencer::log_held(const Observation& o, const Joints& wanted) const {
  const auto blocking = skyline_->blocking(preview(machine_, o.angle, wanted));
  if (!blocking) return;
  const bool ground = blocking->what == Skyline::Blocking::What::ground, unseen = std::isinf(blocking->height);
  nlohmann::ordered_json fields{{"time_s", o.time_s}, {"by", !ground ? blocking->what == Skyline::Blocking::What::own_body ? "own body" : "joint range" : unseen ? "unseen ground" : "ground"}};
  if (ground) fields.update({{"bearing_deg", degrees(blocking->bearing)}, {"distance_m", blocking->distance}});
  if (ground && !unseen) fields["height_m"] = blocking->height;
  log_.event("held", fields);
}

// Through the guard. What the guard holds back for long is looked at again; if that does not help the kernel decides, at creep speed.
Joints Sequencer::slowed(const Observation& o, const Joints& wanted) {
  constexpr double look_after = 1.0, give_up_after = 12.0;
  const Joints allowed = guarded(machine_, *skyline_, arm_.predicted(o.angle, o.velocity), wanted);
  const bool held = std::all_of(allowed.begin(), allowed.end(), [](double v) { return v == 0.0; });
  if (!held || held_since_s_ < 0.0) {
    held_since_s_ = held ? o.time_s : -1.0;
    looked_ = false;
    return allowed;
  }
  const double held_s = o.time_s - held_since_s_;
  if (held_s > look_after && !looked_) {
    log_held(o, wanted);
    scanners_.begin_full_sweep();
    looked_ = true;
  }
  return held_s > give_up_after ? crept(machine_, wanted) : allowed;
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
    answer.velocity = moves ? slowed(o, wanted) : wanted;
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
