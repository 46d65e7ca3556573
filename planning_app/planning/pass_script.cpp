#include "planning/pass_script.hpp"

#include <algorithm>
#include <cmath>

#include "motion/implement_scale.hpp"

namespace berm::app {

namespace {

constexpr double range_guard = radians(7.5);      // a standing joint's stop travel stays inside its range
// Bucket pin above what it passes over: the bucket's circle, the margin, the spread of a stop.
double pin_over_top(const ImplementScale& scale) { return 1.6 * scale.bucket + 0.4 + 0.9 * scale.arm; }
constexpr double highest_top = 1.2;               // z; over anything higher the pass is not tried higher
constexpr double reach_step = 0.05;               // m, of the search for a reach
constexpr double most_short = 0.25;               // m, that a load is spilled short of where it is meant to be: with less a bed's far end gets none, with more the wall half of it
constexpr double most_out = 0.5;                  // m, that an arm is farther out than it is meant to
constexpr Joints standing_trembles{0.0, radians(0.5), radians(0.5), radians(0.5)};  // rad/s, of measured speeds
constexpr double heap_lost = 0.6;                 // share of a heaped bucket for a metre beyond the easy reach
constexpr double carry_radius = 6.4;              // of the bucket pin, m; by the scale of the arm
constexpr double back_radius = 6.3;               // the same
constexpr double attitude_carry = radians(-178.0), attitude_spill = radians(-170.0);  // nothing slides yet
constexpr double attitude_rests = radians(-157.0);  // at most, for little to slide
constexpr double attitude_pour = radians(-145.0); // the load begins to slide
constexpr double attitude_open = radians(-48.0);
constexpr double attitude_back = radians(-122.0);
constexpr double attitude_dig = radians(-92.0);
constexpr double spill_ahead = 0.55;              // pin beyond the dump point while the lip points inward, by the scale of the bucket ...
constexpr double dump_behind = 0.25;              // ... and short of it when the bucket hangs open, lip outward
constexpr double part_lip_beyond = 0.3;           // lip beyond the dump point, at most, while a part of a load is poured: by the scale of the bucket
constexpr double part_ahead = radians(15.0);      // the arm follows late, and a lip too far out may be held by what stands beside the bed, and the arm with it: so far ahead of the bucket
constexpr double dig_above = -0.15;               // tip over the entry of the drag, which is above the surface: nearer to that, for the drag takes over on the way down
constexpr double hover_above = 1.60;              // tip over the bench's level while the swing lands: heaps on the crest, the margin, the spread of a stop ...
constexpr double hover_lowest = 0.20, hover_step = 0.35;  // ... and where the search finds that clear, lower by whole steps
constexpr double arrived = radians(1.0);
constexpr double soonest_lead = 1.0, latest_lead = 0.0, lead_step = 0.1;  // s before the swing stands that the bucket begins to open; nothing slides in the first half second
constexpr double empties_before = radians(40.0);         // of the open bucket, when what is left no longer holds up the swing

// Pose with the pin at the point and the attitude as wanted, or as near as the bucket's range allows.
std::optional<Joints> pose_at(const MachineModel& machine, const PlanePoint& pin, double attitude) {
  for (int turn = 0; turn <= 60; ++turn)
    if (auto q = inverse_pin(machine, pin, attitude + radians(turn), range_guard)) return q;
  return std::nullopt;
}

// ... with a shorter radius if out of reach.
std::optional<Joints> pose_near(const MachineModel& machine, PlanePoint pin, double attitude) {
  for (int shorter = 0; shorter < 20; ++shorter, pin.r -= reach_step)
    if (auto q = pose_at(machine, pin, attitude)) return q;
  return std::nullopt;
}

std::optional<Joints> tip_pose_near(const MachineModel& machine, const PlanePoint& tip, double attitude) {
  for (int turn = 0; turn <= 60; ++turn)
    for (const double sign : {1.0, -1.0})
      if (auto q = inverse_tip(machine, tip, attitude + sign * radians(turn), range_guard)) return q;
  return std::nullopt;
}

std::optional<Joints> hover_pose(const MachineModel& machine, const PassTask& task, double above) {
  return tip_pose_near(machine, {task.next_entry.r, above}, attitude_dig);
}

std::vector<double> values_of(const std::vector<ScriptAngle>& angles) {
  std::vector<double> values;
  for (const ScriptAngle& a : angles) values.push_back(a.value);
  return values;
}

bool stands_clear_of_body(const MachineModel& machine, const Joints& pose) { return clears_own_body(machine, LowerEdge(machine, preview(machine, pose, standing_trembles))); }

// A pose for the pin at the point, moved out until it is no nearer to the machine's own body than the kernel lets stick and bucket be, or as far as it goes: a pin
// that is high draws the stick in.
std::optional<Joints> clear_of_body(const MachineModel& machine, std::optional<Joints> pose, const PlanePoint& pin, double attitude) {
  for (double out = reach_step; pose && !stands_clear_of_body(machine, *pose) && out < most_out; out += reach_step) {
    const auto farther = pose_near(machine, {pin.r + out, pin.z}, attitude);
    if (!farther) break;
    pose = farther;
  }
  return pose;
}

std::optional<Joints> pose_clear_of_body(const MachineModel& machine, const PlanePoint& pin, double attitude) {
  return clear_of_body(machine, pose_near(machine, pin, attitude), pin, attitude);
}

// From the swing axis to the farthest dump point that the arm reaches with its load spilled where it is meant to be, m.
double easy_reach(const MachineModel& machine, double wall_top) {
  const ImplementScale scale = scale_of(machine);
  double radius = carry_radius * scale.arm;
  while (pose_at(machine, {radius + reach_step + spill_ahead * scale.bucket, wall_top + pin_over_top(scale)}, attitude_carry)) radius += reach_step;
  return radius;
}

// The truck stands to the left of the dig, 1, or to its right, -1: the script's comparisons turn round with it.
double side_of(const PassTask& task) { return task.truck_bearing >= task.lifted_from[swing] ? 1.0 : -1.0; }

}  // namespace

std::optional<PassPoses> pass_poses(const MachineModel& machine, const PassTask& task) {
  const ImplementScale scale = scale_of(machine);
  const double pin_z = std::clamp(task.truck_top, task.wall_top, std::max(task.wall_top, highest_top)) + pin_over_top(scale);
  const auto carry = pose_clear_of_body(machine, {carry_radius * scale.arm, pin_z}, attitude_carry);
  const auto spill = pose_near(machine, {task.dump_radius + spill_ahead * scale.bucket, pin_z}, attitude_spill);
  const PlanePoint open_pin{task.dump_radius - dump_behind * scale.bucket, pin_z};
  auto dump = pose_near(machine, open_pin, attitude_open);
  for (double farther = task.open_farther; dump && farther > 0.0; farther -= radians(1.0)) {
    // The lip stays where it is when the bucket opens no farther: else what sticks, and lets go last, falls beyond the far wall.
    const double drawn_in = machine.bucket_length * (std::cos(attitude_open + farther) - std::cos(attitude_open));
    const auto open = inverse_pin(machine, {open_pin.r - drawn_in, pin_z}, attitude_open + farther, range_guard);
    if (!open || (*open)[bucket] <= (*dump)[bucket] || !stands_clear_of_body(machine, *open)) continue;
    dump = open;
    break;
  }
  // Over a high load at a near place the stick comes to the machine's own body before the bucket is open: farther out, and its soil with it.
  dump = clear_of_body(machine, dump, open_pin, attitude_open);
  const auto back = pose_clear_of_body(machine, {back_radius * scale.arm, pin_z}, attitude_back);
  const auto hover = hover_pose(machine, task, hover_above);
  const auto dig = tip_pose_near(machine, {task.next_entry.r, task.next_entry.z + dig_above}, attitude_dig);
  if (!carry || !spill || !dump || !back || !hover || !dig) return std::nullopt;
  if (!task.lower_at_end) return PassPoses{*carry, *spill, *dump, *back, *back, *back};
  return PassPoses{*carry, *spill, *dump, *back, *hover, *dig};
}

Joints part_pose(const MachineModel& machine, const PassTask& task, const PassPoses& poses, double bucket_attitude) {
  bucket_attitude += part_ahead;
  const PlanePoint pin = forward(machine, poses.spill).bucket_pin;
  const double lip = pin.r + machine.bucket_length * std::cos(bucket_attitude), beyond = lip - task.dump_radius - part_lip_beyond * scale_of(machine).bucket;
  Joints pose = poses.spill;
  if (beyond <= 0.0) return pose;
  // Where the bucket is has no part in where its pin is: an attitude that its range allows.
  const double attitude = std::clamp(bucket_attitude, attitude_back, attitude_open);
  const auto drawn = inverse_pin(machine, {pin.r - beyond, pin.z}, attitude, range_guard);
  if (!drawn) return pose;
  for (const Joint j : {boom, stick}) pose[j] = (*drawn)[j];
  return pose;
}

double farthest_dump(const MachineModel& machine, double wall_top) { return easy_reach(machine, wall_top) + most_short; }

double share_at_reach(const MachineModel& machine, double wall_top, double radius) {
  return 1.0 - heap_lost * std::clamp(radius - easy_reach(machine, wall_top), 0.0, most_short);
}

double level_bucket(const MachineModel& machine, double stick_attitude) {
  return std::max(attitude_carry - stick_attitude, machine.joint[bucket].low + range_guard);
}

std::vector<ScriptAngle> pass_angles(const MachineModel& machine, const PassTask& task, const PassPoses& p, const PassThresholds& t) {
  const double bucket_low = machine.joint[bucket].low + range_guard;
  // A little beyond level, for the raising boom tilts the bucket back.
  const double curl = std::max(attitude_carry - radians(5.0) - task.lifted_from[boom] - task.lifted_from[stick], bucket_low);
  const double side = side_of(task);
  return {{"lifted_swing", swing, task.lifted_from[swing]}, {"lifted_boom", boom, task.lifted_from[boom]}, {"lifted_stick", stick, task.lifted_from[stick]},
          {"lifted_bucket", bucket, task.lifted_from[bucket]},
          {"truck_bearing", swing, task.truck_bearing}, {"next_bearing", swing, task.next_bearing},
          {"extend_bearing", swing, task.truck_bearing - side * t.extend_offset}, {"open_bearing", swing, task.truck_bearing - side * t.open_offset},
          {"reach_out_bearing", swing, task.next_bearing + side * t.hover_offset}, {"lower_bearing", swing, task.next_bearing + side * t.lower_offset},
          {"swing_start_boom", boom, t.swing_start_boom}, {"fold_boom", boom, t.fold_boom}, {"open_stick", stick, t.open_stick}, {"pour_bucket", bucket, t.pour_bucket},
          {"curl_bucket", bucket, curl},
          {"carry_boom", boom, p.carry[boom]}, {"carry_stick", stick, p.carry[stick]}, {"carry_bucket", bucket, p.carry[bucket]},
          {"spill_boom", boom, p.spill[boom]}, {"spill_stick", stick, p.spill[stick]}, {"spill_bucket", bucket, p.spill[bucket]},
          {"dump_boom", boom, p.dump[boom]}, {"dump_stick", stick, p.dump[stick]}, {"dump_bucket", bucket, p.dump[bucket]},
          {"back_boom", boom, p.back[boom]}, {"back_stick", stick, p.back[stick]}, {"back_bucket", bucket, p.back[bucket]},
          {"hover_boom", boom, p.hover[boom]}, {"hover_stick", stick, p.hover[stick]}, {"hover_bucket", bucket, p.hover[bucket]},
          {"dig_boom", boom, p.dig[boom]}, {"dig_stick", stick, p.dig[stick]}, {"dig_bucket", bucket, p.dig[bucket]}};
}

Script pass_script(const ScriptSet& scripts, const MachineModel& machine, const PassTask& task, const PassPoses& poses, const PassThresholds& thresholds) {
  return scripts.pass.bind(values_of(pass_angles(machine, task, poses, thresholds)), side_of(task));
}

std::vector<ScriptAngle> approach_angles(const ApproachTask& task, const ApproachPoses& p) {
  return {{"from_swing", swing, task.from[swing]}, {"from_boom", boom, task.from[boom]}, {"from_stick", stick, task.from[stick]}, {"from_bucket", bucket, task.from[bucket]},
          {"bearing", swing, task.bearing},
          {"back_boom", boom, p.back[boom]}, {"back_stick", stick, p.back[stick]}, {"back_bucket", bucket, p.back[bucket]},
          {"end_boom", boom, p.end[boom]}, {"end_stick", stick, p.end[stick]}, {"end_bucket", bucket, p.end[bucket]}};
}

std::optional<Script> approach_script(const ScriptSet& scripts, const MachineModel& machine, const ApproachTask& task) {
  const ImplementScale scale = scale_of(machine);
  const auto back = pose_clear_of_body(machine, {back_radius * scale.arm, task.top + pin_over_top(scale)}, task.keeps_load ? attitude_carry : attitude_back);
  const auto dig = task.entry ? tip_pose_near(machine, {task.entry->r, task.entry->z + dig_above}, attitude_dig) : back;
  if (!back || !dig) return std::nullopt;
  return scripts.approach.bind(values_of(approach_angles(task, {*back, *dig})), task.bearing >= task.from[swing] ? 1.0 : -1.0);
}

PassSearch::PassSearch(const ScriptSet& scripts, const MachineModel& machine, const Skyline& skyline, const PassTask& task, const PassPoses& poses)
    : scripts_(&scripts), machine_(machine), skyline_(skyline), task_(task), poses_(poses) {
  lead_ = soonest_lead;
  reach_over_bed();
  // It is there when the load slides. Far out, where the bucket cannot be held level, soil slides as soon as it opens.
  const bool level = forward(machine, poses.spill).bucket_attitude < attitude_rests;
  thresholds_.open_stick = poses.spill[stick] - (level ? radians(14.0) : radians(6.0));
  thresholds_.pour_bucket = poses.spill[bucket] + (attitude_pour - attitude_spill);
  const double rise = poses.carry[boom] - task.lifted_from[boom];
  thresholds_.fold_boom = task.lifted_from[boom] + 0.45 * std::max(0.0, rise);
}

// The bucket opens while the swing lands, and the stick is then at the spill point: the swing's last stretch is v = sqrt(2 a d).
void PassSearch::reach_over_bed() {
  const double reach = reach_of(machine_, poses_.carry);
  const double brake = limits_of(machine_, swing, reach_of(machine_, poses_.spill)).deceleration;
  const auto way = [&](double seconds) { return 0.5 * brake * seconds * seconds; };
  const auto paced_time = [&](Joint joint) {
    JointResponse response = response_of(machine_, joint);
    response.velocity_max = scripts_->pass.pace_of(joint, RuleMark::extends) * limits_of(machine_, joint, reach).velocity;
    return time_to_reach(response, poses_.carry[joint], poses_.spill[joint]);
  };
  thresholds_.open_offset = std::clamp(way(lead_), radians(2.0), radians(14.0));
  thresholds_.extend_offset = std::clamp(way(lead_ + std::max(paced_time(stick), paced_time(boom))), radians(3.0), radians(45.0));
}

void PassSearch::step() {
  constexpr int out_candidates = 9, back_candidates = 10, lower_candidates = 9;
  constexpr double lower_share = 0.8;  // of the candidate before
  constexpr double latest_lower = radians(2.0);
  if (stage_ == Stage::swing_out) {
    const double low = std::min(task_.lifted_from[boom] + radians(1.0), poses_.carry[boom] - radians(1.5));
    const double high = poses_.carry[boom] - radians(1.5);
    const double share = static_cast<double>(candidate_) / (out_candidates - 1);
    thresholds_.swing_start_boom = low + (high - low) * share * share;  // most are found clear soon
    thresholds_.hover_offset = 0.0;
    const Outcome outcome = simulate(thresholds_);
    if (!outcome.clear_out && candidate_ + 1 < out_candidates) {
      ++candidate_;
    } else if (outcome.clear_out && !outcome.clear_over_bed && lead_ > latest_lead + 0.5 * lead_step) {
      lead_ -= lead_step;
      reach_over_bed();
    } else {
      if (!outcome.clear_out) lead_ = latest_lead;  // nothing is known of what comes after the lift
      reach_over_bed();
      stage_ = Stage::swing_back;
      candidate_ = 0;
    }
  } else if (stage_ == Stage::swing_back) {
    constexpr double soonest = radians(50.0), share = 0.7;  // of the candidate before
    thresholds_.hover_offset = soonest * std::pow(share, candidate_);
    thresholds_.lower_offset = std::min(latest_lower, lower_share * thresholds_.hover_offset);
    const Outcome outcome = simulate(thresholds_);
    const bool passes = outcome.clear_back && outcome.finished;
    if (passes || ++candidate_ == back_candidates) {
      clear_ = outcome.clear_out && outcome.clear_over_bed && passes;
      seconds_ = outcome.seconds;
      stage_ = passes && task_.lower_at_end ? Stage::hover : Stage::done;
      candidate_ = 0;
    }
  } else if (stage_ == Stage::hover) {
    const PassPoses higher = poses_;
    const double above = hover_lowest + hover_step * candidate_;
    const auto hover = above < hover_above ? hover_pose(machine_, task_, above) : std::nullopt;
    if (hover) {
      poses_.hover = *hover;
      const Outcome outcome = simulate(thresholds_);
      if (outcome.clear_back && outcome.finished && outcome.seconds < seconds_) seconds_ = outcome.seconds;
      else poses_ = higher;
    }
    ++candidate_;
    if (above >= hover_above || poses_.hover != higher.hover) {
      stage_ = Stage::lower;
      candidate_ = 0;
    }
  } else if (stage_ == Stage::lower) {
    constexpr double soonest = radians(20.0);
    PassThresholds sooner = thresholds_;
    sooner.lower_offset = std::min(soonest, lower_share * thresholds_.hover_offset) * std::pow(lower_share, candidate_);
    const bool any = sooner.lower_offset > thresholds_.lower_offset && candidate_ < lower_candidates;
    const Outcome outcome = any ? simulate(sooner) : Outcome{};
    if (any && outcome.clear_back && outcome.finished && outcome.seconds < seconds_) {
      thresholds_ = sooner;
      seconds_ = outcome.seconds;
      stage_ = Stage::done;
    } else if (!any) {
      stage_ = Stage::done;
    }
    ++candidate_;
  }
}

PassSearch::Outcome PassSearch::simulate(const PassThresholds& thresholds) const {
  constexpr int script_every = 2;   // cycles: 50 Hz
  constexpr int check_every = 5;
  constexpr double most_seconds = 30.0;
  constexpr double emptying = 0.5;  // s with the bucket open
  constexpr double most_beyond_dig = radians(60.0);  // a stop may carry the swing past the dig only over ground that the scanners sweep
  const double side = task_.truck_bearing >= task_.next_bearing ? 1.0 : -1.0;
  ArmController arm(machine_);
  std::array<JointModel, joints> model{JointModel(response_of(machine_, swing), machine_.cycle), JointModel(response_of(machine_, boom), machine_.cycle),
                                       JointModel(response_of(machine_, stick), machine_.cycle), JointModel(response_of(machine_, bucket), machine_.cycle)};
  for (std::size_t j = 0; j < joints; ++j) model[j].reset(task_.lifted_from[j], 0.0);
  Script script = pass_script(*scripts_, machine_, task_, poses_, thresholds);
  script.start();
  Outcome outcome;
  double open_s = 0.0;
  const int most = static_cast<int>(most_seconds / machine_.cycle);
  for (int k = 0; k < most; ++k) {
    Joints angle{}, velocity{};
    for (std::size_t j = 0; j < joints; ++j) {
      angle[j] = model[j].angle();
      velocity[j] = model[j].velocity();
    }
    const bool opens = script.of(bucket).reached(RuleMark::opens), open = opens && angle[bucket] > poses_.dump[bucket] - radians(8.0);
    open_s = open ? open_s + machine_.cycle : open_s;
    const std::uint32_t pours = opens && angle[bucket] > poses_.dump[bucket] - empties_before ? event_empties : event_none;
    if (k % script_every == 0) script.evaluate(angle, event_weighed | pours | (open_s >= emptying ? event_emptied : event_none));
    const bool returning = script.of(swing).reached(RuleMark::returns);
    arm.brake_swing(returning ? task_.brake_empty : 0.0);
    const double carried_kg = returning ? 0.0 : machine_.bucket_payload_kg;
    arm.carries(carried_kg);
    if (k % script_every == 0)
      for (std::size_t j = 0; j < joints; ++j) model[j].respond(responses_of(machine_, j, reach_of(machine_, angle), carried_kg));
    if (k % check_every == 0) {
      const ReachIntervals box = preview(machine_, angle, velocity);
      const double beyond = side > 0.0 ? task_.next_bearing - box.low[swing] : box.high[swing] - task_.next_bearing;
      const bool extends = script.of(stick).reached(RuleMark::extends);
      auto blocking = skyline_.blocking(box);
      // What no threshold helps against. Beside the truck stands its cab: how fast the swing goes towards it with folded implements is the kernel's to
      // say, which slows it smoothly. What the arm meets of its own body it meets however late the swing begins: the guard slows the arm.
      if (blocking && !extends && blocking->what != Skyline::Blocking::What::ground) blocking.reset();
      if (blocking || (returning && beyond > most_beyond_dig)) {
        (returning ? outcome.clear_back : extends ? outcome.clear_over_bed : outcome.clear_out) = false;
        if (!returning && stage_ == Stage::swing_out) return outcome;
      }
    }
    const Joints goals = script.goals();
    const Joints command = arm.toward(goals, script.paces(), angle, velocity);
    arm.sent(command);
    bool standing = script.at_last();
    for (std::size_t j = 0; j < joints; ++j) {
      model[j].advance(command[j]);
      standing = standing && std::fabs(angle[j] - goals[j]) < arrived && std::fabs(velocity[j]) < radians(1.0);
    }
    outcome.seconds = (k + 1) * machine_.cycle;
    if (standing) {
      outcome.finished = true;
      break;
    }
  }
  return outcome;
}

}  // namespace berm::app
