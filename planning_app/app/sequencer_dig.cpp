// The sequencer's digs: where, how deep, when the bucket is full, and what the next pass may learn from it.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "app/sequencer.hpp"
#include "motion/bucket_weight.hpp"
#include "motion/fill_loop.hpp"
#include "planning/dig_shape.hpp"

namespace berm::app {

namespace {

constexpr double bank_density = 1474.0;           // kg/m3, where nothing was learned yet
constexpr double cut_reserve = 1.05;              // the cut is planned larger than the goal; the estimate ends it
constexpr double least_share_of_speed = 0.4;      // in soil, of digs for little
constexpr double to_goal_speed = 0.8;             // m/s
constexpr double mean_tip_speed = 1.2;                // m/s in the mean of digs: with what brought a kilogram, the work that it took
constexpr double near_truck = radians(20.0);      // either side of the dump's bearing
constexpr double bed_points_age = 12.0;           // s, for the bed map

// Of wall clock: what of a cycle it took.
double milliseconds_since(std::chrono::steady_clock::time_point began) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
}

double millimetres(double metres) { return std::round(1000.0 * metres) / 1000.0; }

// From where the bucket is through the drag. A tip that comes down onto the start goes on to where the drag is 0.2 m in: over the start the way turns twice,
// and the tip would nearly stand there.
std::vector<DigWaypoint> way_in(const ArmPoints& now, const std::vector<DigWaypoint>& drag) {
  constexpr double comes_down = 0.3;        // m over the start
  constexpr std::ptrdiff_t turns = 3;       // waypoints: over the start, at it, and 0.1 m on
  std::vector<DigWaypoint> way{{now.tip.r, now.tip.z, now.bucket_attitude}};
  way.insert(way.end(), drag.begin() + (now.tip.z > drag.front().z + comes_down ? turns : 0), drag.end());
  return way;
}

// The tip's planned way through the soil, [r, z]: without the entry above the surface and the lift at the end.
nlohmann::ordered_json drag_points(const DigPlan& plan) {
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
  for (std::size_t i = 1; i + 1 < plan.drag.size(); ++i) points.push_back({millimetres(plan.drag[i].r), millimetres(plan.drag[i].z)});
  return points;
}

nlohmann::ordered_json shape_points(const DigShape& shape) {
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
  for (const auto& [r, z] : shape) points.push_back({millimetres(r), millimetres(z)});
  return points;
}

}  // namespace

DigNeeds Sequencer::needs_for(double kg) const {
  DigNeeds needs;
  needs.volume = cut_reserve * std::max(300.0 * scale_.load, kg) / (yield_ * bank_density);
  needs.bucket_width = bucket_width(machine_);
  needs.deepest *= scale_.bucket;
  needs.payload = kg;
  needs.effort *= scale_.load;
  if (filled_.known()) needs.effort = mean_tip_speed * kg / filled_.kg_per_impulse();
  return needs;
}

// When another bench or reach is taken up, with the reason.
void Sequencer::tell_region(const Observation& o, const RegionDig& next) const {
  const DigRegion& to = next.region;
  if (to.bench == region_.bench && to.reach == region_.reach) return;
  const char* why = region_.bench == 0 ? "begin" : next.left == 0 || (to.reach == region_.reach && to.bench < region_.bench) ? "yields again" : "dug out before it";
  log_.event("region", {{"time_s", o.time_s}, {"bench", to.bench}, {"reach", reach_name(to.reach)}, {"floor_m", to.bounds.floor},
                        {"end_m", to.bounds.end_radius}, {"why", why}, {"columns_dug_out", next.left}});
}

void Sequencer::plan_next_dig(const Observation& o, double dump_beyond) {
  const auto began = std::chrono::steady_clock::now();
  ground_.observe(terrain_);
  DigNeeds needs = needs_for(goal_kg_ > 0.0 ? goal_kg_ : full_bucket_kg());
  needs.dump_beyond = dump_beyond;
  if (site_.bed) needs.dump_bearing = std::atan2(site_.bed->centre_y, site_.bed->centre_x);
  RegionDig next = next_dig(machine_, site_, dig_floor_, ground_, needs, region_);
  const double plan_ms = milliseconds_since(began);
  tell_region(o, next);
  dig_ = std::move(next.plan);
  region_ = next.region;
  log_.event("next_dig", {{"time_s", o.time_s}, {"bearing_deg", degrees(dig_.bearing)}, {"bench", region_.bench}, {"column", region_.column},
                          {"reach", reach_name(region_.reach)}, {"volume_m3", dig_.volume}, {"energy_kj", 1e-3 * dig_.energy},
                          {"effort_kj", 1e-3 * needs.effort}, {"dig_s", dig_.dig_seconds}, {"swing_s", dig_.swing_seconds}, {"cost_s", dig_.price()},
                          {"candidates", next.candidates}, {"plan_ms", plan_ms}});
}

void Sequencer::begin_dig(const Observation& o) {
  goal_kg_ = next_goal_kg(o, o.angle[swing]);
  const DigNeeds needs = needs_for(goal_kg_);
  ground_.observe(terrain_);
  cut_.emplace(machine_, SurfaceProfile(ground_, o.angle[swing], needs.bucket_width), needs.bucket_width);
  region_.bounds.bearing = o.angle[swing];
  dig_goal_.emplace(machine_, site_, o.angle[swing], needs.bucket_width);
  dig_ = plan_dig(machine_, site_, dig_floor_, ground_, needs, region_.bounds);
  const ArmPoints now = forward(machine_, arm_.predicted(o.angle, o.velocity));  // it may still be lowered
  auto path = DigPath::solve(machine_, way_in(now, dig_.drag));
  if (!path) {
    miss_dig(o);
    return;
  }
  const DigShape planned = shape_after(machine_, ground_, o.angle[swing], needs.bucket_width, *path, dig_.volume / cut_reserve, dig_.drag[1].r);
  log_.event("dig", {{"bearing_deg", degrees(dig_.bearing)}, {"depth_m", dig_.depth}, {"volume_m3", dig_.volume}, {"goal_kg", goal_kg_}, {"yield", yield_},
                     {"path_m", path->length()}, {"drag", drag_points(dig_)}, {"shape", shape_points(planned)}});
  planned_fill_ = fill_along(machine_, SurfaceProfile(ground_, o.angle[swing], needs.bucket_width), needs.bucket_width, *path);
  follower_.begin(std::move(*path));
  filled_.begin();
  dug_share_ = 0.0;
  stall_.begin();
  missed_digs_ = 0;
  holds_nothing_ = false;
  brings_load_ = false;  // it opened over the dig
  pass_began_s_ = pass_ == 0 || pass_began_s_ == 0.0 ? o.time_s : pass_began_s_;
  enter_phase(BERM_PHASE_DIG, o);
  enter(Stage::dig, o);
}

// Where the bucket has passed the ground is no higher than its shell was; what then stands too steep slides into the cut.
void Sequencer::note_cut(const Observation& o) {
  lower_ground(ground_, o.angle[swing], bucket_width(machine_), cut_->surface());
  ground_.settle();
}

// What the cut model's cubic metre weighed in the bucket. A full bucket says only that there was at least so much.
void Sequencer::learn_yield(double weighed_kg, double brought_along_kg) {
  constexpr double weight = 0.5, least = 0.5, most = 1.8, full_share = 0.93;
  const double modelled = cut_ ? cut_->volume() * bank_density : 0.0;
  if (modelled < 200.0 * scale_.load) return;
  const double seen = (weighed_kg - brought_along_kg) / modelled;
  if (weighed_kg > full_share * heaped_.kg() && seen < yield_) return;
  yield_ = std::clamp((1.0 - weight) * yield_ + weight * seen, least, most);
}

// What a pass is planned to bring at most.
double Sequencer::full_bucket_kg() const {
  constexpr double share = 0.975;
  return share * heaped_.kg();
}

void Sequencer::learn_heaped(const Observation& o, double lifted_kg) {
  const double was = heaped_.kg();
  heaped_.held(lifted_kg);
  // Else the drag was at its end, or something else ended the dig.
  if (filled_.known() && filled_.kg() + sticking_.left_kg() >= goal_kg_) heaped_.learn(goal_kg_, lifted_kg, filled_.impulse());
  if (heaped_.kg() == was) return;
  fill_.plan_with(full_bucket_kg());
  log_.event("heaped_bucket", {{"time_s", o.time_s}, {"kg", heaped_.kg()}, {"was_kg", was}});
}

// What is in the bucket though it is as empty as it gets: weighed on the way back, and then until the next dig's soil is on top of it.
double Sequencer::stuck_kg() const {
  return sticking_.sticks() && stage_ == Stage::pass && emptied_ && after_.known() ? after_.kg() : sticking_.left_kg();
}

// Whether the implements' own weight can be learned: on the first way back of a soil that sticks, and until the bucket has been weighed there, it cannot.
bool Sequencer::knows_what_stuck() const {
  return sticking_.sticks() ? stage_ != Stage::pass || after_.known() : recent_.kg() < empty_share * full_bucket_kg();
}

void Sequencer::feel(const Observation& o) {
  constexpr double gravity = 9.81;
  const Moments held = without_load(machine_, o.angle, holding_moments(machine_, o.pressure), stuck_kg());
  if (stage_ == Stage::pass && emptied_ && !load_check_.keeps_rest()) holds_nothing_ = true;
  if (holds_nothing_ && o.running() && knows_what_stuck()) weight_.learn(o.angle, held, machine_.cycle);
  soil_n_.reset();
  if ((stage_ != Stage::dig && stage_ != Stage::curl) || !weight_.known(o.angle)) return;
  PlaneForce soil = force_on_bucket(machine_, o.angle, held, weight_.of(o.angle));
  soil.z += gravity * std::min(heaped_.kg(), filled_.kg());
  soil_n_ = std::hypot(soil.r, soil.z);
  filled_.add(resistance(machine_, o.angle, o.velocity, soil), machine_.cycle);
}

// Closed loop on the fill, along the path.
void Sequencer::hold_fill(double in_bucket_kg) {
  DigFollower::Departure departure = follower_.departure();
  const ArmPoints planned_arm = forward(machine_, follower_.on_path());
  const double total = planned_fill_.back();
  const double planned = total > 0.0 ? planned_fill_[static_cast<std::size_t>(follower_.progress() * static_cast<double>(planned_fill_.size() - 1))] / total : 0.0;
  const FillSeen seen{in_bucket_kg / goal_kg_, planned};
  departure.curl = curl_for(seen, departure.curl, planned_arm.bucket_attitude, machine_.cycle);
  if (follower_.stalled_s() == 0.0) {
    // Over the floor at the attitude that it has: curled sooner than planned its shell lies lower.
    const double attitude = std::min(planned_arm.bucket_attitude, departure.curl), r = planned_arm.tip.r;
    const double floor = std::max({region_.bounds.floor, dig_floor_.at(r, attitude), dig_goal_->least_tip(r, attitude)});
    departure.lift = lift_for(seen, departure.lift, floor - planned_arm.tip.z, machine_.cycle);
  }
  follower_.depart(departure);
}

// A bucket that comes down as fast as in the air passes its path by half a metre where that turns; soil is dug deeper later, but what the goal leaves standing is gone.
bool Sequencer::comes_down_to_goal(const Observation& o, const ArmPoints& now) const {
  constexpr double ahead_s = 0.8, comes_down = 0.02;  // s; m in it
  const double least = dig_goal_->least_tip(now.tip.r, now.bucket_attitude);
  if (std::isinf(least)) return false;
  Joints later = o.angle;
  for (const std::size_t j : {boom, stick, bucket}) later[j] += o.velocity[j] * ahead_s;
  const double then = forward(machine_, later).tip.z;
  return then < now.tip.z - comes_down && then < least;
}

Joints Sequencer::dig(const Observation& o) {
  const ArmPoints now = forward(machine_, o.angle);
  cut_->reach(o.angle);
  const bool in_soil = now.tip.z < cut_->surface().at(now.tip.r) + 0.15;
  // The weighing is blind while the bucket is in the soil: the force that it took tells what is in it; until a bucket was weighed, with a usual
  // soil's figure, what both it and the cut model say.
  const double modelled_kg = cut_->volume() * bank_density * yield_, felt_kg = filled_.kg() + sticking_.left_kg();
  const double in_bucket_kg = filled_.known() ? felt_kg : filled_.impulse() > 0.0 ? std::min(modelled_kg, felt_kg) : modelled_kg;
  const bool heavy = in_bucket_kg >= goal_kg_;
  dug_share_ = in_bucket_kg / goal_kg_;
  if (filled_.known()) hold_fill(in_bucket_kg);
  // A bucket that the kernel slows, as while the ground is learned, comes after the path the later for it.
  const Joints let_out = arm_.shares();
  const double slowest = std::min({let_out[boom], let_out[stick], let_out[bucket]});
  stall_.add({follower_.stalled_s() > 0.0, slowest, soil_n_, tip_speed(machine_, o.angle, o.velocity)}, machine_.cycle);
  const DigStall::Told stall = stall_.told();
  if (follower_.finished() || heavy || stall != DigStall::Told::no) {
    begin_curl(o, heavy ? "full" : stall == DigStall::Told::no ? "end of path" : stall == DigStall::Told::by_soil ? "stalled" : "standing");
    return lift_and_curl(o);
  }
  // A small goal is overshot by what comes in while the bucket is told to stop.
  const double gently = std::clamp(goal_kg_ / full_bucket_kg(), least_share_of_speed, 1.0);
  const double speed = in_soil ? gently * drag_soil_speed : drag_air_speed;
  return follower_.step(machine_, arm_, o.angle[swing], comes_down_to_goal(o, now) ? std::min(speed, to_goal_speed) : speed, o.angle, o.velocity);
}

void Sequencer::begin_curl(const Observation& o, const char* why) {
  const ArmPoints now = forward(machine_, arm_.predicted(o.angle, o.velocity));  // it is on its way up already
  log_.event("dug", {{"time_s", o.time_s}, {"why", why}, {"r_m", now.tip.r}, {"z_m", now.tip.z}, {"modelled_kg", cut_->volume() * bank_density * yield_},
                     {"felt_kg", filled_.kg()}, {"impulse_kns", 1e-3 * filled_.impulse()}, {"hardest_kn", 1e-3 * stall_.hardest_n()}});
  constexpr double deep = 1.75;  // m
  comes_from_deep_ = bank_over(cut_->surface(), now) > deep;
  const auto way = DigPath::solve(machine_, way_out(machine_, cut_->surface(), now));
  can_lift_ = way.has_value();
  begin_pass_search(o, way ? way->at(way->length()) : o.angle);
  enter(Stage::curl, o);
}

// The bucket is not weighed yet: it is to bring its goal, and the passes after it the rest.
DumpPoint Sequencer::dump_point(const Observation& o, double goal_kg, double dig_bearing) const {
  DumpNeeds needs;
  needs.bucket_half_width = 0.5 * bucket_width(machine_);
  needs.scale = scale_;
  needs.since_s = o.time_s - bed_points_age;
  needs.dump_kg = goal_kg;
  needs.may_be_part = fill_.must_weigh(machine_.bucket_payload_kg);
  needs.most_kg = needs.may_be_part ? goal_kg : machine_.bucket_payload_kg;
  needs.rest_kg = std::max(0.0, fill_.rest_kg() - goal_kg);
  needs.farthest_radius = farthest_dump(machine_, site_.bed->wall_top);
  needs.dig_beyond = wrapped(middle_of_digs(site_) - dig_bearing);
  return choose_dump_point(*bed_, needs);
}

// No more than stays in the bucket until it is over the place where it will go.
double Sequencer::next_goal_kg(const Observation& o, double dig_bearing) const {
  const double goal_kg = fill_.next_goal_kg();
  return std::min(goal_kg, heaped_.kg() * share_at_reach(machine_, site_.bed->wall_top, dump_point(o, goal_kg, dig_bearing).radius));
}

// Whether the next pass's soil finds a place under the truck zone's ceiling.
bool Sequencer::more_fits(const Observation& o) const {
  const DumpPoint next = dump_point(o, fill_.next_goal_kg(), dig_.bearing);
  if (next.fits) return true;
  log_.event("heap_full", {{"time_s", o.time_s}, {"truck", truck_}, {"height_m", next.heap_top}, {"loaded_kg", fill_.loaded_kg()}, {"target_kg", site_.place.target_kg},
                           {"why", "wherever the next bucket were dumped the heap would stand too near to the truck zone's ceiling"}});
  return false;
}

void Sequencer::plan_dump(const Observation& o) {
  const auto began = std::chrono::steady_clock::now();
  dump_ = dump_point(o, goal_kg_, o.angle[swing]);
  nlohmann::ordered_json fields{{"time_s", o.time_s}, {"u_m", dump_.at.u}, {"v_m", dump_.at.v}, {"height_m", dump_.height}, {"bed_observed", dump_.observed},
                      {"seen_share", dump_.seen_share}, {"load_centre_u_m", dump_.load_centre.u}, {"load_centre_v_m", dump_.load_centre.v},
                      {"passes_left", fill_.passes_left()}, {"plan_ms", milliseconds_since(began)}};
  if (std::isfinite(dump_.heap_top)) fields.update({{"heap_top_m", dump_.heap_top}, {"fits", dump_.fits}});
  log_.event("dump", fields);
}

void Sequencer::begin_pass_search(const Observation& o, const Joints& lifted_from) {
  plan_dump(o);
  note_cut(o);
  const bool more = !fill_.full_with(goal_kg_);
  const double here = o.angle[swing];
  dig_.bearing = here;
  plan_next_dig(o, wrapped(dump_.bearing - std::atan2(site_.bed->centre_y, site_.bed->centre_x)));
  task_ = PassTask{lifted_from, dump_.bearing, dump_.radius, dig_.bearing, {dig_.drag.front().r, dig_.drag.front().z}, site_.bed->wall_top, site_.bed->wall_top, sticking_.open_farther(), brakes_.known(), more};
  task_.lifted_from[swing] = here;
  const Skyline skyline(machine_, site_, kernel_map_.ground(KernelMap::Unseen::level), Skyline::OverHigh::refused);
  task_.truck_top = skyline.highest(dump_.bearing - near_truck, dump_.bearing + near_truck, 4.2 * scale_.arm, 8.6 * scale_.arm);
  const auto poses = pass_poses(machine_, task_);
  if (!poses) {
    search_.reset();  // refuse_truck
    return;
  }
  poses_ = *poses;
  search_.emplace(scripts_, machine_, skyline, task_, poses_);
}

Joints Sequencer::curl(const Observation& o) {
  if (search_ && !search_->done()) search_->step();
  if (cut_) cut_->reach(o.angle);
  constexpr double curls_on = radians(60.0);  // what the script does
  const bool done = !can_lift_ || o.time_s - stage_s_ > 5.0 || forward(machine_, o.angle).bucket_attitude < curled + curls_on;
  if (done && search_ && search_->done()) {
    note_cut(o);
    poses_ = search_->poses();
    scanners_.learn_braking(brakes_.known());
    begin_script(pass_script(scripts_, machine_, task_, poses_, search_->thresholds()));
    ahead_pass_ = {task_, poses_, search_->thresholds()};
    emptied_ = pours_ = false;
    open_since_s_ = -1.0;
    before_.reset();
    swung_.reset();
    after_.reset();
    pour_.begin();
    recent_ = {};  // of the empty bucket; the weighing is blind for a while yet
    load_check_.begin(o.time_s, fill_.must_weigh(machine_.bucket_payload_kg));
    log_.event("script", {{"swing_start_boom_deg", degrees(search_->thresholds().swing_start_boom)}, {"hover_offset_deg", degrees(search_->thresholds().hover_offset)}, {"hover_deg", degrees(poses_.hover[boom])}, {"brake_rad_s2", brakes_.known()}, {"lower_offset_deg", degrees(search_->thresholds().lower_offset)},
                          {"extend_offset_deg", degrees(search_->thresholds().extend_offset)}, {"open_offset_deg", degrees(search_->thresholds().open_offset)},
                          {"truck_bearing_deg", degrees(dump_.bearing)}, {"clear", search_->clear()}, {"model_seconds", search_->seconds()}});
    enter(Stage::pass, o);
    return pass(o);
  }
  if (done && !search_) {
    log_.event("unreachable", {{"time_s", o.time_s}, {"what", "dump point"}, {"bearing_deg", degrees(dump_.bearing)}, {"radius_m", dump_.radius}});
    refuse_truck(o);
    return {};
  }
  return lift_and_curl(o);
}

// Each joint by itself: what soil holds back it holds back in all of them alike, and a path would wait for the slowest when it lets go. The bucket curls as
// fast as it can, for its soil lies on nothing else once its lip is out; the boom is on its way to where the script has it, and beyond, so that it does not
// brake before that takes over. From deep under a bank it is slower: what the bucket pushes up has to slide off.
Joints Sequencer::lift_and_curl(const Observation& o) {
  constexpr double boom_pace = 0.8, boom_pace_from_deep = 0.5;
  constexpr double beyond = radians(20.0);
  if (!can_lift_) return {};
  Joints goals = task_.lifted_from;
  goals[swing] = o.angle[swing];
  goals[boom] += beyond;
  goals[stick] = o.angle[stick];
  Joints command = arm_.toward(goals, {1.0, comes_from_deep_ ? boom_pace_from_deep : boom_pace, 1.0, 1.0}, o.angle, o.velocity);
  command[swing] = 0.0;  // it stands while the bucket is in the soil
  return command;
}

}  // namespace berm::app
