#include "planning/pass_script.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

namespace {

using Relation = Condition::Relation;

constexpr double range_guard = radians(7.5);      // a standing joint's stop travel stays inside its range
constexpr double pin_over_walls = 2.90;           // bucket pin above the truck's walls: the bucket's circle, the spread of a stop, the margin
constexpr double carry_radius = 6.0;              // of the bucket pin, m
constexpr double back_radius = 6.1;
constexpr double attitude_carry = radians(-178.0);
constexpr double attitude_pour = radians(-145.0); // the load begins to slide
constexpr double attitude_open = radians(-70.0);
constexpr double attitude_back = radians(-122.0);
constexpr double attitude_dig = radians(-92.0);
constexpr double spill_ahead = 0.55;              // pin beyond the dump point while the lip points inward ...
constexpr double dump_behind = -0.10;             // ... and a little less when the bucket hangs open
constexpr double dig_above = 0.30;                // tip over the entry of the drag
constexpr double arrived = radians(1.0);

// Pose with the pin at the point and the attitude as wanted, or as near as the bucket's range allows; with a shorter radius if out of reach.
std::optional<Joints> pose_near(const MachineModel& machine, PlanePoint pin, double attitude) {
  for (int shorter = 0; shorter < 20; ++shorter, pin.r -= 0.05)
    for (int turn = 0; turn <= 60; ++turn)
      if (auto q = inverse_pin(machine, pin, attitude + radians(turn), range_guard)) return q;
  return std::nullopt;
}

std::optional<Joints> tip_pose_near(const MachineModel& machine, const PlanePoint& tip, double attitude) {
  for (int turn = 0; turn <= 60; ++turn)
    for (const double sign : {1.0, -1.0})
      if (auto q = inverse_tip(machine, tip, attitude + sign * radians(turn), range_guard)) return q;
  return std::nullopt;
}

Condition when(Joint joint, Relation relation, double threshold, double tolerance = 0.0) { return {joint, relation, threshold, tolerance}; }

}  // namespace

std::optional<PassPoses> pass_poses(const MachineModel& machine, const SiteModel& site, const PassTask& task) {
  const double pin_z = site.truck.wall_top + pin_over_walls;
  const auto carry = pose_near(machine, {carry_radius, pin_z}, attitude_carry);
  const auto spill = pose_near(machine, {task.dump_radius + spill_ahead, pin_z}, attitude_carry);
  const auto dump = pose_near(machine, {task.dump_radius - dump_behind, pin_z}, attitude_open);
  const auto back = pose_near(machine, {back_radius, pin_z}, attitude_back);
  const auto dig = tip_pose_near(machine, {task.next_entry.r, task.next_entry.z + dig_above}, attitude_dig);
  if (!carry || !spill || !dump || !back || !dig) return std::nullopt;
  return PassPoses{*carry, *spill, *dump, *back, task.lower_at_end ? *dig : *back};
}

Script pass_script(const PassTask& task, const PassPoses& p, const PassThresholds& t) {
  // The truck stands to the left of the dig, or to its right: the comparisons turn round with it.
  const double side = task.truck_bearing >= task.lifted_from[swing] ? 1.0 : -1.0;
  const Relation past = side > 0.0 ? Relation::above : Relation::below;
  const Relation back_past = side > 0.0 ? Relation::falls_below : Relation::rises_above;
  const double extend = task.truck_bearing - side * t.extend_offset;
  const double open = task.truck_bearing - side * t.open_offset;
  const double lower = task.next_bearing + side * t.lower_offset;
  return Script({
      JointScript({{"digging finished: wait", {}, event_none, task.lifted_from[swing]},
                   {"boom high: swing to truck", {when(boom, Relation::above, t.swing_start_boom)}, event_none, task.truck_bearing},
                   {"emptied: swing to dig", {}, event_emptied, task.next_bearing},
                   {"over the dig: stop and dig", {when(swing, Relation::near, task.next_bearing, arrived)}, event_none, task.next_bearing}}),
      JointScript({{"digging finished: raise", {}, event_none, p.carry[boom]},
                   {"near the truck: spill height", {when(swing, past, extend)}, event_none, p.spill[boom]},
                   {"pouring: dump height", {when(bucket, Relation::above, t.pour_bucket)}, event_none, p.dump[boom], 0.5},
                   {"emptied: raise", {}, event_emptied, p.back[boom]},
                   {"near the dig: lower", {when(swing, back_past, lower)}, event_none, p.dig[boom]}}),
      JointScript({{"digging finished: wait", {}, event_none, task.lifted_from[stick]},
                   {"boom high: fold", {when(boom, Relation::above, t.fold_boom)}, event_none, p.carry[stick]},
                   {"near the truck: spill point", {when(swing, past, extend)}, event_none, p.spill[stick], 0.7},
                   {"pouring: dump point", {when(bucket, Relation::above, t.pour_bucket)}, event_none, p.dump[stick], 0.4},
                   {"emptied: fold", {}, event_emptied, p.back[stick], 0.7},
                   {"near the dig: move to dig", {when(swing, back_past, lower)}, event_none, p.dig[stick]}}),
      JointScript({{"digging finished: curl", {}, event_none, p.carry[bucket]},
                   {"near the truck: keep level", {when(swing, past, extend)}, event_none, p.spill[bucket]},
                   {"over the bed: open", {when(swing, past, open), when(stick, Relation::above, t.open_stick)}, event_none, p.dump[bucket]},
                   {"emptied: half curl", {}, event_emptied, p.back[bucket], 0.7},
                   {"near the dig: move to dig", {when(swing, back_past, lower)}, event_none, p.dig[bucket]}}),
  });
}

std::optional<Script> approach_script(const MachineModel& machine, const SiteModel& site, const ApproachTask& task) {
  const auto back = pose_near(machine, {back_radius, site.truck.wall_top + pin_over_walls}, attitude_back);
  const auto dig = tip_pose_near(machine, {task.entry.r, task.entry.z + dig_above}, attitude_dig);
  if (!back || !dig) return std::nullopt;
  const Joints& end = task.lower ? *dig : *back;
  const Condition high = when(boom, Relation::above, (*back)[boom] - radians(2.0));
  const Condition over = when(swing, Relation::near, task.bearing, arrived);
  const Condition folded = when(stick, Relation::near, (*back)[stick], radians(8.0));
  // The stick moves only with the boom up: a folded bucket low over the bench would meet it.
  return Script({
      JointScript({{"wait", {}, event_none, task.from[swing]}, {"high and folded: swing to dig", {high, folded}, event_none, task.bearing}}),
      JointScript({{"raise", {}, event_none, (*back)[boom]}, {"over the dig: lower", {over, high, folded}, event_none, end[boom]}}),
      JointScript({{"wait", {}, event_none, task.from[stick]}, {"high: fold", {high}, event_none, (*back)[stick]}, {"over the dig: move to dig", {over, folded}, event_none, end[stick]}}),
      JointScript({{"wait", {}, event_none, task.from[bucket]}, {"high: half curl", {high}, event_none, (*back)[bucket]}, {"over the dig: move to dig", {over, folded}, event_none, end[bucket]}}),
  });
}

PassSearch::PassSearch(const MachineModel& machine, const Skyline& skyline, const PassTask& task, const PassPoses& poses)
    : machine_(machine), skyline_(skyline), task_(task), poses_(poses) {
  // The stick is to reach the spill point when the swing is about to stand: the swing's last stretch is v = sqrt(2 a d).
  const double reach = reach_of(machine, poses.carry);
  const ControllerLimits swing_limits = limits_of(machine, swing, reach);
  const double stick_time = time_to_reach(response_of(machine, stick), poses.carry[stick], poses.spill[stick]);
  const double boom_time = time_to_reach(response_of(machine, boom), poses.carry[boom], poses.spill[boom]);
  const double lead = std::max(stick_time, boom_time) + 0.2;
  thresholds_.extend_offset = std::clamp(0.5 * swing_limits.deceleration * lead * lead, radians(6.0), radians(22.0));
  // Opening starts while the swing lands; the dead time and the way to the pouring angle pass meanwhile.
  const double pour_time = time_to_reach(response_of(machine, bucket), poses.spill[bucket], poses.spill[bucket] + radians(20.0));
  thresholds_.open_offset = std::clamp(0.5 * swing_limits.deceleration * pour_time * pour_time, radians(2.0), radians(6.0));
  thresholds_.open_stick = poses.spill[stick] - radians(6.0);
  thresholds_.pour_bucket = poses.spill[bucket] + (attitude_pour - attitude_carry);
  const double rise = poses.carry[boom] - task.lifted_from[boom];
  thresholds_.fold_boom = task.lifted_from[boom] + 0.45 * std::max(0.0, rise);
}

void PassSearch::step() {
  constexpr int out_candidates = 9, back_candidates = 10;
  if (stage_ == Stage::swing_out) {
    const double low = std::min(task_.lifted_from[boom] + radians(1.0), poses_.carry[boom] - radians(1.5));
    const double high = poses_.carry[boom] - radians(1.5);
    thresholds_.swing_start_boom = low + (high - low) * candidate_ / (out_candidates - 1);
    thresholds_.lower_offset = 0.0;
    if (simulate(thresholds_).clear_out || ++candidate_ == out_candidates) {
      stage_ = Stage::swing_back;
      candidate_ = 0;
    }
  } else if (stage_ == Stage::swing_back) {
    constexpr double soonest = radians(60.0), latest = radians(2.0);
    thresholds_.lower_offset = soonest + (latest - soonest) * candidate_ / (back_candidates - 1);
    const Outcome outcome = simulate(thresholds_);
    if ((outcome.clear_back && outcome.finished) || ++candidate_ == back_candidates) {
      clear_ = outcome.clear_out && outcome.clear_back && outcome.finished;
      seconds_ = outcome.seconds;
      stage_ = Stage::done;
    }
  }
}

PassSearch::Outcome PassSearch::simulate(const PassThresholds& thresholds) const {
  constexpr int script_every = 10;  // cycles: 10 Hz
  constexpr int check_every = 5;
  constexpr double most_seconds = 30.0;
  constexpr double emptying = 0.5;  // s with the bucket open
  ArmController arm(machine_);
  std::array<JointModel, joints> model{JointModel(response_of(machine_, swing), machine_.cycle), JointModel(response_of(machine_, boom), machine_.cycle),
                                       JointModel(response_of(machine_, stick), machine_.cycle), JointModel(response_of(machine_, bucket), machine_.cycle)};
  for (std::size_t j = 0; j < joints; ++j) model[j].reset(task_.lifted_from[j], 0.0);
  Script script = pass_script(task_, poses_, thresholds);
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
    const bool open = script.of(bucket).active() >= 2 && angle[bucket] > poses_.dump[bucket] - radians(8.0);
    open_s = open ? open_s + machine_.cycle : open_s;
    if (k % script_every == 0) script.evaluate(angle, open_s >= emptying ? event_emptied : event_none);
    const bool returning = script.of(swing).active() >= 2;
    if (k % check_every == 0 && !skyline_.clear(angle, velocity)) {
      (returning ? outcome.clear_back : outcome.clear_out) = false;
      if (!returning) return outcome;
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
