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
constexpr double attitude_carry = radians(-178.0);
constexpr double attitude_open = radians(-48.0);
constexpr double attitude_back = radians(-122.0);
constexpr double attitude_dig = radians(-92.0);
constexpr double spill_ahead = 0.36;              // pin beyond the dump point while the lip points inward, by the scale of the bucket ...
constexpr double dump_behind = 0.25;              // ... and short of it when the bucket hangs open, lip outward
constexpr double easy_ahead = 0.55;               // pin beyond the farthest dump point that is easily reached: so far out a heap slides off before the lip is over the bed
constexpr double part_lip_beyond = 0.3;           // lip beyond the dump point, at most, while a part of a load is poured: by the scale of the bucket
constexpr double part_ahead = radians(15.0);      // the arm follows late, and a lip too far out may be held by what stands beside the bed, and the arm with it: so far ahead of the bucket
constexpr double dig_above = -0.15;               // tip over the entry of the drag, which is above the surface: nearer to that, for the drag takes over on the way down

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
  while (pose_at(machine, {radius + reach_step + easy_ahead * scale.bucket, wall_top + pin_over_top(scale)}, attitude_carry)) radius += reach_step;
  return radius;
}

// The truck stands to the left of the dig, 1, or to its right, -1: the script's comparisons turn round with it.
double side_of(const PassTask& task) { return task.truck_bearing >= task.lifted_from[swing] ? 1.0 : -1.0; }

}  // namespace

std::optional<Joints> hover_pose(const MachineModel& machine, const PassTask& task, double above) {
  return tip_pose_near(machine, {task.next_entry.r, above}, attitude_dig);
}

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
  const auto hover = hover_pose(machine, task, hover_highest);
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

std::optional<Joints> raised_pose(const MachineModel& machine, double top, bool keeps_load) {
  const ImplementScale scale = scale_of(machine);
  return pose_clear_of_body(machine, {back_radius * scale.arm, top + pin_over_top(scale)}, keeps_load ? attitude_carry : attitude_back);
}

std::optional<Script> approach_script(const ScriptSet& scripts, const MachineModel& machine, const ApproachTask& task) {
  const auto back = raised_pose(machine, task.top, task.keeps_load);
  const auto dig = task.entry ? tip_pose_near(machine, {task.entry->r, task.entry->z + dig_above}, attitude_dig) : back;
  if (!back || !dig) return std::nullopt;
  return scripts.approach.bind(values_of(approach_angles(task, {*back, *dig})), task.bearing >= task.from[swing] ? 1.0 : -1.0);
}

}  // namespace berm::app
